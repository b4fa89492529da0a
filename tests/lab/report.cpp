// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a discovery that is written here by hand, with everything in it, with nothing in it, and with names that try to get out.
#include "lab/report.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "lab/quantity.hpp"
#include "lab/report_figures.hpp"
#include "tests/lab/temporary_file.hpp"

namespace {

using namespace algest;
using lab::Discovery;
using lab::Verdict;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// A model of `outputs` currents, their recording of `samples` rows, and a discovery in which everything is full.
struct Scene {
    Scene(std::size_t samples, std::size_t outputs) {
        std::string text = "name = \"m\"\nsummary = \"a <b>model</b> & more\"\n[sampling]\nperiod = 1e-3\n[signals]\nu = { unit = \"V\" }\n";
        std::string csv = "t [s],u [V]";
        for (std::size_t s = 0; s < outputs; ++s) {
            text += fmt::format("i_{0} = {{ unit = \"A\", noise = 0.01, initial = 0 }}\n", s);
            csv += fmt::format(",i_{} [A]", s);
        }
        text += "[parameters]\nR = { unit = \"ohm\", initial = 1 }\nL = { unit = \"H\", initial = 0.01 }\n";
        for (std::size_t s = 0; s < outputs; ++s) text += fmt::format("[[equation]]\nname = \"e{0}\"\node = \"L*der(i_{0}) = u - R*i_{0}\"\n", s);
        csv += "\n";
        for (std::size_t row = 0; row < samples; ++row) {
            csv += fmt::format("{:.3f},1", 1e-3 * static_cast<double>(row));
            for (std::size_t s = 0; s < outputs; ++s) csv += fmt::format(",{:.6f}", value(row, s));
            csv += "\n";
        }
        Diagnostics quiet;
        model = *model::read(folder.write("m.toml", text), false, quiet);
        recording = *lab::read_recording(folder.write("m.csv", csv), quiet);
        fill(samples, outputs);
    }

    /// A wave with something that looks like noise.
    static double value(std::size_t row, std::size_t s) {
        const double k = static_cast<double>(row);
        return std::sin(0.03 * k + static_cast<double>(s)) + 0.01 * std::sin(1e4 * k * k);
    }

    void fill(std::size_t samples, std::size_t outputs) {
        const double end = 1e-3 * static_cast<double>(samples - 1);
        d.verdict = Verdict::named;
        d.recordings.resize(1);
        d.effects = {{"coulomb_friction", "e0 <\"&'>", "-Tc*sgn(i_0)", "dry & dull <friction>", "it jumps", {{"Tc", "N.m", 0.0120034, 0.0001}, {"Ncog", "1", 4, 0}, {"far", "", 1, infinity}}}};
        d.alternatives = {{"coulomb_friction"}, {"constant_load", "viscous_friction"}};
        d.experiments = {"reverse <the> motion"};
        d.doubts = {"the noise may be wrong & so may this"};
        d.where = {{"e0", 0.9, 0, 1, "follows the sign of i_0"}, {"e1", 0.1, 0, 1, "no single signal explains it"}};
        d.evidence = {{"coulomb_friction", "e0", "-Tc*sgn(i_0)", 1234, 0.004, 56, true, false, 1}, {"constant_load", "e0", "-T", 12, 0.02, 5, false, true, 1}, {"viscous_friction", "e0", "-b*i_0", 11, 0.03, 4, false, false, 1}};
        for (std::size_t s = 0; s < outputs; ++s) d.recordings[0].outputs.push_back({fmt::format("i_{}", s), 0.2, 0.0101, 0.01});
        d.parameters_before = {{"R", "ohm", 1.23456, 0.012}, {"L", "H", 2e-5, 3e-7}};
        d.parameters_after = {{"R", "ohm", 1.1, 0.001}, {"L", "H", 2.1e-5, 1e-7}, {"Tc", "N.m", 0.0120034, 0.0001}};
        d.recordings[0].before.signals.resize(outputs + 1);
        d.recordings[0].after.signals.resize(outputs + 1);
        for (std::size_t s = 0; s < outputs; ++s) {
            lab::EquationResidual r{fmt::format("e{}", s), s == 0 ? "" : "V", {}, {}, {}, 0.01, fmt::format("i_{}", s), "A", {}, {}};
            for (std::size_t row = 0; row < samples; ++row) {
                const double y = value(row, s);
                d.recordings[0].before.signals[s + 1].push_back(y + 0.2 * std::sin(0.03 * static_cast<double>(row)));
                d.recordings[0].after.signals[s + 1].push_back(y + 0.01 * std::sin(7e3 * static_cast<double>(row)));
                if (row % 8 != 0) continue;
                r.t.push_back(1e-3 * static_cast<double>(row));
                r.x.push_back(y);
                r.law.push_back(y > 0 ? 0.1 : -0.1);
                r.before.push_back(r.law.back() + 0.01 * std::sin(5e3 * static_cast<double>(row)));
                r.after.push_back(r.before.back() - r.law.back());
            }
            d.residuals.push_back(std::move(r));
        }
        d.recordings[0].before.samples = d.recordings[0].after.samples = samples;
        d.recordings[0].train_from_s = 0;
        d.recordings[0].train_to_s = d.recordings[0].test_from_s = 0.7 * end;
        d.recordings[0].test_to_s = end;
    }

