// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/taylor_rank.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include "generator/dual_series.hpp"
#include "generator/ginac_exact.hpp"
#include "generator/structural_point.hpp"

namespace algest::structure {

namespace {

using GiNaC::ex;
using modular::Dual;
using modular::Number;
using modular::Series;

/// All patterns of signs up to here, 2^3 stretches. Of more signs as many patterns at random and one more for each sign: that many tell apart
/// what is linear in the signs.
constexpr std::size_t most_signs_tried_out = 3;

/// The series of one stretch, from its point on.
class Stretch {
public:
    Stretch(const std::vector<Explicit>& equations, Symbols& symbols, const Point& point, std::size_t length, std::size_t columns, std::size_t first_column)
        : equations_(equations), symbols_(symbols), point_(point), length_(length), columns_(columns), next_column_(first_column) {
        for (const Explicit& e : equations_) {
            for (int order = 0; order < e.leader.order; ++order) start_state({e.leader.signal, order});
        }
        for (const Explicit& e : equations_) rights_.push_back(node(e.right));
    }

    /// Taylor coefficients of each leader's signal, in the order of the equations.
    std::vector<Series> run() {
        std::vector<Series> out(equations_.size());
        for (std::size_t k = 0; k < length_; ++k) {
            for (auto& [jet, series] : states_) series.resize(std::max(series.size(), k + 1));
            for (std::size_t n = 0; n < nodes_.size(); ++n) nodes_[n].values.push_back(coefficient(nodes_[n], k));
            for (std::size_t e = 0; e < equations_.size(); ++e) {
                const Jet leader = equations_[e].leader;
                const Dual right = nodes_[rights_[e]].values[k];
                out[e].push_back(leader.order == 0 ? right : states_.at({leader.signal, 0})[k]);
                for (int order = 0; order < leader.order; ++order) {
                    const Dual slope = order + 1 == leader.order ? right : states_.at({leader.signal, order + 1})[k];
                    states_.at({leader.signal, order}).push_back(slope * Number(static_cast<std::int64_t>(k) + 1).inverse());
                }
            }
        }
        return out;
    }

private:
    enum class Operation { known, state, add, multiply, invert, exponential, logarithm, root, sine, cosine };
    struct Node {
        Operation operation;
        std::size_t a;
        std::size_t b;
        Jet jet;         // of a state
        Series values;
        Series given;    // of what is known beforehand
    };

    void start_state(Jet j) {
        Dual value(point_.jet(j), columns_);
        value.gradient[next_column_++] = 1;
        states_[j] = {value};
    }

    std::size_t add(Operation operation, std::size_t a = 0, std::size_t b = 0, Jet jet = {0, 0}) {
        nodes_.push_back({operation, a, b, jet, {}, {}});
        return nodes_.size() - 1;
    }

    std::size_t known(Series values) {
        const std::size_t n = add(Operation::known);
        nodes_[n].given = std::move(values);
        return n;
    }

    std::size_t constant(Dual value) {
        Series out(length_, Dual(0, columns_));
        out[0] = std::move(value);
        return known(std::move(out));
    }

    std::size_t node(const ex& e) {
        const auto done = known_.find(e);
        if (done != known_.end()) return done->second;
        const std::size_t n = compile(e);
        known_.emplace(e, n);
        return n;
    }

    std::size_t compile(const ex& e) {
        if (GiNaC::is_a<GiNaC::numeric>(e)) return constant(Dual(modular::from(from_ginac(e)), columns_));
        if (GiNaC::is_a<GiNaC::symbol>(e)) return compile_symbol(e);
        if (GiNaC::is_a<GiNaC::power>(e)) return compile_power(node(e.op(0)), GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int());
        const bool sum = GiNaC::is_a<GiNaC::add>(e);
        std::size_t out = node(e.op(0));
        for (std::size_t k = 1; k < e.nops(); ++k) {
            const std::size_t next = node(e.op(k));
            out = add(sum ? Operation::add : Operation::multiply, out, next);
        }
        return out;
    }

