// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/input_jumps.hpp"

#include <algorithm>

namespace algest::lab {

namespace {

/// Order of the impulse that a derivative of an input holds; negative: none.
int level(const InputDerivative& d, bool held) { return d.order - (held ? 1 : 2); }

class Finder {
public:
    Finder(const model::Model& model, const std::vector<const model::Equation*>& motion, const TapeInputs& inputs, OdeSystem& system, Diagnostics& diagnostics)
        : model_(model), motion_(motion), inputs_(inputs), system_(system), diagnostics_(diagnostics), level_(motion.size(), -1) {}

    bool run() {
        for (const model::Equation* e : motion_) {
            residuals_.emplace_back(model_, plan::Scalar::float64, inputs_);
            const int left = residuals_.back().formula(e->sides.left);
            const int right = residuals_.back().formula(e->sides.right);
            results_.push_back(residuals_.back().difference(left, right));
        }
        if (!find_levels()) return false;
        system_.input_jumps.level = level_;
        system_.input_jumps.factors.resize(motion_.size());
        for (std::size_t e = 0; e < motion_.size(); ++e) {
            if (level_[e] >= 0 && !factors(e)) return false;
        }
        return true;
    }

private:
    bool held(int signal) const { return model_.signals[static_cast<std::size_t>(signal)].hold == plan::Hold::zoh; }

    int partial(std::size_t e, int input) { return residuals_[e].partial(results_[e], plan::Op::input, input); }

    /// By equation: order of the highest impulse in it. A signal that jumps passes on what its derivatives hold.
    bool find_levels() {
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t e = 0; e < motion_.size(); ++e) {
                int found = level_[e];
                for (const InputDerivative& d : system_.input_derivatives) if (partial(e, d.input) >= 0) found = std::max(found, level(d, held(d.signal)));
                for (std::size_t m = 0; m < motion_.size(); ++m) {
                    for (int k = 1; level_[m] >= 0 && k <= system_.highest[m]; ++k) {
                        if (partial(e, system_.derivative_input[m][static_cast<std::size_t>(k) - 1]) >= 0) found = std::max(found, level_[m] - (system_.highest[m] - k));
                    }
                }
                if (found >= system_.highest[e]) {
                    return fail(e, "a jump of an input would throw " + quoted(name(system_.moving[e])) + " out to infinity: the input is differentiated oftener than it",
                                "leave out a derivative of the input, or write the model with a state");
                }
                changed = changed || found != level_[e];
                level_[e] = found;
            }
        }
        for (const DelayedSignal& d : system_.delays) {
            for (std::size_t m = 0; m < motion_.size(); ++m) {
                if (!d.moves || system_.moving[m] != d.signal || level_[m] + 1 < system_.highest[m]) continue;
                return fail(m, quoted(name(d.signal)) + " jumps with an input that is differentiated, and is delayed as well", "delay what it is made of");
            }
        }
        return true;
    }

    /// The partial derivatives of a residual by all that holds an impulse; 0 for what holds none.
    bool factors(std::size_t e) {
        for (std::size_t m = 0; m < motion_.size(); ++m) {
            for (int k = 1; k <= system_.highest[m]; ++k) {
                const bool impulse = level_[m] >= 0 && k >= system_.highest[m] - level_[m];
                residuals_[e].result_or_zero(impulse ? partial(e, system_.derivative_input[m][static_cast<std::size_t>(k) - 1]) : -1);
            }
        }
        for (const InputDerivative& d : system_.input_derivatives) residuals_[e].result_or_zero(level(d, held(d.signal)) >= 0 ? partial(e, d.input) : -1);
        plan::Tape tape = residuals_[e].finish();
        for (const plan::Operation& o : tape.operations) {
            if (o.op != plan::Op::input || (o.a >= system_.parameter_input && o.a < system_.delay_input)) continue;
            return fail(e, "the derivative of an input that jumps has a factor that moves, or what jumps with it has", "declare hold = \"linear\" for the input, or write the model with a state");
        }
        system_.input_jumps.factors[e] = std::move(tape);
        return true;
    }

    const std::string& name(int signal) const { return model_.signals[static_cast<std::size_t>(signal)].name; }

    bool fail(std::size_t e, const std::string& what, const std::string& right) {
        diagnostics_.error(model_.path, motion_[e]->place(motion_[e]->sides.left->start), what, right);
        return false;
    }

    const model::Model& model_;
    const std::vector<const model::Equation*>& motion_;
    const TapeInputs& inputs_;
    OdeSystem& system_;
    Diagnostics& diagnostics_;
    std::vector<int> level_;               // by equation, and by the signal that it moves
    std::vector<TapeBuilder> residuals_;   // by equation
    std::vector<int> results_;             // left minus right
};