    std::string page(const lab::Draw& draw) {
        return lab::report_html(d, model, recording, {"my model.toml", {"run.csv"}, "found", "found/my model.toml", "found/m.patch", "--- m\n+++ m\n@@ -1 +1 @@\n-a < b\n+a > b\n"}, draw, diagnostics);
    }

    test::TemporaryFolder folder;
    model::Model model;
    lab::Recording recording;
    Discovery d{};
    Diagnostics diagnostics;
};

lab::Drawing no_gnuplot(const std::string&) { return {lab::Drawing::Outcome::not_installed, {}, {}}; }

}  // namespace

TEST_CASE("report: everything that a discovery holds is on the page, escaped") {
    Scene scene(3000, 2);
    const std::string page = scene.page(lab::gnuplot);
    CHECK(scene.diagnostics.sorted().empty());
    CHECK(count(page, "<svg") == 6);
    for (const char* part : {"a &lt;b&gt;model&lt;/b&gt; &amp; more", "<b>coulomb_friction</b> is missing in &lsquo;e0 &lt;&quot;&amp;&#39;&gt;&rsquo;", "dry &amp; dull &lt;friction&gt;",
                             "Tc = <span class=\"q\">0.01200&nbsp;&plusmn;&nbsp;0.00010&nbsp;N.m", "the noise may be wrong &amp; so may this", "20.0&times; &rarr; 1.01&times;", "Every output is at its noise floor",
                             "Next best, constant_load: error 5.00 times as large", "follows the sign of i_0", "rejected", "1.235&nbsp;&plusmn;&nbsp;0.012", "(20.00&nbsp;&plusmn;&nbsp;0.30)&middot;10<sup>-6</sup>",
                             "<span class=\"added\">+a &gt; b", "<span class=\"removed\">-a &lt; b", "patch &#39;my model.toml&#39; &lt; found/m.patch", "far: not seen by the data", "residual [unknown]"}) {
        INFO(part);
        CHECK(holds(page, part));
    }
    CHECK(scene.page(lab::gnuplot) == page);
}

TEST_CASE("report: what tells alternatives apart, and the shape of what is unknown") {
    Scene scene(3000, 1);
    scene.d.verdict = Verdict::ambiguous;
    CHECK(holds(scene.page(no_gnuplot), "<b>coulomb_friction</b>, or <b>constant_load and viscous_friction</b>"));
    CHECK(holds(scene.page(no_gnuplot), "<li>reverse &lt;the&gt; motion</li>"));
    scene.d.verdict = Verdict::unknown;
    CHECK(holds(scene.page(no_gnuplot), "no effect of the library explains it"));
    CHECK(holds(scene.page(no_gnuplot), "&lsquo;e0&rsquo; holds 90.0 % of the gap"));
}

TEST_CASE("report: a discovery that holds nothing still makes a page") {
    Scene scene(3000, 1);
    for (const Verdict verdict : {Verdict::named, Verdict::ambiguous, Verdict::none, Verdict::unknown}) {
        scene.d = Discovery{};
        scene.d.recordings.resize(1);
        scene.d.verdict = verdict;
        const std::string page = lab::report_html(scene.d, scene.model, scene.recording, {"", {""}, "", "", "", ""}, lab::gnuplot, scene.diagnostics);
        CHECK(count(page, "<h2>") == 10);
        CHECK(count(page, "<svg") == 0);
    }
    CHECK(scene.diagnostics.sorted().empty());
}

TEST_CASE("report: series of one point, of none finite, and runs that end early are drawn or left out") {
    Scene scene(3000, 2);
    scene.d.residuals[0].t.resize(1);
    scene.d.residuals[0].before.resize(1);
    for (double& v : scene.d.residuals[1].before) v = nan_value;
    for (double& v : scene.d.residuals[1].x) v = infinity;
    scene.d.recordings[0].before.signals[1].resize(2500);
    scene.d.recordings[0].before.signals[1][2400] = 1e30;
    scene.d.recordings[0].before.signals[2].resize(10);   // nothing of it in the test stretch
    scene.d.recordings[0].outputs[1].floor = 0;
    scene.d.recordings[0].outputs[1].before = infinity;
    const std::string page = scene.page(lab::gnuplot);
    for (const Diagnostic& diagnostic : scene.diagnostics.sorted()) UNSCOPED_INFO(diagnostic.text());
    CHECK(scene.diagnostics.sorted().empty());
    CHECK(holds(page, "Before: the free run leaves the picture or ends inside the test stretch."));
    CHECK_FALSE(holds(page, "NaN"));
}

TEST_CASE("report: without gnuplot one warning, a note on the page, no figure") {
    Scene scene(3000, 2);
    const std::string page = scene.page(no_gnuplot);
    REQUIRE(scene.diagnostics.sorted().size() == 1);
    CHECK(holds(scene.diagnostics.sorted()[0].text(), "gnuplot: warning: is not installed"));
    CHECK(holds(page, "id=\"no-figures\""));
    CHECK(count(page, "<svg") == 0);
}

