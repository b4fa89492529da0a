// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/input_output.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace algest::structure {

namespace {

using GiNaC::ex;

/// Orders in which a signal stands in an expression, lowest first.
std::vector<int> orders(const ex& e, int signal, const Symbols& symbols) {
    std::vector<int> out;
    for (const Jet& j : symbols.jets(e)) if (j.signal == signal) out.push_back(j.order);
    return out;
}

bool has(const std::vector<bool>& hidden, int signal) { return signal < static_cast<int>(hidden.size()) && hidden[static_cast<std::size_t>(signal)]; }

/// A hidden signal, and the measured one whose equation gives a derivative of it.
struct Way {
    std::size_t hidden;     // indices of equations
    std::size_t measured;
    Jet gives;
};

class Elimination {
public:
    Elimination(std::vector<Explicit> equations, std::vector<bool> hidden, Symbols& symbols) : equations_(std::move(equations)), hidden_(std::move(hidden)), symbols_(symbols) {}

    std::optional<std::vector<ex>> run() {
        drop_unseen();
        while (std::any_of(equations_.begin(), equations_.end(), [&](const Explicit& e) { return has(hidden_, e.leader.signal); })) {
            if (const auto way = shortest()) take(*way);
            else if (!take_derivatives()) return std::nullopt;
        }
        std::vector<ex> out = zeros_;
        for (const Explicit& e : equations_) out.push_back(zero_of(e.leader, e.right));
        return out;
    }

private:
    void drop_unseen() {
        std::vector<bool> seen(equations_.size());
        for (std::size_t e = 0; e < equations_.size(); ++e) seen[e] = !has(hidden_, equations_[e].leader.signal);
        for (bool more = true; more;) {
            more = false;
            for (std::size_t h = 0; h < equations_.size(); ++h) {
                for (std::size_t e = 0; e < equations_.size() && !seen[h]; ++e) {
                    seen[h] = seen[e] && !orders(equations_[e].right, equations_[h].leader.signal, symbols_).empty();
                    more = more || seen[h];
                }
            }
        }
        std::vector<Explicit> kept;
        for (std::size_t e = 0; e < equations_.size(); ++e) if (seen[e]) kept.push_back(equations_[e]);
        equations_ = kept;
    }

    /// The lowest order in which the signal stands anywhere: what is below nobody sees.
    int lowest(int signal) const {
        int out = 1000;   // above every order: it stands nowhere
        for (const Explicit& e : equations_) {
            const auto these = orders(e.right, signal, symbols_);
            if (!these.empty()) out = std::min(out, these.front());
        }
        return out;
    }

    std::optional<Way> shortest() const {
        std::optional<Way> best;
        double least = 0;
        for (std::size_t h = 0; h < equations_.size(); ++h) {
            const int signal = equations_[h].leader.signal;
            if (!has(hidden_, signal)) continue;
            const Jet wanted{signal, lowest(signal)};
            for (std::size_t e = 0; e < equations_.size(); ++e) {
                const ex& right = equations_[e].right;
                if (has(hidden_, equations_[e].leader.signal) || orders(right, signal, symbols_) != std::vector<int>{wanted.order} || symbols_.inside_atom(right, wanted)) continue;
                const GiNaC::symbol x = symbols_.jet(wanted);
                const ex parts = over_one_bar(right).numer_denom();
                if (parts.op(0).degree(x) > 1 || parts.op(1).degree(x) > 1) continue;
                const double length = terms_at_most(right) + terms_at_most(equations_[h].right);
                if (best && length >= least) continue;
                best = {h, e, wanted};
                least = length;
            }
        }
        return best;
    }

    void take(const Way& way) {
        const Explicit own = equations_[way.hidden];
        const Explicit gives = equations_[way.measured];
        const GiNaC::symbol x = symbols_.jet(way.gives);
        const ex parts = over_one_bar(gives.right).numer_denom();
        const ex above = parts.op(0).expand();
        const ex below = parts.op(1).expand();
        const ex y = symbols_.jet(gives.leader);
        // y (b1 x + b0) = a1 x + a0
        const ex solved = (y * below.coeff(x, 0) - above.coeff(x, 0)) / (above.coeff(x, 1) - y * below.coeff(x, 1));
        std::vector<Explicit> others;
        for (std::size_t e = 0; e < equations_.size(); ++e) if (e != way.hidden && e != way.measured) others.push_back(equations_[e]);

        GiNaC::exmap by;   // each derivative of the hidden signal, below its leader
        ex value = over_one_bar(solved);
        const int highest = own.leader.order;
        for (int order = way.gives.order; order < highest; ++order) {
            by[symbols_.jet({own.leader.signal, order})] = value;
            value = over_one_bar(reduced(symbols_.derivative(value), others, symbols_));
        }
        const Jet raised{gives.leader.signal, gives.leader.order + highest - way.gives.order};
        const ex motion = over_one_bar(value - substituted(own.right, by)).numer().expand();
        const GiNaC::symbol top = symbols_.jet(raised);
        const Explicit fresh{raised, over_one_bar(-motion.coeff(top, 0) / motion.coeff(top, 1))};
        for (Explicit& e : others) e.right = over_one_bar(substituted(e.right, by));
        others.push_back(fresh);
        for (Explicit& e : others) e.right = over_one_bar(reduced(e.right, others, symbols_));
        equations_ = others;
    }

    /// leader - right, without its denominator.
    ex zero_of(Jet leader, const ex& right) {
        const ex parts = over_one_bar(right).numer_denom();
        return symbols_.jet(leader) * parts.op(1) - parts.op(0);
    }

