// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/identifiability.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace algest::lumping {

namespace {

using equation::OperatorForm;
using equation::Term;
using exact::Rational;

bool is_alone(const OperatorForm& form, const equation::Product& product) {
    return product.size() == 1 && product[0].power == 1 && form.atoms[static_cast<std::size_t>(product[0].atom)].kind != equation::Atom::Kind::function;
}

/// A signal or derivative by itself, or a constant: what can be differentiated term by term.
bool all_alone(const OperatorForm& form) {
    return std::all_of(form.terms.begin(), form.terms.end(), [&](const Term& t) { return form.is_constant(t.product) || is_alone(form, t.product); });
}

/// "der(x,3)" for der(x) differentiated twice; otherwise the factors in the order of their texts: each equation numbers its
/// atoms by itself.
std::string differentiated_text(const model::Model& model, const OperatorForm& form, const equation::Product& product, int times) {
    if (is_alone(form, product)) {
        const equation::Atom& atom = form.atoms[static_cast<std::size_t>(product[0].atom)];
        return "der(" + model.signals[static_cast<std::size_t>(atom.signal)].name + "," + std::to_string(atom.order + times) + ")";
    }
    std::set<std::string> factors;
    for (const equation::Factor& f : product) factors.insert("(" + form.atoms[static_cast<std::size_t>(f.atom)].text + ")^" + std::to_string(f.power));
    std::string out;
    for (const std::string& f : factors) out += f;
    return out;
}

std::size_t rank(std::vector<std::vector<Rational>> rows, const std::vector<bool>& with_column) {
    std::size_t out = 0;
    for (std::size_t column = 0; column < with_column.size() && out < rows.size(); ++column) {
        if (!with_column[column]) continue;
        std::size_t pivot = out;
        while (pivot < rows.size() && cln::zerop(rows[pivot][column])) ++pivot;
        if (pivot == rows.size()) continue;
        std::swap(rows[out], rows[pivot]);
        for (std::size_t r = out + 1; r < rows.size(); ++r) {
            if (cln::zerop(rows[r][column])) continue;
            const Rational factor = rows[r][column] / rows[out][column];
            for (std::size_t j = column; j < with_column.size(); ++j) rows[r][j] = rows[r][j] - factor * rows[out][j];
        }
        ++out;
    }
    return out;
}

}  // namespace

bool kept(const model::Equation& equation, const OperatorForm& form, const Term& term) { return equation.kappa == 0 || !form.is_constant(term.product); }

bool without_parameters(const OperatorForm& form) {
    return std::all_of(form.terms.begin(), form.terms.end(), [](const Term& t) { return is_constant(t.coefficient); });
}

std::vector<Rational> generic_point(std::size_t parameters) {
    std::vector<Rational> point(parameters, 1);
    int prime = 101;
    for (Rational& x : point) {
        x = Rational(prime) / 7;
        do prime += 2;
        while (prime % 3 == 0 || prime % 5 == 0 || prime % 7 == 0 || prime % 11 == 0 || prime % 13 == 0);
    }
    return point;
}

Undetermined undetermined(const model::Model& model, const std::vector<OperatorForm>& forms, const Component& c, bool tied) {
    const std::vector<Rational> point = generic_point(model.parameters.size());
    std::map<std::pair<int, std::string>, std::vector<Rational>> rows;   // by equation and signal; a column for each parameter ...
    const std::size_t physical = c.parameters.size();
    std::size_t columns = physical;
    const auto entry = [&](int e, const std::string& signal, std::size_t column) -> Rational& {
        std::vector<Rational>& row = rows[{e, signal}];
        if (row.size() <= column) row.resize(column + 1, 0);
        return row[column];
    };
    for (const int e : c.equations) {
        const std::size_t index = static_cast<std::size_t>(e);
        for (const Term& term : forms[index].terms) {
            if (!kept(model.equations[index], forms[index], term)) continue;
            const std::string signal = differentiated_text(model, forms[index], term.product, 0);
            for (std::size_t k = 0; k < physical; ++k) entry(e, signal, k) = value_at(derivative(term.coefficient, static_cast<std::size_t>(c.parameters[k])), point);
            entry(e, signal, columns) = value_at(term.coefficient, point);   // ... one for each factor
        }
        ++columns;
    }
    for (const int e : c.equations) {   // ... and for each tie
        for (std::size_t r = 0; tied && r < forms.size(); ++r) {
            for (int times = 0; without_parameters(forms[r]) && times <= (all_alone(forms[r]) ? forms[static_cast<std::size_t>(e)].n : 0); ++times) {
                for (const Term& term : forms[r].terms) {
                    const bool erased = forms[r].is_constant(term.product) && (times > 0 || model.equations[static_cast<std::size_t>(e)].kappa > 0);
                    if (!erased) entry(e, differentiated_text(model, forms[r], term.product, times), columns) = term.coefficient.begin()->second;
                }
                ++columns;
            }
        }
    }
    std::vector<std::vector<Rational>> matrix;
    for (auto& [place, row] : rows) {
        row.resize(columns, 0);
        matrix.push_back(row);
    }
    std::vector<bool> counted(columns, true);
    const std::size_t full = rank(matrix, counted);
    std::fill(counted.begin(), counted.begin() + static_cast<std::ptrdiff_t>(physical), false);
    Undetermined out{physical - (full - rank(matrix, counted)), {}, {}};
    std::fill(counted.begin(), counted.end(), true);
    for (std::size_t k = 0; out.missing > 0 && k < physical; ++k) {   // those whose column adds nothing to the others
        counted[k] = false;
        if (rank(matrix, counted) == full) out.parameters.push_back(c.parameters[k]);
        counted[k] = true;
    }
    for (std::size_t k = 0; out.missing > 0 && k < physical; ++k) {   // columns that add nothing even together
        counted[k] = false;
        if (rank(matrix, counted) == full) out.enough.push_back(c.parameters[k]);
        else counted[k] = true;
    }
    return out;
}

std::string choice(const Undetermined& open, const std::vector<std::string>& names) {
    const auto list = [&](const std::vector<int>& parameters, const std::string& last) {
        std::string out;
        for (std::size_t k = 0; k < parameters.size(); ++k) out += (k == 0 ? "" : k + 1 == parameters.size() ? last : ", ") + names[static_cast<std::size_t>(parameters[k])];
        return out;
    };
    if (open.enough.size() == open.parameters.size()) return list(open.parameters, " and ");
    if (open.missing == 1) return "one of " + list(open.parameters, ", ");
    return std::to_string(open.missing) + " of " + list(open.parameters, ", ") + ", e.g. " + list(open.enough, " and ");
}

}  // namespace algest::lumping
