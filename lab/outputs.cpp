// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/outputs.hpp"

#include <algorithm>

namespace algest::lab {

namespace {

using formula::Formula;
using formula::Kind;

bool differentiates(const Formula& f) {
    return formula::is_derivative(f) || std::any_of(f->arguments.begin(), f->arguments.end(), differentiates);
}

/// Where a name stands first; null: nowhere.
const formula::Node* first(const Formula& f, const std::string& name) {
    if (f->kind == Kind::name && f->name == name) return f.get();
    for (const Formula& a : f->arguments) if (const formula::Node* found = first(a, name)) return found;
    return nullptr;
}

bool moves(const model::Model& model, const std::string& name) {
    const auto differentiated = [&](const Formula& f, const auto& self) -> bool {
        if (formula::is_derivative(f) && f->arguments[0]->name == name) return true;
        return std::any_of(f->arguments.begin(), f->arguments.end(), [&](const Formula& a) { return self(a, self); });
    };
    return std::any_of(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) {
        return differentiated(e.sides.left, differentiated) || differentiated(e.sides.right, differentiated);
    });
}

class Ordering {
public:
    Ordering(const model::Model& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics), state_(model.equations.size(), State::open) {}

    std::optional<std::vector<std::size_t>> run() {
        for (std::size_t e = 0; e < model_.equations.size(); ++e) {
            const int output = output_of(model_, model_.equations[e]);
            if (output >= 0 && !gives_alone(e, model_.signals[static_cast<std::size_t>(output)].name)) return std::nullopt;
        }
        for (const model::Equation& e : model_.equations) if (output_of(model_, e) < 0 && !sees_no_output(e)) return std::nullopt;
        for (std::size_t e = 0; e < model_.equations.size(); ++e) {
            if (output_of(model_, model_.equations[e]) >= 0 && !place(e)) return std::nullopt;
        }
        return order_;
    }

private:
    enum class State { open, entered, placed };

    bool fail(Position at, const std::string& what, const std::string& right) {
        diagnostics_.error(model_.path, at, what, right);
        return false;
    }

    bool gives_alone(std::size_t e, const std::string& name) {
        const Position at = model_.equations[e].place(model_.equations[e].sides.left->start);
        if (moves(model_, name)) return fail(at, quoted(name) + " is given here, and another equation moves it", "give the sensor a signal of its own: y = ... of the signal that moves");
        for (const model::Feedback& f : model_.feedback) if (f.signal == name) return fail(at, quoted(name) + " is given here, and a law sets it", "leave one of the two out");
        for (std::size_t other = 0; other < e; ++other) {
            if (output_of(model_, model_.equations[other]) == model_.signal_index(name)) return fail(at, "a second equation gives " + quoted(name), "one equation gives a signal");
        }
        return true;
    }

    bool sees_no_output(const model::Equation& equation) {
        for (const model::Equation& e : model_.equations) {
            const int output = output_of(model_, e);
            if (output < 0) continue;
            const std::string& name = model_.signals[static_cast<std::size_t>(output)].name;
            for (const Formula* side : {&equation.sides.left, &equation.sides.right}) {
                const formula::Node* found = first(*side, name);
                if (found == nullptr) continue;
                return fail(equation.place(found->offset), quoted(name) + " is what a sensor shows (equation " + quoted(e.name) + "), and the motion does not hang on it",
                            "write the formula of " + name + " here");
            }
        }
        return true;
    }

    /// Behind the outputs that it needs.
    bool place(std::size_t e) {
        if (state_[e] == State::placed) return true;
        const model::Equation& equation = model_.equations[e];
        state_[e] = State::entered;
        for (std::size_t other = 0; other < model_.equations.size(); ++other) {
            const int output = output_of(model_, model_.equations[other]);
            const formula::Node* found = output < 0 ? nullptr : first(equation.sides.right, model_.signals[static_cast<std::size_t>(output)].name);
            if (found == nullptr) continue;
            if (state_[other] == State::entered) {
                return fail(equation.place(found->offset), quoted(found->name) + " is given by itself", "write outputs one after the other, each of what is known");
            }
            if (!place(other)) return false;
        }
        state_[e] = State::placed;
        order_.push_back(e);
        return true;
    }

    const model::Model& model_;
    Diagnostics& diagnostics_;
    std::vector<State> state_;
    std::vector<std::size_t> order_;
};

}  // namespace

int output_of(const model::Model& model, const model::Equation& equation) {
    const Formula& left = equation.sides.left;
    if (left->kind != Kind::name || differentiates(equation.sides.right)) return -1;
    return model.signal_index(left->name);
}

bool is_output(const model::Model& model, int signal) {
    return std::any_of(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) { return output_of(model, e) == signal; });
}

std::optional<std::vector<std::size_t>> output_order(const model::Model& model, Diagnostics& diagnostics) { return Ordering(model, diagnostics).run(); }

}  // namespace algest::lab
