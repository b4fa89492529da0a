// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/single_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace algest::generator {

namespace {

using exact::Rational;

constexpr int nodes = 256;
/// Below it a user has other worries; the orders n + kappa up to 2 stay below.
constexpr double most_without_a_word = 0.02;
constexpr double unit_roundoff = 0x1p-24;

/// What an equation's rows cancel at most, and the unknowns that stand in them.
struct Rows {
    Rational cancellation = 0;
    std::set<int> unknowns;
};

Rows rows_of(const plan::Plan& plan, int equation) {
    Rows out;
    for (const plan::Row& row : plan.rows) {
        if (row.equation != equation) continue;
        for (const plan::RowTerm& term : row.terms) {
            out.cancellation = std::max(out.cancellation, cancellation(kernel::coefficients(term.kernel)));
            if (term.lumped >= 0) out.unknowns.insert(term.lumped);
        }
    }
    return out;
}

/// "'R', 'L'": the parameters whose value comes from these unknowns.
std::string parameters_from(const std::set<int>& unknowns, const model::Model& model, const lumping::Lumping& lumping) {
    std::string out;
    for (std::size_t k = 0; k < model.parameters.size(); ++k) {
        const auto& inverse = lumping.inverse[k];
        const auto enters = [&](int u) { return uses(inverse->numerator, static_cast<std::size_t>(u)) || uses(inverse->denominator, static_cast<std::size_t>(u)); };
        if (!inverse || std::none_of(unknowns.begin(), unknowns.end(), enters)) continue;
        out += (out.empty() ? "'" : ", '") + model.parameters[k].name + "'";
    }
    return out;
}

}  // namespace

Rational cancellation(const kernel::Coefficients& of) {
    if (std::all_of(of.begin(), of.end(), [](const Rational& c) { return c == 0; })) return 0;
    Rational size = 0;
    for (int k = 0; k < nodes; ++k) size = size + cln::abs(kernel::value_at(of, Rational(2 * k + 1) / (2 * nodes)));
    int power = 0;
    while (kernel::moment(of, power) == 0) ++power;   // ends: a polynomial that every power annihilates is 0
    return size / nodes / cln::abs(kernel::moment(of, power));
}

std::vector<std::string> single_precision_notes(const model::Model& model, const lumping::Lumping& lumping, const plan::Plan& plan) {
    std::vector<std::string> out;
    if (plan.scalar != plan::Scalar::float32 || plan.functional != plan::Functional::annihilator) return out;
    const bool squared = plan.solve == algest::Solve::robust;
    const double amplified = plan.condition_limit * (squared ? plan.condition_limit : 1.0);
    for (std::size_t e = 0; e < plan.equations.size(); ++e) {
        const plan::Equation& equation = plan.equations[e];
        const Rows rows = rows_of(plan, static_cast<int>(e));
        const double rounding = unit_roundoff * cln::double_approx(rows.cancellation);
        const std::string parameters = parameters_from(rows.unknowns, model, lumping);
        if (rounding * amplified < most_without_a_word || parameters.empty()) continue;
        const double worst = 100.0 * rounding * amplified;
        const std::string advice = worst < 10.0 ? "a condition_limit that leaves what you can bear, or double, avoids it" : "use double";
        out.push_back(fmt::format("single precision: the rows of '{}' (n + kappa = {}) take differences of numbers {:.0f} times larger, so that rounding moves {} by up to about condition{} * {:.1g}, "
                                  "{} at the condition limit {:.4g}, at the worst; {}",
                                  equation.name, equation.n + equation.kappa, cln::double_approx(rows.cancellation), parameters, squared ? "^2" : "", rounding,
                                  worst < 100.0 ? fmt::format("{:.0f} %", worst) : std::string("more than all of it"), plan.condition_limit, advice));
    }
    return out;
}

}  // namespace algest::generator