    std::size_t compile_power(std::size_t base, int exponent) {
        std::size_t out = base;
        for (int k = 1; k < std::abs(exponent); ++k) out = add(Operation::multiply, out, base);
        return exponent < 0 ? add(Operation::invert, out) : out;
    }

    std::size_t compile_symbol(const ex& s) {
        if (const auto j = symbols_.jet_of(s)) {
            if (states_.count(*j) > 0) return add(Operation::state, 0, 0, *j);
            return known(input(*j));
        }
        if (const auto a = symbols_.atom_of(s)) return compile_atom(*a);
        if (s.is_equal(symbols_.time())) {
            Series t(length_, Dual(0, columns_));
            t[0] = Dual(point_.time(), columns_);
            if (length_ > 1) t[1] = Dual(1, columns_);
            return known(std::move(t));
        }
        for (std::size_t k = 0; k < symbols_.parameters().size(); ++k) {
            if (!s.is_equal(symbols_.parameters()[k])) continue;
            Dual value(point_.parameter(k), columns_);
            value.gradient[k] = 1;
            return constant(value);
        }
        return constant(nuisance(s));
    }

    Dual nuisance(const ex& s) {
        for (std::size_t k = 0; k < symbols_.nuisances().size(); ++k) {
            if (!s.is_equal(symbols_.nuisances()[k])) continue;
            Dual value(point_.nuisance(k), columns_);
            value.gradient[symbols_.parameters().size() + k] = 1;
            return value;
        }
        throw std::logic_error("a symbol of no kind");
    }

    /// Of a signal that no equation moves: any function of time. Delayed by a parameter, it moves with that.
    Series input(Jet j) const {
        const int delay = symbols_.delay_parameter(j.signal);
        Series out;
        Number factorial = 1;
        for (int k = 0; k < static_cast<int>(length_); ++k) {
            if (k > 0) factorial = factorial * Number(k);
            Dual value(point_.jet({j.signal, j.order + k}) / factorial, columns_);
            if (delay >= 0) value.gradient[static_cast<std::size_t>(delay)] = Number(0) - point_.jet({j.signal, j.order + k + 1}) / factorial;
            out.push_back(value);
        }
        return out;
    }

    std::size_t compile_atom(std::size_t a) {
        const Atom atom = symbols_.atoms()[a];
        switch (atom.kind) {
            case Atom::Kind::sign: return constant(Dual(point_.sign(a), columns_));
            case Atom::Kind::exponential: return add(Operation::exponential, node(atom.argument));
            case Atom::Kind::logarithm: return add(Operation::logarithm, node(atom.argument));
            case Atom::Kind::root: return compile_root(atom.argument);
            case Atom::Kind::sine:
            case Atom::Kind::cosine: break;
        }
        const std::size_t argument = node(atom.argument);
        const auto pair = circles_.find(argument);
        std::size_t sine = 0;
        if (pair != circles_.end()) {
            sine = pair->second;
        } else {
            sine = add(Operation::sine, argument);
            add(Operation::cosine, argument);
            circles_[argument] = sine;
        }
        return atom.kind == Atom::Kind::sine ? sine : sine + 1;
    }

    std::size_t compile_root(const ex& argument) {
        if (GiNaC::is_a<GiNaC::numeric>(argument)) return constant(Dual(point_.root(argument, modular::from(from_ginac(argument))), columns_));
        return add(Operation::root, node(argument));
    }

    Dual coefficient(Node& n, std::size_t k) {
        const auto a = [&]() -> const Series& { return nodes_[n.a].values; };
        switch (n.operation) {
            case Operation::known: return n.given[k];
            case Operation::state: return states_.at(n.jet)[k];
            case Operation::add: return a()[k] + nodes_[n.b].values[k];
            case Operation::multiply: return modular::product(a(), nodes_[n.b].values, k);
            case Operation::invert: return modular::reciprocal(a(), n.values, k);
            case Operation::exponential: return k == 0 ? modular::start(point_.function(Atom::Kind::exponential, a()[0].value), a()[0], [](Number f) { return f; }) : modular::integrated(a(), n.values, k);
            case Operation::logarithm: return k == 0 ? modular::start(point_.function(Atom::Kind::logarithm, a()[0].value), a()[0], [&](Number) { return a()[0].value.inverse(); }) : modular::logarithm(a(), n.values, k);
            case Operation::root: return root(n, k);
            case Operation::sine: return circle(n, nodes_[static_cast<std::size_t>(&n - nodes_.data()) + 1], k, false);
            case Operation::cosine: return circle(n, nodes_[static_cast<std::size_t>(&n - nodes_.data()) - 1], k, true);
        }
        throw std::logic_error("an operation of no kind");
    }

