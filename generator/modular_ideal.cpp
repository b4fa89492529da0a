// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/modular_ideal.hpp"

#include <algorithm>
#include <numeric>

namespace algest::modular {

namespace {

int degree(const Exponents& e) { return std::accumulate(e.begin(), e.end(), 0); }

bool divides(const Exponents& a, const Exponents& b) {
    for (std::size_t k = 0; k < a.size(); ++k) if (a[k] > b[k]) return false;
    return true;
}

Exponents least_common_multiple(const Exponents& a, const Exponents& b) {
    Exponents out = a;
    for (std::size_t k = 0; k < a.size(); ++k) out[k] = std::max(a[k], b[k]);
    return out;
}

/// a - factor * x^shift * b
void subtract(Terms& a, const Terms& b, const Exponents& shift, Number factor) {
    for (const auto& [exponents, c] : b) {
        Exponents e = exponents;
        for (std::size_t k = 0; k < e.size(); ++k) e[k] += shift[k];
        const auto [place, fresh] = a.try_emplace(e, 0);
        place->second = place->second - factor * c;
        if (place->second.is_zero()) a.erase(place);
    }
}

Exponents quotient(const Exponents& a, const Exponents& b) {
    Exponents out = a;
    for (std::size_t k = 0; k < a.size(); ++k) out[k] -= b[k];
    return out;
}

/// The remainder modulo polynomials with leading coefficient 1.
Terms remainder(Terms p, const std::vector<Terms>& basis) {
    Terms out;
    while (!p.empty()) {
        const auto lead = *p.begin();
        const auto by = std::find_if(basis.begin(), basis.end(), [&](const Terms& b) { return divides(b.begin()->first, lead.first); });
        if (by != basis.end()) {
            subtract(p, *by, quotient(lead.first, by->begin()->first), lead.second);
        } else {
            out.insert(lead);
            p.erase(p.begin());
        }
    }
    return out;
}

void make_monic(Terms& p) {
    const Number scale = p.begin()->second.inverse();
    for (auto& [exponents, c] : p) c = c * scale;
}

struct Pair {
    int degree;
    std::size_t a;
    std::size_t b;
    friend bool operator<(const Pair& x, const Pair& y) { return x.degree != y.degree ? x.degree < y.degree : x.b != y.b ? x.b < y.b : x.a < y.a; }
};

/// Degree of a square-free polynomial with the same roots; coefficients lowest first, the last not zero.
int distinct_roots(const Vector& p) {
    Vector a = p;
    Vector b;
    for (std::size_t k = 1; k < p.size(); ++k) b.push_back(p[k] * Number(static_cast<std::int64_t>(k)));
    const auto trim = [](Vector& v) { while (!v.empty() && v.back().is_zero()) v.pop_back(); };
    trim(b);
    while (!b.empty()) {   // Euclid
        while (a.size() >= b.size()) {
            const Number factor = a.back() / b.back();
            const std::size_t shift = a.size() - b.size();
            for (std::size_t k = 0; k < b.size(); ++k) a[k + shift] = a[k + shift] - factor * b[k];
            a.pop_back();
            trim(a);
        }
        std::swap(a, b);
    }
    return static_cast<int>(p.size()) - static_cast<int>(a.size());
}

}  // namespace

bool Order::operator()(const Exponents& a, const Exponents& b) const {
    const int x = degree(a);
    const int y = degree(b);
    if (x != y) return x > y;
    for (std::size_t k = a.size(); k-- > 0;) if (a[k] != b[k]) return a[k] < b[k];
    return false;
}

Terms from(const Polynomial& p) {
    Terms out;
    for (const auto& [exponents, c] : p) {
        const Number value = from(c);
        if (!value.is_zero()) out.emplace(exponents, value);
    }
    return out;
}

Number value_at(const Terms& p, const Vector& point) {
    Number out = 0;
    for (const auto& [exponents, c] : p) {
        Number term = c;
        for (std::size_t k = 0; k < exponents.size(); ++k) term = term * point[k].power(static_cast<std::uint64_t>(exponents[k]));
        out = out + term;
    }
    return out;
}

std::optional<std::vector<Terms>> groebner_basis(std::vector<Terms> equations) {
    std::vector<Terms> basis;
    std::vector<Pair> pairs;
    const auto add = [&](Terms p) {
        make_monic(p);
        for (std::size_t k = 0; k < basis.size(); ++k) {
            const Exponents common = least_common_multiple(basis[k].begin()->first, p.begin()->first);
            const bool coprime = degree(common) == degree(basis[k].begin()->first) + degree(p.begin()->first);
            if (!coprime) pairs.push_back({degree(common), k, basis.size()});
        }
        std::make_heap(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return y < x; });
        basis.push_back(std::move(p));
    };
    std::erase_if(equations, [](const Terms& e) { return e.empty(); });
    std::stable_sort(equations.begin(), equations.end(), [](const Terms& a, const Terms& b) { return degree(a.begin()->first) < degree(b.begin()->first); });
    for (const Terms& e : equations) {
        Terms rest = remainder(e, basis);
        if (!rest.empty()) add(std::move(rest));
    }
    for (int done = 0; !pairs.empty(); ++done) {
        if (done == most_pairs) return std::nullopt;
        std::pop_heap(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return y < x; });
        const Pair pair = pairs.back();
        pairs.pop_back();
        const Exponents& a = basis[pair.a].begin()->first;
        const Exponents& b = basis[pair.b].begin()->first;
        const Exponents common = least_common_multiple(a, b);
        Terms s;
        subtract(s, basis[pair.a], quotient(common, a), Number(-1));
        subtract(s, basis[pair.b], quotient(common, b), 1);
        s = remainder(std::move(s), basis);
        if (!s.empty()) add(std::move(s));
    }
    return basis;
}

std::optional<int> values_of(std::size_t k, const std::vector<Terms>& basis, std::size_t variables) {
    std::map<Exponents, std::size_t, Order> columns;   // products that occur in remainders
    std::vector<Terms> powers = {remainder(Terms{{Exponents(variables, 0), 1}}, basis)};
    if (powers[0].empty()) return 0;
    for (int n = 1; n <= most_values + 1; ++n) {
        Exponents shift(variables, 0);
        shift[k] = 1;
        Terms next;
        subtract(next, powers.back(), shift, Number(-1));
        powers.push_back(remainder(std::move(next), basis));
        columns.clear();
        for (const Terms& p : powers) for (const auto& [exponents, c] : p) columns.try_emplace(exponents, columns.size());
        // the power is a combination of those before where elimination leaves nothing beside the record of what was taken
        RowSpace space;
        for (std::size_t row = 0; row < powers.size(); ++row) {
            Vector dense(columns.size() + powers.size());
            for (const auto& [exponents, c] : powers[row]) dense[columns.at(exponents)] = c;
            dense[columns.size() + row] = 1;
            const Vector rest = space.rest(dense);
            const bool dependent = std::all_of(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(columns.size()), [](Number x) { return x.is_zero(); });
            if (dependent) return distinct_roots(Vector(rest.begin() + static_cast<std::ptrdiff_t>(columns.size()), rest.end()));
            space.add(dense);
        }
    }
    return std::nullopt;
}

}  // namespace algest::modular