TEST_CASE("report: 25000 rows and 5 outputs make less than 1.5 MB") {
    Scene scene(25000, 5);
    const std::string page = scene.page(lab::gnuplot);
    CHECK(count(page, "<svg") == 15);
    CHECK(page.size() < 1500000);
}

TEST_CASE("figure: names are drawn as they are and run nothing") {
    const test::TemporaryFolder folder;
    lab::Panel panel{};
    panel.left = 90;
    panel.right = 480;
    panel.top = 20;
    panel.bottom = 200;
    panel.x = {"x'; system 'touch " + folder.path("ran") + "' #", "", 0, 1, true};
    panel.y = {"i_q^2 {/b} @a `date`", "<&>", 0, 1e-5, true};
    panel.drawn = {{{{0, 1}, {0, 1e-5}}, "it's \"this\"\n", "#000000", 1, false}};
    panel.headings = {{0.5, "a_b\\nc"}};
    const auto drawing = lab::gnuplot(lab::gnuplot_script({"f", 500, 260, {panel}}));
    REQUIRE(drawing.outcome == lab::Drawing::Outcome::drawn);
    CHECK(folder.entries() == 0);
    CHECK(holds(drawing.svg, "i_q^2"));
    CHECK(holds(drawing.svg, "[10\u207b\u2076\u00a0&lt;&amp;>]"));
    CHECK(holds(drawing.svg, "<text>a_b\\nc</text>"));
    const std::string alone = lab::inline_svg(drawing.svg, "p1_", "a < b");
    CHECK(alone.compare(0, 4, "<svg") == 0);
    CHECK(holds(alone, "<title>a &lt; b</title>"));
    CHECK(holds(alone, " id=\"p1_"));
}

TEST_CASE("figure: a script that gnuplot does not take is a failure with its complaint") {
    const auto drawing = lab::gnuplot("set nonsense\n");
    CHECK(drawing.outcome == lab::Drawing::Outcome::failed);
    CHECK_FALSE(drawing.complaint.empty());
}

TEST_CASE("envelope: no peak is lost, gaps stay, few points stay as they are") {
    lab::Curve curve;
    for (int k = 0; k < 10000; ++k) {
        curve.x.push_back(k);
        curve.y.push_back(k == 1234 ? 100 : k == 5678 ? nan_value : std::sin(0.1 * k));
    }
    const lab::Curve drawn = lab::envelope(curve, 0, 9999, 100);
    CHECK(drawn.x.size() <= 204);
    CHECK(std::count(drawn.y.begin(), drawn.y.end(), 100.0) == 1);
    CHECK(std::count_if(drawn.y.begin(), drawn.y.end(), [](double y) { return std::isnan(y); }) == 1);
    CHECK(std::is_sorted(drawn.x.begin(), drawn.x.end()));
    CHECK(lab::envelope(drawn, 0, 9999, 1000).x == drawn.x);
}

TEST_CASE("a law of one value for each x is a line, of several is points") {
    lab::Curve line, loop;
    for (int k = 0; k < 400; ++k) {
        line.x.push_back(std::sin(0.1 * k));
        line.y.push_back(line.x.back() > 0 ? 1 : -1);
        loop.x.push_back(std::sin(0.1 * k));
        loop.y.push_back(std::cos(0.1 * k));
    }
    CHECK(lab::is_function(lab::sorted_by_x(line)));
    CHECK_FALSE(lab::is_function(lab::sorted_by_x(loop)));
}

TEST_CASE("quantities: digits by the standard deviation") {
    const auto text = [](double value, double sd) {
        const lab::Quantity q = lab::quantity(value, sd);
        return q.value + "|" + q.sd + "|" + q.exponent;
    };
    CHECK(text(0.0120034, 0.0001) == "0.01200|0.00010|");
    CHECK(text(1.23456, 0.0996) == "1.23|0.10|");
    CHECK(text(12345.6, 234.0) == "12346|234|");
    CHECK(text(2.5e-4, 3e-6) == "250.0|3.0|-6");
    CHECK(text(-1.5e7, 2e4) == "-15.000|0.020|6");
    CHECK(text(3, 0) == "3||");
    CHECK(text(3.14159265, infinity) == "3.14159||");
    CHECK(text(0, 0.01) == "0.000|0.010|");
    CHECK(text(0.0004, 0.013) == "0.0004|0.0130|");   // not 0.000: something was found, however unsure
    CHECK(text(-3.2e-7, 2e-3) == "-0.0000003|0.0020000|");
    CHECK(text(0, 0) == "0||");
    CHECK(text(nan_value, 1) == "-||");
    CHECK(lab::three_digits(0.0040749) == "0.00407");
    CHECK(lab::three_digits(29.14) == "29.1");
    CHECK(lab::three_digits(0.99999) == "1.00");
    CHECK(lab::three_digits(12345) == "12345");
    CHECK(lab::three_digits(infinity) == "-");
}
