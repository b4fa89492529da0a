// SPDX-License-Identifier: GPL-3.0-or-later
// The canonical spelling of a formula: no parenthesis that is not needed, and what it says stays.
#include <catch2/catch.hpp>

#include "generator/formula.hpp"

namespace {

using namespace algest;

std::string spelled(const std::string& text) {
    const auto f = formula::parse(text, [](int, const std::string& what, const std::string&) { FAIL(what); });
    return formula::text(*f);
}

}  // namespace

TEST_CASE("spelling: powers are read from the right, and need no parentheses there") {
    CHECK(spelled("a^b^c") == "a^b^c");
    CHECK(spelled("a^(b^c)") == "a^b^c");
    CHECK(spelled("(a^b)^c") == "(a^b)^c");   // another number
    CHECK(spelled("a^-b") == "a^(-b)");
    std::string chain = "x";
    for (int k = 0; k < 90; ++k) chain += "^x";
    CHECK(spelled(chain) == chain);   // as deep as its text, and no deeper
}

TEST_CASE("spelling: sums, products and quotients are read from the left") {
    CHECK(spelled("a-(b-c)") == "a - (b - c)");
    CHECK(spelled("(a-b)-c") == "a - b - c");
    CHECK(spelled("a/(b*c)") == "a/(b*c)");
    CHECK(spelled("(a*b)/c") == "a*b/c");
    CHECK(spelled("-(a+b)*c") == "-(a + b)*c");
}
