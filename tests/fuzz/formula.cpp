// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: any bytes as a formula and as an equation. What parses has a spelling that parses again (unless that is nested too deep, since
// a negative exponent gets parentheses), a spelling of that which is its own, and LaTeX that a page can show.
#include "generator/formula.hpp"

#include <cstdlib>

#include "lab/mathml.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

using namespace algest;

const formula::Complain quiet = [](int, const std::string&, const std::string&) {};

/// The spelling of what the text says; nullopt: it is nested too deep.
std::optional<std::string> spelled(const std::string& text) {
    bool too_deep = false;
    const auto f = formula::parse(text, [&](int, const std::string& what, const std::string&) { too_deep = what.find("nested deeper") != std::string::npos; });
    if (!f && !too_deep) std::abort();
    return f ? std::optional(formula::text(*f)) : std::nullopt;
}

void check(const formula::Formula& f) {
    (void)lab::mathml(formula::latex(f), false);
    const std::string first = formula::text(f);
    if (first.size() > formula::longest_text / 2) return;   // exact fractions are longer than the decimals that they were
    const auto second = spelled(first);   // where the first has 3/1000 as one number, here it is a division
    if (!second) return;
    const auto third = spelled(*second);
    if (third && *third != *second) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = fuzz::text_of(data, size);
    if (const auto f = formula::parse(text, quiet)) check(*f);
    if (const auto e = formula::parse_equation(text, quiet)) {
        check(e->left);
        check(e->right);
    }
    return 0;
}