    /// Hidden jets of an expression.
    std::vector<Jet> hidden_in(const ex& e) const {
        std::vector<Jet> out = symbols_.jets(e);
        std::erase_if(out, [&](Jet j) { return !has(hidden_, j.signal); });
        return out;
    }

    /// Where one measured signal alone sees what is hidden: as many derivatives of its equation as hidden states, and one equation remains.
    bool take_derivatives() {
        std::vector<std::size_t> seeing;
        std::size_t states = 0;
        for (std::size_t e = 0; e < equations_.size(); ++e) {
            if (has(hidden_, equations_[e].leader.signal)) states += static_cast<std::size_t>(equations_[e].leader.order - lowest(equations_[e].leader.signal));
            else if (!hidden_in(equations_[e].right).empty()) seeing.push_back(e);
        }
        if (seeing.size() != 1) return false;
        const Explicit one = equations_[seeing[0]];
        std::vector<Explicit> others = equations_;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(seeing[0]));
        std::vector<ex> open;
        ex right = one.right;
        for (std::size_t k = 0; k <= states; ++k) {
            open.push_back(symbols_.lowered(zero_of({one.leader.signal, one.leader.order + static_cast<int>(k)}, right)));
            right = over_one_bar(reduced(symbols_.derivative(right), others, symbols_));
        }
        if (!solve(open)) return false;
        const auto zero = factor_with(open[0], symbols_.jet({one.leader.signal, one.leader.order + static_cast<int>(states)}));
        if (!zero) return false;
        zeros_.push_back(*zero);
        std::erase_if(others, [&](const Explicit& e) { return has(hidden_, e.leader.signal); });
        equations_ = others;
        return true;
    }

    /// Solves for hidden jets, one after the other, until one equation is left.
    bool solve(std::vector<ex>& open) {
        while (open.size() > 1) {
            bool found = false;
            for (std::size_t e = 0; e < open.size() && !found; ++e) {
                for (const Jet& j : hidden_in(open[e])) {
                    const GiNaC::symbol x = symbols_.jet(j);
                    found = !symbols_.inside_atom(open[e], j) && open[e].degree(x) == 1;
                    if (!found) continue;
                    const ex value = over_one_bar(-open[e].coeff(x, 0) / open[e].coeff(x, 1));
                    open.erase(open.begin() + static_cast<std::ptrdiff_t>(e));
                    for (ex& other : open) other = symbols_.lowered(over_one_bar(substituted(other, {{x, value}})).numer());
                    break;
                }
            }
            if (!found) return false;
        }
        return hidden_in(open[0]).empty() && !open[0].is_zero();
    }

    /// The one factor that holds a symbol: the others come from denominators. Nullopt: there are two, and which of them holds is open.
    static std::optional<ex> factor_with(const ex& polynomial, const GiNaC::symbol& x) {
        if (terms_at_most(polynomial) > most_terms_to_factor) return std::nullopt;
        const ex factored = GiNaC::factor(polynomial);
        std::vector<ex> found;
        const auto take = [&](const ex& f) { if (f.has(x)) found.push_back(GiNaC::is_a<GiNaC::power>(f) ? f.op(0) : f); };
        if (GiNaC::is_a<GiNaC::mul>(factored)) for (const ex& f : factored) take(f);
        else take(factored);
        return found.size() == 1 ? std::optional(found[0].expand()) : std::nullopt;
    }
    static constexpr double most_terms_to_factor = 500;   // GiNaC takes seconds beyond

    ex substituted(const ex& e, const GiNaC::exmap& by) {
        if (terms_at_most(e) > most_terms) throw TooLong{};
        return symbols_.substituted(e, by);
    }

    std::vector<Explicit> equations_;
    std::vector<bool> hidden_;
    Symbols& symbols_;
    std::vector<ex> zeros_;
};

}  // namespace

std::optional<std::vector<ex>> input_output(std::vector<Explicit> equations, std::vector<bool> hidden, Symbols& symbols) {
    return Elimination(std::move(equations), std::move(hidden), symbols).run();
}

Coefficients coefficients(const ex& zero, const Symbols& symbols) {
    Coefficients out{{}, true};
    for (const std::size_t a : symbols.atoms_in(zero)) {
        for (const GiNaC::symbol& p : symbols.parameters()) out.whole = out.whole && !symbols.atoms()[a].argument.has(p);
        for (const GiNaC::symbol& c : symbols.nuisances()) out.whole = out.whole && !symbols.atoms()[a].argument.has(c);
    }
    if (terms_at_most(zero) > most_terms) throw TooLong{};
    std::map<ex, ex, GiNaC::ex_is_less> by_product;
    const auto take = [&](const ex& term) {
        ex product = 1;
        ex coefficient = 1;
        const auto sort_in = [&](const ex& factor) {
            const ex base = GiNaC::is_a<GiNaC::power>(factor) ? factor.op(0) : factor;
            const bool signal = symbols.jet_of(base) || symbols.atom_of(base) || base.is_equal(symbols.time());
            (signal ? product : coefficient) *= factor;
        };
        if (GiNaC::is_a<GiNaC::mul>(term)) for (const ex& factor : term) sort_in(factor);
        else sort_in(term);
        by_product[product] += coefficient;
    };
    const ex sum = symbols.lowered(zero);
    if (GiNaC::is_a<GiNaC::add>(sum)) for (const ex& term : sum) take(term);
    else take(sum);
    for (const auto& [product, coefficient] : by_product) if (!coefficient.expand().is_zero()) out.of_products.push_back(coefficient.expand());
    return out;
}

}  // namespace algest::structure
