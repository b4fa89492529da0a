// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/noise_channels.hpp"

#include <algorithm>
#include <cmath>

#include "generator/parabola.hpp"

namespace algest::generator {

namespace {

using exact::Rational;

/// How a tape reads an input.
struct Reading {
    plan::Op op;
    int input;   ///< of the tape
    int ago;     ///< samples
};

/// Every row has noise of its own, and the unknowns a value to start from.
bool whitening_is_possible(const model::Model& model, const plan::Plan& plan, Diagnostics& diagnostics) {
    const Position at = model.estimator.at;
    for (const plan::Row& row : plan.rows) {
        const auto noisy = [&](const plan::RowTerm& t) {
            return std::any_of(plan.noise.begin(), plan.noise.end(), [&](const plan::NoiseChannel& c) { return c.signal == t.signal; });
        };
        if (std::any_of(row.terms.begin(), row.terms.end(), noisy)) continue;
        diagnostics.error(model.path, at, "rows of equation '" + plan.equations[static_cast<std::size_t>(row.equation)].name + "' have no noise, and whitening divides by it",
                          "declare noise = ... for a measured signal of it, or leave whiten out");
        return false;
    }
    for (const plan::Lumped& u : plan.lumped) {
        if (std::isfinite(u.initial)) continue;
        diagnostics.error(model.path, at, "whitening starts from the initial values, and " + u.meaning + " has none", "declare initial = ... for every parameter");
        return false;
    }
    return true;
}

/// A square solve of noisy signals has instants at which the rows are regular and noise decides. With a tenth, an error of 100 percent takes five
/// standard deviations or more. Against what size: that of the initial values, so that an unknown which is really zero is not refused; where one
/// has none, only the user knows whether it may be zero.
void limit_deviations(plan::Plan& plan) {
    const bool sized = std::all_of(plan.lumped.begin(), plan.lumped.end(), [](const plan::Lumped& u) { return std::isfinite(u.initial) && u.initial != 0.0; });
    if (sized) {
        plan.deviation_limit = exact::nearest(Rational(1) / 10, plan.scalar);
        return;
    }
    plan.notes.push_back("no deviation_limit, for not every parameter has an initial value: where the rows are nearly singular noise may move an ok estimate far; "
                         "deviation_limit = 0.1 makes such estimates singular");
}

/// What a reading makes of an impulse, sample by sample from the impulse on.
std::vector<Rational> response_of(const Reading& reading, const model::Model& model) {
    if (reading.op == plan::Op::derivative) {
        std::vector<Rational> out = parabola::impulse_response(parabola::Output::slope, parabola::memory);
        for (Rational& h : out) h = h / *model.period;
        return out;
    }
    std::vector<Rational> out(static_cast<std::size_t>(reading.ago / model.decimate), 0);
    out.push_back(1);
    return out;
}

/// Of what the windows are fed with: a sample, the mean of `decimate` of them, or that of an operating point. A mean over N samples has a deviation
/// of sigma/sqrt(N), the halves of its ends aside. A block that may drift by `steady` ends half of that away from its mean, and blocks on one approach
/// to rest drift alike: where rows are pooled that counts in full, as if it were noise.
Rational deviation_of_sample(const model::Model& model, const model::Signal& signal) {
    const Rational sigma = signal.deviation().value_or(Rational(0));
    const bool averages = model.estimator.functional == model::Functional::average;
    const Rational averaged = averages ? Rational(cln::floor1(*model.window / *model.period)) : Rational(model.decimate);
    const bool pooled = model.estimator.solve == model::Solver::least_squares || model.estimator.solve == model::Solver::elimination;
    const Rational drift = averages && pooled && signal.steady ? *signal.steady / 2 : Rational(0);
    if (cln::zerop(drift)) return averaged == 1 ? sigma : sigma * *exact::function_value("sqrt", 1 / averaged);
    return cln::zerop(sigma) ? drift : *exact::function_value("sqrt", sigma * sigma / averaged + drift * drift);
}

}  // namespace

NoiseChannels noise_channels(const model::Model& model, const std::vector<int>& input_of_signal, const std::vector<plan::PastInput>& past,
                             const std::vector<int>& window_operations, plan::Scalar scalar, TapeBuilder& tape) {
    NoiseChannels out;
    const int inputs = static_cast<int>(std::count_if(input_of_signal.begin(), input_of_signal.end(), [](int i) { return i >= 0; }));
    for (std::size_t s = 0; s < model.signals.size(); ++s) {
        const int input = input_of_signal[s];
        if (input < 0) continue;
        const Rational size = deviation_of_sample(model, model.signals[s]);
        if (cln::zerop(size)) continue;
        std::vector<Reading> readings = {{plan::Op::input, input, 0}, {plan::Op::previous, input, 1}, {plan::Op::derivative, input, 0}};
        for (std::size_t k = 0; k < past.size(); ++k) if (past[k].input == input) readings.push_back({plan::Op::input, inputs + static_cast<int>(k), past[k].samples});
        for (std::size_t w = 0; w < window_operations.size(); ++w) {
            if (model.decimate > 1 && tape.partial(window_operations[w], plan::Op::derivative, input) >= 0) return {{}, {}, model.signals[s].name};
            for (const Reading& reading : readings) {
                const int partial = tape.partial(window_operations[w], reading.op, reading.input);
                if (partial < 0) continue;
                const auto constant = tape.constant_value(partial);
                plan::NoiseChannel channel{input, static_cast<int>(w), -1, 0, 0.0};
                if (!constant) {
                    const auto known = std::find_if(out.partials.begin(), out.partials.end(), [&](const NoiseChannels::Partial& p) { return p.operation == partial; });
                    channel.partial = static_cast<int>(known - out.partials.begin());
                    if (known == out.partials.end()) out.partials.push_back({partial, static_cast<int>(w), input});
                }
                const std::vector<Rational> response = response_of(reading, model);
                for (std::size_t lag = 0; lag < response.size(); ++lag) {
                    if (cln::zerop(response[lag])) continue;
                    channel.lag = static_cast<int>(lag);
                    channel.factor = exact::nearest((constant ? *constant * size : size) * response[lag], scalar);
                    out.channels.push_back(channel);
                }
            }
        }
    }
    return out;
}

bool noise_suffices(const model::Model& model, const std::string& through_a_filter, plan::Plan& plan, Diagnostics& diagnostics) {
    const model::Estimator& e = model.estimator;
    if (!through_a_filter.empty()) {
        const std::string what = "the noise of '" + through_a_filter + "' goes through the parabola filter into means: its uncertainty is not known";
        if (e.uncertainty.value_or(false) || e.whiten || e.limits_deviation()) {
            diagnostics.error(model.path, e.at, what, "leave out uncertainty, whiten and deviation_limit, or the noise of that signal");
            return false;
        }
        plan.notes.push_back(what);
    }
    if (!plan.uncertain() && through_a_filter.empty() && (e.uncertainty.value_or(false) || e.whiten || e.limits_deviation())) {
        diagnostics.error(model.path, e.at, "the declared noise enters no row", "declare noise = ... for the signals that the equations measure");
        return false;
    }
    if (plan.whiten && plan.rows.size() == plan.lumped.size()) {
        plan.notes.push_back("whiten changes nothing: there are as many rows as unknowns");
        plan.whiten = false;
    }
    if (plan.whiten && !whitening_is_possible(model, plan, diagnostics)) return false;
    if (plan.uncertain() && plan.solve == algest::Solve::square && !e.deviation_limit) limit_deviations(plan);
    return true;
}

}  // namespace algest::generator
