// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/ode_system.hpp"

#include <algorithm>
#include <map>

#include "generator/delay.hpp"
#include "generator/tape_builder.hpp"
#include "lab/input_jumps.hpp"
#include "lab/lone_argument.hpp"
#include "lab/outputs.hpp"

namespace algest::lab {

namespace {

using formula::Formula;
using formula::Kind;

template <class Use>
void each_node(const Formula& f, Use use) {
    use(f);
    for (const Formula& a : f->arguments) each_node(a, use);
}

template <class Use>
void each_node(const model::Equation& e, Use use) {
    each_node(e.sides.left, use);
    each_node(e.sides.right, use);
}

class Compiler {
public:
    Compiler(const model::Model& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

    std::optional<OdeSystem> run() {
        for (const model::Signal& s : model_.signals) {
            if (s.formula) return fail(s.at, "'" + s.name + "' is computed by a formula, which a simulation does not know", "write the formula in the equations");
        }
        if (model_.equations.empty()) return fail({}, "no equations", "a simulation needs equations of motion");
        const auto outputs = output_order(model_, diagnostics_);
        if (!outputs) return std::nullopt;
        outputs_ = *outputs;
        find_orders();
        if (!assign_signals()) return std::nullopt;
        list_states();
        if (!only_inputs_are_differentiated_besides()) return std::nullopt;
        if (!highest_stand_outside_functions() || !laws_see_states()) return std::nullopt;
        if (!find_delays()) return std::nullopt;
        number_inputs();
        if (!find_input_jumps(model_, motion_, tape_inputs_, out_, diagnostics_)) return std::nullopt;
        compile();
        return std::move(out_);
    }

private:
    std::nullopt_t fail(Position at, const std::string& what, const std::string& right) {
        diagnostics_.error(model_.path, at, what, right);
        return std::nullopt;
    }

    /// The highest order in which each signal is differentiated anywhere.
    void find_orders() {
        for (const model::Equation& e : model_.equations) {
            each_node(e, [&](const Formula& f) {
                if (formula::is_derivative(f)) {
                    int& order = orders_[model_.signal_index(f->arguments[0]->name)];
                    order = std::max(order, formula::derivative_order(f));
                }
            });
        }
    }

    /// Signals whose highest derivative stands in the equation, the first written one first; what is held between samples is a command, last.
    std::vector<int> candidates(const model::Equation& e) const {
        std::vector<int> out;
        each_node(e, [&](const Formula& f) {
            if (!formula::is_derivative(f)) return;
            const int signal = model_.signal_index(f->arguments[0]->name);
            if (orders_.at(signal) == formula::derivative_order(f) && std::find(out.begin(), out.end(), signal) == out.end()) out.push_back(signal);
        });
        std::stable_partition(out.begin(), out.end(), [&](int s) { return model_.signals[static_cast<std::size_t>(s)].hold != plan::Hold::zoh; });
        return out;
    }

    bool assign(std::size_t e, std::vector<bool>& tried) {
        for (const int signal : candidates(model_.equations[e])) {
            if (tried[static_cast<std::size_t>(signal)]) continue;
            tried[static_cast<std::size_t>(signal)] = true;
            const auto holder = equation_of_.find(signal);
            if (holder == equation_of_.end() || assign(holder->second, tried)) {
                equation_of_[signal] = e;
                return true;
            }
        }
        return false;
    }

    bool gives_an_output(std::size_t e) const { return std::find(outputs_.begin(), outputs_.end(), e) != outputs_.end(); }

    bool assign_signals() {
        for (std::size_t e = 0; e < model_.equations.size(); ++e) {
            if (gives_an_output(e)) continue;
            std::vector<bool> tried(model_.signals.size(), false);
            if (!assign(e, tried)) {
                fail(model_.equations[e].at, "equation '" + model_.equations[e].name + "' has no derivative left to give: each equation of motion moves one signal",
                     "write der(x) = ... for one signal in each equation, y = ... for what a sensor shows");
                return false;
            }
        }
        out_.gives.assign(model_.equations.size(), -1);
        for (const std::size_t e : outputs_) out_.gives[e] = output_of(model_, model_.equations[e]);
        for (const auto& [signal, e] : equation_of_) out_.gives[e] = signal;
        for (std::size_t e = 0; e < model_.equations.size(); ++e) {
            if (!gives_an_output(e)) motion_.push_back(&model_.equations[e]);
            if (!gives_an_output(e)) out_.moving.push_back(out_.gives[e]);
        }
        return true;
    }

    bool moves(int signal) const { return std::find(out_.moving.begin(), out_.moving.end(), signal) != out_.moving.end(); }

    void list_states() {
        for (const int signal : out_.moving) {
            out_.highest.push_back(orders_.at(signal));
            for (int order = 0; order < orders_.at(signal); ++order) out_.states.push_back({signal, order});
        }
        std::vector<bool> used(model_.signals.size(), false);
        const auto mark = [&](const Formula& f) {
            if (f->kind == Kind::name && model_.signal(f->name) != nullptr) used[static_cast<std::size_t>(model_.signal_index(f->name))] = true;
        };
        for (const model::Equation& e : model_.equations) each_node(e, mark);
        for (const model::Feedback& f : model_.feedback) each_node(f.law, mark);
        for (std::size_t s = 0; s < used.size(); ++s) {
            const bool fed = std::any_of(model_.feedback.begin(), model_.feedback.end(), [&](const model::Feedback& f) { return f.signal == model_.signals[s].name; });
            if (used[s] && std::find(out_.gives.begin(), out_.gives.end(), static_cast<int>(s)) == out_.gives.end() && !fed) out_.driven.push_back(static_cast<int>(s));
        }
    }

    bool only_inputs_are_differentiated_besides() {
        for (const auto& [signal, order] : orders_) {
            if (moves(signal) || std::find(out_.driven.begin(), out_.driven.end(), signal) != out_.driven.end()) continue;
            const std::string& name = model_.signals[static_cast<std::size_t>(signal)].name;
            fail(model_.signals[static_cast<std::size_t>(signal)].at, "'" + name + "' is differentiated, but a law sets it: its derivative cannot be simulated",
                 "write the model with a state instead of der(" + name + ")");
            return false;
        }
        return true;
    }

    bool highest_stand_outside_functions() {
        for (const model::Equation* equation : motion_) {
            for (const Formula* side : {&equation->sides.left, &equation->sides.right}) {
                if (!linear_in_highest(*side, *equation)) return false;
            }
        }
        return true;
    }

    /// A law may use signals and those derivatives that are states.
    bool laws_see_states() {
        bool good = true;
        for (const model::Feedback& f : model_.feedback) {
            if (moves(model_.signal_index(f.signal))) {
                fail(f.at, "the law sets '" + f.signal + "', which an equation moves", "a law sets an input");
                good = false;
            }
            each_node(f.law, [&](const Formula& g) {
                if (!formula::is_derivative(g)) return;
                const int signal = model_.signal_index(g->arguments[0]->name);
                if (moves(signal) && formula::derivative_order(g) < orders_.at(signal)) return;
                fail(f.places[std::min(static_cast<std::size_t>(g->offset), f.places.size() - 1)], "the law differentiates '" + g->arguments[0]->name + "' beyond what the model knows as a state",
                     "use a derivative of lower order, of a signal that an equation moves");
                good = false;
            });
        }
        return good;
    }

    bool is_highest(const Formula& f) const { return formula::is_derivative(f) && orders_.at(model_.signal_index(f->arguments[0]->name)) == formula::derivative_order(f); }

    bool has_highest(const Formula& f) const {
        bool found = false;
        each_node(f, [&](const Formula& g) { found = found || is_highest(g); });
        return found;
    }

    /// Sums, products with something else, quotients by something else.
    bool linear_in_highest(const Formula& f, const model::Equation& equation) {
        if (!has_highest(f) || is_highest(f)) return true;
        const auto refuse = [&] {
            fail(equation.place(f->offset), "the highest derivative stands nonlinearly", "write the equation linear in it");
            return false;
        };
        switch (f->kind) {
            case Kind::negate: return linear_in_highest(f->arguments[0], equation);
            case Kind::add:
            case Kind::subtract: return linear_in_highest(f->arguments[0], equation) && linear_in_highest(f->arguments[1], equation);
            case Kind::multiply: {
                if (has_highest(f->arguments[0]) && has_highest(f->arguments[1])) return refuse();
                const Formula& other = has_highest(f->arguments[0]) ? f->arguments[1] : f->arguments[0];
                each_node(other, [&](const Formula& g) {
                    if (g->kind == Kind::name && model_.signal(g->name) != nullptr) out_.constant_mass = false;
                });
                return linear_in_highest(has_highest(f->arguments[0]) ? f->arguments[0] : f->arguments[1], equation);
            }
            case Kind::divide: {
                if (has_highest(f->arguments[1])) return refuse();
                each_node(f->arguments[1], [&](const Formula& g) {
                    if (g->kind == Kind::name && model_.signal(g->name) != nullptr) out_.constant_mass = false;
                });
                return linear_in_highest(f->arguments[0], equation);
            }
            default: return refuse();
        }
    }

    /// A delay equation is not simulated: what moves may be delayed where samples are taken, by a sensor or a law, and nowhere else.
    bool find_delays() {
        for (std::size_t e = 0; e < model_.equations.size(); ++e) {
            const model::Equation& equation = model_.equations[e];
            std::vector<model::Delay> own;
            for (const Formula* side : {&equation.sides.left, &equation.sides.right}) model::add_delays(model_, *side, own);
            for (const model::Delay& d : own) {
                const std::string name = quoted(d.call->arguments[0]->name);
                if (is_output(model_, d.signal)) {
                    fail(equation.place(d.call->offset), name + " is an output, and its past is not kept", "delay what it is made of");
                    return false;
                }
                if (!moves(d.signal) || gives_an_output(e)) continue;
                fail(equation.place(d.call->offset), name + " is delayed in an equation of motion, and an equation moves it: a delay equation cannot be simulated",
                     "delay an input, delay what a sensor shows (y = delay(x, 0.01)), or add a state that lags");
                return false;
            }
            for (const Formula* side : {&equation.sides.left, &equation.sides.right}) model::add_delays(model_, *side, delays_);
        }
        for (const model::Feedback& f : model_.feedback) model::add_delays(model_, f.law, delays_);
        for (const model::Delay& d : delays_) {
            out_.delays.push_back({d.signal, d.by ? exact::nearest(*d.by, plan::Scalar::float64) : 0.0, d.parameter, moves(d.signal)});
        }
        return true;
    }

    void number_inputs() {
        tape_inputs_.signal.resize(model_.signals.size());
        for (std::size_t s = 0; s < model_.signals.size(); ++s) tape_inputs_.signal[s] = out_.inputs++;
        for (std::size_t m = 0; m < out_.moving.size(); ++m) {
            out_.derivative_input.emplace_back();
            for (int order = 1; order <= out_.highest[m]; ++order) {
                out_.derivative_input.back().push_back(out_.inputs);
                tape_inputs_.derivative[{out_.moving[m], order}] = out_.inputs++;
            }
        }
        out_.parameter_input = out_.inputs;
        for (std::size_t p = 0; p < model_.parameters.size(); ++p) tape_inputs_.parameter.push_back(out_.inputs++);
        out_.delay_input = out_.inputs;
        for (const model::Delay& d : delays_) tape_inputs_.delay[{d.text, false}] = {plan::Op::input, out_.inputs++, -1, 0};
        for (const int signal : out_.driven) {
            for (int order = 1; orders_.count(signal) > 0 && order <= orders_.at(signal); ++order) {
                tape_inputs_.derivative[{signal, order}] = out_.inputs;
                out_.input_derivatives.push_back({signal, order, out_.inputs++});
            }
        }
        out_.relay_input = out_.inputs;
        number_relays();
        number_layers();
    }

    template <class Use>
    void each_switch(Use use) const {
        for (const model::Equation* e : motion_) {
            each_node(*e, [&](const Formula& f) {
                if (f->kind != Kind::call || f->name != "sgn" || !moves_with_state(f->arguments[0])) return;
                use(f, lone_argument(model_, f->arguments[0], [this](int signal) { return moves(signal); }));
            });
        }
    }

    /// One input for all that switch together: relays that held the same state would each take the whole of what holds it.
    void number_relays() {
        std::map<std::string, std::pair<int, bool>> known;   // input, and whether the argument whose sgn it is falls
        each_switch([&](const Formula& f, const std::optional<LoneArgument>& lone) {
            if (!lone) return;
            const auto [at, fresh] = known.emplace(lone->switches_at, std::pair{out_.inputs, lone->falls});
            tape_inputs_.relay[f.get()] = {at->second.first, lone->falls != at->second.second};
            if (!fresh) return;
            ++out_.inputs;
            relay_arguments_.push_back(f->arguments[0]);
        });
    }

    void number_layers() {
        std::map<std::string, int> known;
        each_switch([&](const Formula& f, const std::optional<LoneArgument>& lone) {
            if (lone) return;
            const auto [at, fresh] = known.emplace(formula::text(f->arguments[0]), out_.inputs);
            tape_inputs_.layer[f.get()] = at->second;
            if (!fresh) return;
            ++out_.inputs;
            layer_arguments_.push_back(f->arguments[0]);
        });
    }

    bool moves_with_state(const Formula& f) const {
        bool found = false;
        each_node(f, [&](const Formula& g) { found = found || (g->kind == Kind::name && moves(model_.signal_index(g->name))); });
        return found;
    }

    void compile() {
        TapeBuilder tape(model_, plan::Scalar::float64, tape_inputs_);
        for (const model::Equation* e : motion_) {
            const int left = tape.formula(e->sides.left);
            const int right = tape.formula(e->sides.right);
            tape.result(tape.difference(left, right));
        }
        int result = static_cast<int>(out_.moving.size());
        for (const Formula& argument : relay_arguments_) {
            out_.relays.push_back({result++});
            tape.result(tape.formula(argument));
        }
        int width = out_.relay_input + static_cast<int>(out_.relays.size());
        for (const Formula& argument : layer_arguments_) {
            out_.layers.push_back({result++, width++});
            tape.result(tape.formula(argument));
        }
        out_.residual = tape.finish();
        for (const std::size_t e : outputs_) {
            TapeBuilder output(model_, plan::Scalar::float64, tape_inputs_);
            output.result(output.formula(model_.equations[e].sides.right));
            out_.outputs.push_back({out_.gives[e], output.finish()});
        }
        for (const model::Feedback& f : model_.feedback) {
            TapeBuilder law(model_, plan::Scalar::float64, tape_inputs_);
            law.result(law.formula(f.law));
            out_.laws.push_back({model_.signal_index(f.signal), law.finish()});
        }
    }

    const model::Model& model_;
    Diagnostics& diagnostics_;
    OdeSystem out_;
    std::map<int, int> orders_;
    std::map<int, std::size_t> equation_of_;
    std::vector<std::size_t> outputs_;               // equations that give an output, in the order of evaluation
    std::vector<const model::Equation*> motion_;     // the others
    std::vector<model::Delay> delays_;
    TapeInputs tape_inputs_;
    std::vector<Formula> relay_arguments_;
    std::vector<Formula> layer_arguments_;
};

}  // namespace

bool moves(const OdeSystem& system, std::size_t signal) { return std::find(system.moving.begin(), system.moving.end(), static_cast<int>(signal)) != system.moving.end(); }

std::vector<int> simulated_signals(const OdeSystem& system) {
    std::vector<int> out = system.moving;
    for (const Output& output : system.outputs) out.push_back(output.signal);
    return out;
}

std::optional<OdeSystem> ode_system(const model::Model& model, Diagnostics& diagnostics) { return Compiler(model, diagnostics).run(); }

}  // namespace algest::lab
