// SPDX-License-Identifier: GPL-3.0-or-later
// What takes a name back.
#include "lab/decide.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace algest;

namespace {

/// A term with parameters at 1, each known to one of `deviations`.
lab::Variant with_term(const std::vector<double>& deviations) {
    lab::Variant out;
    lab::Amendment a{};
    a.effect = "load";
    for (const double sd : deviations) {
        a.names.emplace_back();
        a.names.back().name = "T" + std::to_string(a.names.size());
        out.model.parameters.emplace_back();
        out.model.parameters.back().name = a.names.back().name;
        out.fit.parameters.push_back(1);
        out.fit.sd.push_back(sd);
    }
    out.amendments = {a};
    return out;
}

}  // namespace

TEST_CASE("decide: a term may be nothing where every parameter is within three standard deviations of zero") {
    const lab::Variant hardly = with_term({0.34});   // 2.9 deviations
    REQUIRE(lab::may_be_nothing(hardly) != nullptr);
    CHECK(lab::may_be_nothing(hardly)->effect == "load");
    CHECK(lab::may_be_nothing(with_term({0.33})) == nullptr);          // 3.03
    CHECK(lab::may_be_nothing(with_term({0.5, 0.01})) == nullptr);     // one of two is known
    CHECK(lab::may_be_nothing(with_term({std::numeric_limits<double>::infinity()})) == nullptr);
}

TEST_CASE("decide: a scan, a state, a replacement and a constant are not measured from zero") {
    lab::Variant scanned = with_term({0.5});
    scanned.amendments[0].names[0].scanned = true;
    CHECK(lab::may_be_nothing(scanned) == nullptr);
    lab::Variant state = with_term({0.5});
    state.amendments[0].states.emplace_back();
    CHECK(lab::may_be_nothing(state) == nullptr);
    lab::Variant replaced = with_term({0.5});
    replaced.amendments[0].substitutions.emplace_back();
    CHECK(lab::may_be_nothing(replaced) == nullptr);
    lab::Variant freed = with_term({0.5});
    freed.amendments[0].freed = "K";
    CHECK(lab::may_be_nothing(freed) == nullptr);
}
