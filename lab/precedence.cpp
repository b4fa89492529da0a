// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/precedence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/declared_start.hpp"

namespace algest::lab {

namespace {

constexpr double unseen_by_rows = 4;      ///< F statistic that chance reaches once in twenty
constexpr double leaks_through = 0.03;    ///< of its strength in the right place, that an effect shows beside a noisy coupling: 0.0045 of gravity on the load, seen at the motor; chosen above
constexpr double beyond_doubt = 40;       ///< twice a gain in log-likelihood: of two parameters more, chance has 14 in one case of a thousand. Where dry friction was
                                          ///< true, falling friction came to 10 at most; where falling friction was, and validation told nothing, to 82
constexpr double the_same = 1e-3;         ///< of the validation error: fits stop at 1e-4 of their cost; two accounts that differ by less are one
constexpr double starts_agree = 10.8;     ///< squared distance from each declared start that an account may have which keeps to it: chance has more in one case of a thousand
constexpr double rows_are_sure = 9.2;     ///< by which another one is larger: a likelihood ratio of exp(9.2/2), 100 to 1

/// The amendments of v that are not of `other`.
std::vector<const Amendment*> own(const Variant& v, const Variant& other) {
    std::vector<const Amendment*> out;
    for (const Amendment& a : v.amendments) {
        const bool shared = std::any_of(other.amendments.begin(), other.amendments.end(), [&](const Amendment& b) { return identity(a) == identity(b); });
        if (!shared) out.push_back(&a);
    }
    return out;
}

/// The same effect, last of both, in two places.
bool same_elsewhere(const Variant& a, const Variant& b) {
    return a.amendments.back().effect == b.amendments.back().effect && a.amendments.back().equations != b.amendments.back().equations;
}

/// Twice the gain in log-likelihood that the declared starts give a over b. Of accounts of which one corrects a sensor: what that shows at the start is what they tell
/// apart, and the free start of a fit forgets it. Starts that neither account keeps to were not meant, nor those of which one of the two says nothing.
double start_gain(const Variant& a, const Variant& b) {
    if (corrects_a_sensor(a) == corrects_a_sensor(b)) return 0;
    const auto of_b = away_from_declared_start(b);
    double gain = 0;
    bool a_keeps = true;
    bool b_keeps = true;
    for (const auto& [signal, away] : away_from_declared_start(a)) {
        const auto other = of_b.find(signal);
        if (other == of_b.end()) continue;
        gain += other->second - away;
        a_keeps = a_keeps && away < starts_agree;
        b_keeps = b_keeps && other->second < starts_agree;
    }
    return a_keeps || b_keeps ? gain : 0;
}

/// Twice the gain in log-likelihood of a over b on the rows that both were fitted to, and by the starts that are declared.
double fitted_gain(const Variant& a, const Variant& b) { return log_gain(a.fit, b.fit) + start_gain(a, b); }

bool rows_prefer(const Contender& a, const Contender& b) {
    const bool hardly_seen = b.strength < unseen_by_rows || b.strength < leaks_through * a.strength;
    return same_elsewhere(*a.variant, *b.variant) && hardly_seen && a.strength - b.strength > rows_are_sure;
}

}  // namespace

int added_parameters(const Variant& v) {
    int out = 0;
    for (const Amendment& a : v.amendments) out += static_cast<int>(a.names.size());
    return out;
}

const Effect& Precedence::effect_of(const Amendment& amendment) const {
    return *std::find_if(effects_.begin(), effects_.end(), [&](const Effect& e) { return e.name == amendment.effect; });
}

int Precedence::held_back(const Variant& v) const {
    return static_cast<int>(std::count_if(v.amendments.begin(), v.amendments.end(), [&](const Amendment& a) { return effect_of(a).outside || effect_of(a).flexible(); }));
}

bool Precedence::are_rivals(const Variant& a, const Variant& b) const {
    const auto names = [](const Effect& one, const Effect& other) { return std::any_of(one.rivals.begin(), one.rivals.end(), [&](const Rival& r) { return r.name == other.name; }); };
    for (const Amendment* x : own(a, b)) {
        for (const Amendment* y : own(b, a)) if (names(effect_of(*x), effect_of(*y)) || names(effect_of(*y), effect_of(*x))) return true;
    }
    return false;
}

bool Precedence::yields(const Variant& a, const Variant& to) const {
    for (const Amendment* x : own(a, to)) {
        for (const Rival& r : effect_of(*x).rivals) {
            const std::vector<const Amendment*> others = own(to, a);
            if (r.first && std::any_of(others.begin(), others.end(), [&](const Amendment* y) { return y->effect == r.name; })) return true;
        }
    }
    return false;
}

bool Precedence::before(const Contender& a, const Contender& b) const {
    const auto freedom = [&](const Variant& v) { return std::pair(held_back(v), added_parameters(v)); };
    if (freedom(*a.variant) != freedom(*b.variant)) return freedom(*a.variant) < freedom(*b.variant);
    return yields(*b.variant, *a.variant) || rows_prefer(a, b);
}

bool Precedence::fitted_rows_tell(const Variant& a, const Variant& b) const {
    const bool no_freer = held_back(a) == held_back(b) || added_parameters(a) <= added_parameters(b);
    return no_freer && a.amendments.size() == b.amendments.size() && fitted_gain(a, b) > beyond_doubt;
}

Precedence::Standing Precedence::beside(const Contender& named, const Contender& other) const {
    const bool plainer = held_back(*named.variant) < held_back(*other.variant) || yields(*other.variant, *named.variant);
    if (plainer) {
        const bool nearer = added_parameters(*other.variant) <= added_parameters(*named.variant) && fitted_gain(*other.variant, *named.variant) > rows_are_sure;
        if (nearer && are_rivals(*named.variant, *other.variant)) return Standing::rival;
        const bool same = std::abs(other.variant->score.nrmse - named.variant->score.nrmse) < the_same * named.variant->score.nrmse;
        return same || are_rivals(*named.variant, *other.variant) ? Standing::as_well : Standing::nothing;
    }
    if (rows_prefer(named, other)) return Standing::as_well;
    return before(named, other) ? Standing::nothing : Standing::rival;
}

std::string Precedence::doubt(const Variant& named, const Variant& other) const {
    if (same_elsewhere(named, other)) {
        const Amendment& a = other.amendments.back();
        return fmt::format("{} in '{}' explains the long run as well, but over short windows that equation lacks nothing", a.effect, place(a, other.whole));
    }
    std::vector<std::string> names;
    for (const Amendment* a : own(other, named)) names.push_back(a->effect);
    return fmt::format("{} explains the recording as well: what is plainer is named before it", fmt::join(names, " with "));
}

}  // namespace algest::lab
