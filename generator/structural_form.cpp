// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/structural_form.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace algest::structure {

namespace {

using formula::Formula;
using GiNaC::ex;

/// Of substitutions in one expression: each lowers an order or follows one equation further, and no model has that many of both.
constexpr int most_rounds = 50;

bool not_below(Jet j, Jet leader) { return j.signal == leader.signal && j.order >= leader.order; }

/// Signals in the order of the text.
void add_signals(const model::Model& model, const Formula& f, std::vector<int>& out) {
    if (f->kind == formula::Kind::name && model.signal_index(f->name) >= 0) out.push_back(model.signal_index(f->name));
    for (const Formula& a : f->arguments) add_signals(model, a, out);
}

class Solver {
public:
    Solver(const model::Model& model, const std::vector<bool>& hidden, Symbols& symbols, Diagnostics& diagnostics)
        : model_(model), hidden_(hidden), symbols_(symbols), diagnostics_(diagnostics) {}

    std::optional<Triangle> run() {
        std::vector<ex> zeros;
        for (const model::Equation& e : model_.equations) {
            const auto zero = of(e);
            if (!zero) return std::nullopt;
            zeros.push_back(*zero);
        }
        std::vector<std::size_t> order(zeros.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return highest(zeros[a]) < highest(zeros[b]); });
        for (const std::size_t e : order) {
            if (!solve(model_.equations[e], zeros[e])) return std::nullopt;
        }
        for (Explicit& e : out_.equations) e.right = over_one_bar(reduced(e.right, out_.equations, symbols_));
        for (std::size_t k = 0; k < implicit_.size(); ++k) find_ties(k);
        return out_;
    }

private:
    bool fail(const model::Equation& e, const std::string& what, const std::string& right) {
        diagnostics_.error(e.file, e.at, what, right);
        return false;
    }

    std::optional<ex> of(const model::Equation& e) {
        try {
            return over_one_bar(symbols_.of(e.sides.left) - symbols_.of(e.sides.right) - symbols_.perturbation(e.kappa)).numer();
        } catch (const GiNaC::pole_error&) {
            fail(e, "equation '" + e.name + "' divides by zero", "remove the term");
        } catch (const std::overflow_error&) {   // what GiNaC throws of 0/0
            fail(e, "equation '" + e.name + "' divides by zero", "remove the term");
        }
        return std::nullopt;
    }

    int highest(const ex& zero) const {
        int out = 0;
        for (const Jet& j : symbols_.jets(zero)) out = std::max(out, j.order);
        return out;
    }

    /// What the equation may be solved for, best first: highest order, then the order of the text.
    std::vector<Jet> candidates(const model::Equation& e, const ex& zero) const {
        std::vector<int> text;
        add_signals(model_, e.sides.left, text);
        add_signals(model_, e.sides.right, text);
        const auto place = [&](Jet j) { return std::find(text.begin(), text.end(), j.signal) - text.begin(); };
        const auto leads = [&](Jet j) { return std::any_of(out_.equations.begin(), out_.equations.end(), [&](const Explicit& known) { return known.leader.signal == j.signal; }); };
        std::vector<Jet> out;
        for (const Jet& j : symbols_.jets(zero)) {
            if (j.signal < static_cast<int>(model_.signals.size()) && !leads(j) && !symbols_.inside_atom(zero, j)) out.push_back(j);
        }
        std::stable_sort(out.begin(), out.end(), [&](Jet a, Jet b) { return a.order != b.order ? a.order > b.order : place(a) < place(b); });
        return out;
    }

    bool solve(const model::Equation& e, const ex& equation) {
        const ex zero = symbols_.lowered(over_one_bar(reduced(equation, out_.equations, symbols_)).numer());
        if (zero.is_zero()) return true;
        const std::vector<Jet> all = symbols_.jets(zero);
        for (const Jet& j : candidates(e, zero)) {
            const GiNaC::symbol x = symbols_.jet(j);
            if (std::any_of(all.begin(), all.end(), [&](Jet other) { return other.signal == j.signal && other.order > j.order; }) || zero.degree(x) != 1) continue;
            out_.equations.push_back({j, over_one_bar(-zero.coeff(x, 0) / zero.coeff(x, 1))});
            for (Explicit& other : out_.equations) other.right = over_one_bar(reduced(other.right, out_.equations, symbols_));
            return true;
        }
        const bool in_sight = std::none_of(all.begin(), all.end(), [&](Jet j) { return j.signal < static_cast<int>(hidden_.size()) && hidden_[static_cast<std::size_t>(j.signal)]; });
        if (all.empty()) return fail(e, "equation '" + e.name + "' says nothing about a signal once the others hold", "remove it, or mend what contradicts it");
        if (!in_sight) return fail(e, "equation '" + e.name + "' cannot be solved for a derivative that it is linear in, and it holds a hidden signal", "write der(x) = ... of one signal in each equation");
        out_.implicit.push_back(zero);
        implicit_.push_back(&e);
        return true;
    }

    bool holds(const ex& e, int signal) const {
        const std::vector<Jet> all = symbols_.jets(e);
        return std::any_of(all.begin(), all.end(), [&](Jet j) { return j.signal == signal; });
    }

    /// Signals that an equation which is solved for nothing has in common with others.
    void find_ties(std::size_t k) {
        for (const Jet& j : symbols_.jets(out_.implicit[k])) {
            bool moved = false;
            bool given = false;
            for (const Explicit& e : out_.equations) {
                if (e.leader.signal == j.signal || holds(e.right, j.signal)) (e.leader.order > 0 ? moved : given) = true;
            }
            for (std::size_t other = 0; other < out_.implicit.size(); ++other) moved = moved || (other != k && holds(out_.implicit[other], j.signal));
            if (!moved && !given) continue;
            const std::size_t plain = model_.signals.size();
            const auto s = static_cast<std::size_t>(j.signal);
            out_.ties.push_back({implicit_[k], s < plain ? model_.signals[s].name : symbols_.delays()[s - plain].text, !moved});
        }
    }

    const model::Model& model_;
    const std::vector<bool>& hidden_;
    Symbols& symbols_;
    Diagnostics& diagnostics_;
    Triangle out_;
    std::vector<const model::Equation*> implicit_;   // those of out_.implicit
};

}  // namespace

ex reduced(const ex& e, const std::vector<Explicit>& equations, Symbols& symbols) {
    ex out = e;
    for (int round = 0; round < most_rounds; ++round) {
        GiNaC::exmap by;
        for (const Jet& j : symbols.jets(out)) {
            for (const Explicit& known : equations) {
                if (!not_below(j, known.leader)) continue;
                ex right = known.right;
                for (int k = known.leader.order; k < j.order; ++k) right = symbols.derivative(right);
                by[symbols.jet(j)] = right;
            }
        }
        if (by.empty()) return out;
        if (terms_at_most(out) > most_terms) throw TooLong{};
        out = symbols.substituted(out, by);
    }
    throw TooLong{};
}

std::optional<Triangle> triangle(const model::Model& model, const std::vector<bool>& hidden, Symbols& symbols, Diagnostics& diagnostics) {
    return Solver(model, hidden, symbols, diagnostics).run();
}

}  // namespace algest::structure
