// SPDX-License-Identifier: GPL-3.0-or-later
// A plan's elimination as the runtime's arrays: for the emitter and for replay. No GiNaC.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "algest/elimination.hpp"
#include "generator/plan.hpp"

namespace algest::plan {

template <class S>
struct EliminationData {
    int parameters = 0;
    std::vector<algest::EliminationStage> stages = {};
    std::vector<algest::Alone<S>> alone = {};
    std::vector<std::uint16_t> column_of = {};
    std::vector<S> coefficient_of = {};
    std::vector<std::uint8_t> exponents = {};
    std::vector<S> terms = {};
    std::vector<std::uint8_t> factors = {};
    std::vector<S> sizes = {};

    /// Valid until this object changes, moves or ends.
    algest::Elimination<S> view() const {
        const auto over = [](const auto& v) { return algest::View<typename std::decay_t<decltype(v)>::value_type>{v.data(), static_cast<int>(v.size())}; };
        return {parameters, over(stages), over(alone), over(column_of), over(coefficient_of), over(exponents), over(terms), over(factors), over(sizes)};
    }
};

template <class S>
EliminationData<S> make_elimination(const std::optional<Elimination>& from) {
    EliminationData<S> out;
    if (!from) return out;
    const auto small = [](auto number) { return static_cast<std::uint16_t>(number); };
    out.parameters = static_cast<int>(from->sizes.size());
    for (const double size : from->sizes) out.sizes.push_back(static_cast<S>(size));
    for (const EliminationStage& s : from->stages) {
        const std::size_t factors = s.resultant.empty() ? 0 : s.resultant[0].factors.size();
        out.stages.push_back({small(s.first_column), small(s.columns), small(out.alone.size()), small(s.alone.size()), small(out.column_of.size()), small(s.summands.size()),
                              s.x < 0 ? algest::no_parameter : small(s.x), s.y < 0 ? algest::no_parameter : small(s.y), small((s.x_squared ? 1 : 0) + (s.y_squared ? 2 : 0)),
                              small(s.degree_x), small(s.degree_y), small(out.terms.size()), small(s.resultant.size()), small(out.factors.size()), small(factors),
                              small(s.resultant_degree), small(s.degree_of_first)});
        for (const EliminationAlone& a : s.alone) out.alone.push_back({small(a.parameter), small(a.squared ? 1 : 0), static_cast<S>(a.coefficient)});
        for (const EliminationSummand& a : s.summands) {
            out.column_of.push_back(small(a.column));
            out.coefficient_of.push_back(static_cast<S>(a.coefficient));
            for (const int e : a.exponents) out.exponents.push_back(static_cast<std::uint8_t>(e));
        }
        for (const EliminationTerm& t : s.resultant) {
            out.terms.push_back(static_cast<S>(t.coefficient));
            for (const int f : t.factors) out.factors.push_back(static_cast<std::uint8_t>(f));
        }
    }
    return out;
}

}  // namespace algest::plan
