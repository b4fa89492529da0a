// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/row_choice.hpp"

#include <algorithm>
#include <set>

namespace algest::generator {

namespace {

/// Unknowns that a row of each equation sees, and the largest matching of rows to unknowns.
class Matching {
public:
    explicit Matching(std::size_t unknowns) : row_of_(unknowns, -1) {}

    /// Adds a row that sees these unknowns; false if no unknown is left for it or for one that it pushes aside.
    bool add(const std::set<int>& sees) {
        rows_.push_back(sees);
        std::vector<bool> tried(row_of_.size(), false);
        return place(static_cast<int>(rows_.size()) - 1, tried);
    }

    int first_unmatched() const {
        const auto found = std::find(row_of_.begin(), row_of_.end(), -1);
        return found == row_of_.end() ? -1 : static_cast<int>(found - row_of_.begin());
    }

private:
    bool place(int row, std::vector<bool>& tried) {
        for (const int u : rows_[static_cast<std::size_t>(row)]) {
            const std::size_t k = static_cast<std::size_t>(u);
            if (tried[k]) continue;
            tried[k] = true;
            if (row_of_[k] < 0 || place(row_of_[k], tried)) {
                row_of_[k] = row;
                return true;
            }
        }
        return false;
    }

    std::vector<std::set<int>> rows_;
    std::vector<int> row_of_;
};

/// "R", or "R/L, from which R follows": the unknown and the parameters that are computed from it.
std::string in_the_users_words(const model::Model& model, const lumping::Lumping& lumping, int unknown) {
    std::vector<std::string> names;
    for (const model::Parameter& p : model.parameters) names.push_back(p.name);
    const std::size_t k = static_cast<std::size_t>(unknown);
    const std::string meaning = text(lumping.unknowns[k].meaning, names);
    std::vector<std::string> followers;
    for (std::size_t p = 0; p < names.size(); ++p) {
        const auto& from = lumping.inverse[p];
        const auto holds = [&](const Polynomial& side) { return !side.empty() && k < side.begin()->first.size() && uses(side, k); };
        if (from && (holds(from->numerator) || holds(from->denominator))) followers.push_back(names[p]);
    }
    if (followers == std::vector<std::string>{meaning}) return meaning;
    std::string list;
    for (const std::string& name : followers) list += (list.empty() ? "" : ", ") + name;
    return meaning + ", from which " + list + (followers.size() == 1 ? " follows" : " follow");
}

}  // namespace

std::optional<std::vector<ChosenRow>> choose_rows(const model::Model& model, const lumping::Lumping& lumping, Diagnostics& diagnostics) {
    const std::size_t equations = model.equations.size();
    std::vector<std::set<int>> sees(equations);
    for (std::size_t e = 0; e < equations; ++e) {
        for (const lumping::LumpedTerm& term : lumping.equations[e].terms) {
            for (const auto& [unknown, factor] : term.unknown) sees[e].insert(unknown);
        }
    }
    Matching matching(lumping.unknowns.size());
    std::vector<std::vector<int>> chosen(equations);
    std::size_t total = 0;
    std::vector<std::size_t> silent;
    const bool pooled = model.estimator.solve != model::Solver::square;
    for (std::size_t e = 0; e < equations; ++e) {
        if (!lumping.equations[e].used) continue;
        const model::RowChoice& rows = model.equations[e].rows;
        chosen[e] = rows.list;
        if (rows.count) for (int p = 1; p <= *rows.count; ++p) chosen[e].push_back(p);
        for (std::size_t k = 0; k < chosen[e].size(); ++k) (void)matching.add(sees[e]);
        total += chosen[e].size();
        if (!rows.count && rows.list.empty()) silent.push_back(e);
    }
    // In turn over the equations that do not say, while each round still places a row.
    for (bool placed = true; placed;) {
        placed = false;
        for (const std::size_t e : silent) {
            if (matching.first_unmatched() < 0) break;
            if (model.estimator.functional != model::Functional::annihilator && !chosen[e].empty()) continue;   // an instant, or a mean, is one row
            if (!matching.add(sees[e])) continue;
            chosen[e].push_back(static_cast<int>(chosen[e].size()) + 1);
            ++total;
            placed = true;
        }
    }
    // Rows of different instants add up when they are pooled: one row of an equation may then serve all its unknowns.
    const int over = matching.first_unmatched();
    if (over >= 0 && !pooled) {
        const std::size_t holds = static_cast<std::size_t>(std::find_if(sees.begin(), sees.end(), [&](const std::set<int>& s) { return s.count(over) > 0; }) - sees.begin());
        const model::Equation& equation = model.equations[holds];
        diagnostics.error(model.path, equation.rows.at.line > 0 ? equation.rows.at : equation.at,
                          "the rows cannot determine " + in_the_users_words(model, lumping, over) + ": " + std::to_string(total) + (total == 1 ? " row for " : " rows for ") + std::to_string(lumping.unknowns.size()) + " unknowns",
                          "ask for more rows of the equations that hold it, leave rows out, or pool instants with solve = \"least_squares\"");
        return std::nullopt;
    }
    std::vector<ChosenRow> out;
    for (std::size_t e = 0; e < equations; ++e) {
        if (lumping.equations[e].used && chosen[e].empty()) chosen[e].push_back(1);   // everything in it is determined elsewhere: one row still helps
        for (const int p : chosen[e]) out.push_back({static_cast<int>(e), p});
    }
    return out;
}

}  // namespace algest::generator