/// Factors as numbers, and what follows from them.
class Response {
public:
    Response(const OdeSystem& system, const std::vector<double>& parameters) : system_(system), count_(system.moving.size()) {
        std::vector<double> inputs(static_cast<std::size_t>(system.inputs), 0.0);
        std::copy(parameters.begin(), parameters.end(), inputs.begin() + system.parameter_input);
        Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(count_), static_cast<Eigen::Index>(count_));
        for (std::size_t e = 0; e < count_; ++e) {
            const plan::Tape& tape = system.input_jumps.factors[e];
            std::vector<double> values(tape.operations.size());
            factors_.emplace_back(tape.results.size());
            plan::evaluate<double>(tape, inputs.data(), nullptr, nullptr, values.data(), factors_.back().data());
            if (tape.results.empty()) continue;   // no impulse in this equation
            for (std::size_t m = 0; m < count_; ++m) mass(static_cast<Eigen::Index>(e), static_cast<Eigen::Index>(m)) = of_moving(e, m, system.highest[m]);
        }
        mass_.compute(mass);
        std::size_t at = 0;
        for (const int n : system.highest) {
            first_entry_.push_back(at);
            at += static_cast<std::size_t>(n);
        }
    }

    /// Jumps of the states where the signal's value, or its slope, jumps by one.
    Eigen::VectorXd to(int signal, bool held) const {
        Eigen::VectorXd jump = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(system_.states.size()));
        for (int q = *std::max_element(system_.input_jumps.level.begin(), system_.input_jumps.level.end()); q >= 0; --q) {
            Eigen::VectorXd rest = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count_));
            for (std::size_t e = 0; e < count_; ++e) {
                if (!factors_[e].empty()) rest[static_cast<Eigen::Index>(e)] = lower_orders(e, q, jump) + of_inputs(e, q, signal, held);
            }
            const Eigen::VectorXd found = -mass_.solve(rest);
            for (std::size_t m = 0; m < count_; ++m) {
                if (const int i = system_.highest[m] - 1 - q; i >= 0) jump[entry(m, i)] = found[static_cast<Eigen::Index>(m)];
            }
        }
        return jump;
    }

private:
    double of_moving(std::size_t e, std::size_t m, int order) const { return factors_[e][first_factor(m) + static_cast<std::size_t>(order) - 1]; }

    std::size_t first_factor(std::size_t m) const {
        std::size_t at = 0;
        for (std::size_t l = 0; l < m; ++l) at += static_cast<std::size_t>(system_.highest[l]);
        return at;
    }

    Eigen::Index entry(std::size_t m, int order) const { return static_cast<Eigen::Index>(first_entry_[m]) + order; }

    /// What derivatives below the highest hold of the impulse's derivative q.
    double lower_orders(std::size_t e, int q, const Eigen::VectorXd& jump) const {
        double sum = 0;
        for (std::size_t m = 0; m < count_; ++m) {
            for (int k = q + 1; k < system_.highest[m]; ++k) sum += of_moving(e, m, k) * jump[entry(m, k - 1 - q)];
        }
        return sum;
    }

    double of_inputs(std::size_t e, int q, int signal, bool held) const {
        double sum = 0;
        for (std::size_t d = 0; d < system_.input_derivatives.size(); ++d) {
            const InputDerivative& u = system_.input_derivatives[d];
            if (u.signal == signal && level(u, held) == q) sum += factors_[e][first_factor(count_) + d];
        }
        return sum;
    }

    const OdeSystem& system_;
    std::size_t count_;
    std::vector<std::vector<double>> factors_;   // by equation: of the derivatives of every moving signal, then of the inputs
    std::vector<std::size_t> first_entry_;       // by moving signal: its state of order 0
    Eigen::PartialPivLU<Eigen::MatrixXd> mass_;
};

}  // namespace

bool find_input_jumps(const model::Model& model, const std::vector<const model::Equation*>& motion, const TapeInputs& inputs, OdeSystem& system,
                      Diagnostics& diagnostics) {
    return Finder(model, motion, inputs, system, diagnostics).run();
}

StateJumps::StateJumps(const OdeSystem& system, const std::vector<double>& parameters, const std::vector<bool>& held) {
    const bool none = std::all_of(system.input_jumps.level.begin(), system.input_jumps.level.end(), [](int q) { return q < 0; });
    if (none) return;
    const Response response(system, parameters);
    for (const InputDerivative& d : system.input_derivatives) {
        const bool known = std::any_of(inputs_.begin(), inputs_.end(), [&](const OfInput& u) { return u.signal == d.signal; });
        if (!known) inputs_.push_back({d.signal, response.to(d.signal, held[static_cast<std::size_t>(d.signal)])});
    }
}

void StateJumps::at_sample(const Drive& drive, std::size_t sample, std::vector<double>& x) const {
    for (const OfInput& u : inputs_) {
        const std::vector<double>& v = drive.values[static_cast<std::size_t>(u.signal)];
        double jump = v[sample] - v[sample - 1];
        if (!drive.held[static_cast<std::size_t>(u.signal)]) jump = sample + 1 < v.size() ? (v[sample + 1] - v[sample] - jump) / drive.period : 0.0;
        if (jump == 0.0) continue;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += u.response[static_cast<Eigen::Index>(i)] * jump;
    }
}

}  // namespace algest::lab
