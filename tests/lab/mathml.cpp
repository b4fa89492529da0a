// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas of a page: the LaTeX of derivations as MathML, whole.
#include "lab/mathml.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

#include "generator/generate.hpp"

using namespace algest;

namespace {

std::string math(const std::string& latex) { return lab::mathml(latex, false); }
std::string with_mrow(const std::string& inside) { return "<math><mrow>" + inside + "</mrow></math>"; }

}  // namespace

TEST_CASE("mathml: names, numbers, scripts, fractions, fences") {
    CHECK(math("x_{1}^{2}") == with_mrow("<msubsup><mi>x</mi><mrow><mn>1</mn></mrow><mrow><mrow><mn>2</mn></mrow></mrow></msubsup>"));
    CHECK(math("\\frac{R}{L}") == with_mrow("<mfrac><mrow><mi>R</mi></mrow><mrow><mi>L</mi></mrow></mfrac>"));
    CHECK(math("0.5\\,\\sigma") == with_mrow("<mn>0.5</mn><mspace width=\"0.17em\"/><mi>\u03c3</mi>"));
    CHECK(math("\\mathrm{i\\_q}") == with_mrow("<mi mathvariant=\"normal\">i_q</mi>"));
    CHECK(math("\\left(\\frac{1}{2}\\right)").find("stretchy=\"true\"") != std::string::npos);
    CHECK(math("\\left(x^{2}\\right)").find("stretchy=\"true\"") == std::string::npos);
}

TEST_CASE("mathml: every derivation is read without a rest") {
    int models = 0;
    for (const auto& file : std::filesystem::directory_iterator(ALGEST_SOURCE "/models")) {
        if (file.path().extension() != ".toml") continue;
        INFO(file.path().string());
        Diagnostics diagnostics;
        generator::PlanOptions options;
        options.weights = false;
        const auto plan = generator::plan_from_model(file.path().string(), options, diagnostics);
        REQUIRE(plan);
        const std::string page = lab::html_of_latex(generator::derivation_latex(*plan));
        CHECK(page.find('\\') == std::string::npos);
        CHECK(page.find('$') == std::string::npos);
        CHECK(page.find("<math") != std::string::npos);
        ++models;
    }
    CHECK(models > 10);
}

TEST_CASE("mathml: what is no LaTeX stays as text, and ends") {
    CHECK(math("\\nothing") == with_mrow("<mtext>\\nothing</mtext>"));
    for (const std::string text : {"", "{", "}", "\\", "\\frac", "\\frac{", "x^", "x_", "\\left", "\\left(", "\\right)", "\\mathrm{", "\\mathrm{a\\", "&", "\\\\", "<&\"'>", "\xff\xfe"}) {
        INFO(text);
        CHECK_NOTHROW(lab::mathml(text, false));
        CHECK_NOTHROW(lab::mathml(text, true));
        CHECK_NOTHROW(lab::html_of_latex("\\section*{" + text + "\n$" + text + "$\n\\begin{align*}\n" + text));
    }
    CHECK_NOTHROW(math(std::string(100000, '{')));
    CHECK(lab::html_of_latex("costs 5 $ <now>") == "<p>costs 5 $ &lt;now&gt;</p>\n");
}