    Dual root(const Node& n, std::size_t k) const {
        const Series& a = nodes_[n.a].values;
        if (k > 0) return modular::root(a, n.values, k);
        return modular::start(modular::root_of(a[0].value), a[0], [](Number f) { return (f + f).inverse(); });
    }

    /// Sine (the node before) and cosine of one argument: on the circle, by s' = c a', c' = -s a'.
    Dual circle(const Node& n, const Node& other, std::size_t k, bool is_cosine) {
        const Series& a = nodes_[n.a].values;
        if (k > 0) {
            const Dual slope = modular::integrated(a, other.values, k);
            return is_cosine ? Dual(0, columns_) - slope : slope;
        }
        const Number half = point_.function(Atom::Kind::sine, a[0].value);
        const Number sine = sine_of_half(half);
        const Number cosine = cosine_of_half(half);
        const Number slope = is_cosine ? Number(0) - sine : cosine;
        return modular::start(is_cosine ? cosine : sine, a[0], [slope](Number) { return slope; });
    }

    const std::vector<Explicit>& equations_;
    Symbols& symbols_;
    const Point& point_;
    std::size_t length_;
    std::size_t columns_;
    std::size_t next_column_;
    std::map<Jet, Series> states_;
    std::vector<Node> nodes_;
    std::map<ex, std::size_t, GiNaC::ex_is_less> known_;
    std::map<std::size_t, std::size_t> circles_;
    std::vector<std::size_t> rights_;
};

}  // namespace

std::optional<Sensitivity> sensitivity(const std::vector<Explicit>& equations, const std::vector<bool>& hidden, Symbols& symbols) {
    const std::vector<std::size_t> roots = roots_in(equations, symbols);
    Point point(symbols);
    if (!point.settle_parameters(roots)) return std::nullopt;
    std::size_t states = 0;
    for (const Explicit& e : equations) states += static_cast<std::size_t>(e.leader.order);
    const auto signs = static_cast<std::size_t>(std::count_if(symbols.atoms().begin(), symbols.atoms().end(), [](const Atom& a) { return a.kind == Atom::Kind::sign; }));
    const bool all_patterns = signs <= most_signs_tried_out;
    const std::size_t stretches = all_patterns ? std::size_t{1} << signs : (std::size_t{1} << most_signs_tried_out) + signs;
    const std::size_t parameters = symbols.parameters().size();
    const std::size_t own = parameters + symbols.nuisances().size();
    Sensitivity out;
    for (std::size_t k = 0; k < parameters; ++k) out.point.push_back(point.parameter(k));
    for (std::size_t k = 0; k < symbols.nuisances().size(); ++k) out.point.push_back(point.nuisance(k));
    out.columns = own + stretches * states;
    for (std::size_t s = 0; s < stretches; ++s) {
        const unsigned pattern = all_patterns ? static_cast<unsigned>(s) : modular::drawn({s}).value();
        if (!point.settle(s, pattern, roots)) return std::nullopt;
        const std::vector<Series> measured = Stretch(equations, symbols, point, own + states + 1, out.columns, own + s * states).run();
        for (std::size_t e = 0; e < measured.size(); ++e) {
            if (hidden[static_cast<std::size_t>(equations[e].leader.signal)]) continue;
            for (const Dual& coefficient : measured[e]) {
                if (!out.rows.add(coefficient.gradient)) continue;
                out.unknown_alone.emplace_back(coefficient.gradient.begin() + static_cast<std::ptrdiff_t>(parameters), coefficient.gradient.end());
            }
        }
    }
    return out;
}

}  // namespace algest::structure
