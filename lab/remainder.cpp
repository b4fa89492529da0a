// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/remainder.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "lab/effect.hpp"
#include "lab/selection.hpp"

namespace algest::lab {

namespace {

// Draws with seeds 417733, 5904323 and 63487186906843: where the right effect was named no law keeps more than 0.015 of the error (beside a delay),
// nor comes to a sureness above 36; where a law from outside was named after a usual one it keeps 0.046 and more, at a sureness above 900. Noise of the
// process reaches 44.
constexpr double left_in_run = 0.03;   ///< share of the run's squared error on the fitted rows
constexpr double sure = 100;           ///< Candidate::sureness: a t of 10

constexpr double as_near = 1.05;       ///< ratio of validation errors that is no difference, as between effects
constexpr std::size_t fitted_laws = 3; ///< of the strongest in the rows, and of the largest in the run: chosen, each costs a fit

struct Law {
    const char* kind;   ///< of the role `x` (lab/roles.hpp)
    const char* text;
};

const std::vector<Law> laws = {{"own", "{x}^2"},      {"own", "{x}*abs({x})"},      {"own", "{x}^3"},      {"own", "sgn({x})"},      {"own", "abs({x})"},
                               {"speed", "{x}^2"},    {"speed", "{x}*abs({x})"},    {"speed", "{x}^3"},    {"speed", "sgn({x})"},    {"speed", "abs({x})"},
                               {"position", "{x}^2"}, {"position", "{x}*abs({x})"}, {"position", "{x}^3"}, {"position", "sgn({x})"}, {"position", "abs({x})"},
                               {"input", "{x}^2"},    {"input", "{x}*abs({x})"},    {"input", "{x}^3"},    {"input", "sgn({x})"},    {"input", "abs({x})"},
                               {"time", "{x}"},       {"", "1"}};

/// As effects, for a screen knows how to weigh those.
std::vector<Effect> as_effects() {
    std::vector<Effect> out;
    for (const Law& law : laws) {
        Effect e;
        e.name = std::string(law.kind) + " " + law.text;
        if (law.kind[0] != '\0') e.roles["x"] = law.kind;
        e.term = std::string("-rest*") + law.text;
        e.parameters.push_back({"rest", "", std::nullopt});
        out.push_back(std::move(e));
    }
    return out;
}

/// Every law in every equation that may lack one.
std::vector<Candidate> weighed_laws(Workbench& bench, const Variant& v, const std::vector<Effect>& effects) {
    std::vector<Candidate> out = weighed_by_run(bench, v, effects);
    const auto defines = [&](const Candidate& c) { return is_kinematic(v.whole, v.whole.equations[c.binding.equations[0]]); };
    out.erase(std::remove_if(out.begin(), out.end(), defines), out.end());
    return out;
}

}  // namespace

std::optional<Remainder> remainder(Workbench& bench, const Variant& v) {
    const std::vector<Effect> effects = as_effects();
    const std::vector<Candidate> weighed = weighed_laws(bench, v, effects);
    const Candidate* largest = nullptr;
    for (const Candidate& c : weighed) {
        if (c.share > left_in_run && c.sureness > sure && (largest == nullptr || c.share > largest->share)) largest = &c;
    }
    if (largest == nullptr) return std::nullopt;
    const Amendment a = amendment(largest->binding, v.model, largest->scan);
    return Remainder{place(a, v.whole), change(a)};
}

std::optional<Remainder> plainer_law(Workbench& bench, const Variant& nominal, const Variant& named) {
    const std::vector<Effect> effects = as_effects();
    std::vector<Candidate> by_rows = weighed_laws(bench, nominal, effects);
    std::vector<Candidate> by_run = by_rows;
    std::stable_sort(by_run.begin(), by_run.end(), [](const Candidate& a, const Candidate& b) { return a.share > b.share; });
    const bool alone = named.amendments.size() == 1;
    by_rows.resize(std::min(by_rows.size(), fitted_laws));
    by_rows.insert(by_rows.end(), by_run.begin(), by_run.begin() + static_cast<std::ptrdiff_t>(std::min(by_run.size(), fitted_laws)));
    std::set<std::string> known;
    for (const Candidate& c : by_rows) {
        if (bench.used_up()) break;
        if (!known.insert(identity(amendment(c.binding, nominal.model, c.scan))).second) continue;
        const auto v = with_candidate(bench, nominal, c);
        if (!v) continue;
        const bool enough = alone ? worth_it(v->score, named.score, 1 / as_near) : v->score.nrmse < as_near * named.score.nrmse;
        if (enough) return Remainder{place(v->amendments[0], v->whole), change(v->amendments[0])};
    }
    return std::nullopt;
}

}  // namespace algest::lab
