// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: any bytes as a formula and as an equation. What parses has a spelling that parses again, a spelling
// of that which is its own, and LaTeX that a page can show.
#include "generator/formula.hpp"

#include <cstdlib>

#include "lab/mathml.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

using namespace algest;

const formula::Complain quiet = [](int, const std::string&, const std::string&) {};

std::string spelled(const std::string& text) {
    const auto f = formula::parse(text, quiet);
    return f ? formula::text(*f) : std::string();
}

void check(const formula::Formula& f) {
    (void)lab::mathml(formula::latex(f), false);
    const std::string first = formula::text(f);
    if (first.size() > formula::longest_text / 2) return;   // exact fractions are longer than the decimals that they were
    const std::string second = spelled(first);   // where the first has 3/1000 as one number, here it is a division
    if (second.empty() || spelled(second) != second) std::abort();
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
