// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/free_run.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <utility>

#include "lab/input_jumps.hpp"
#include "lab/linear_motion.hpp"
#include "lab/motion.hpp"
#include "lab/past.hpp"

namespace algest::lab {

namespace {

using Stepper = boost::numeric::odeint::runge_kutta_dopri5<State>;

constexpr int most_steps_in_a_span = 20000;    ///< stiffer than that is a diverged run too,
constexpr std::size_t most_steps_a_sample = 30;    ///< and so is more than this on average

/// Where a relay stands.
enum class Mode { negative, holding, positive };

class Run {
public:
    Run(const OdeSystem& system, const std::vector<double>& parameters, const Drive& drive, const RunOptions& options)
        : system_(system), drive_(drive), options_(options), jumps_(system, parameters, drive.held), motion_(system, parameters), modes_(system.relays.size(), Mode::positive),
          slope_(system.states.size()), slope_ahead_(system.states.size()), error_(system.states.size()), span_(drive.period * static_cast<double>(options.stride)) {
        recorded_ = simulated_signals(system);
        set_delays(parameters);
        scale_ = options.scale;
        scale_.resize(system.states.size(), 1.0);
        farthest_ = options.farthest;
        farthest_.resize(system.states.size(), std::numeric_limits<double>::max());
        linear_ = breaks_.empty() && is_linear(system, drive.held) && (system.driven.empty() || options.stride == 1);
        for (const int s : system.driven) straight_ = straight_ || !drive.held[static_cast<std::size_t>(s)];
    }

    FreeRun over(const std::vector<double>& initial, const std::function<void(double)>& progress) {
        out_ = {std::vector<std::vector<double>>(drive_.values.size()), 0};
        State x = initial;
        const std::size_t end = options_.end > 0 ? options_.end : drive_.samples;
        step_ = span_;
        sample_ = options_.first;
        set_layers();
        for (std::size_t k = options_.first; k < end; k += options_.stride) {
            sample_ = k;
            if (k > options_.first) jumps_.at_sample(drive_, k, x);
            motion_.set_state(x);
            since_ = 0.0;
            set_driven(0.0);
            set_past();
            const bool finite = motion_.show_and_control();
            if (!finite && out_.samples > 0) break;
            record();
            ++out_.samples;
            if (!finite || k + options_.stride >= end) break;
            if (x.empty()) continue;   // outputs of what is recorded, and nothing moves
            choose_modes(x, 0.0);
            keep_slopes_ahead(x);
            if (!advance(x)) break;
            keep_past(x);
            if (progress && k % 1024 == 0) progress(static_cast<double>(k) / static_cast<double>(drive_.samples));
        }
        if (options_.effort != nullptr) options_.effort->spent += static_cast<double>(motion_.evaluations()) * static_cast<double>(system_.residual.operations.size()) + static_cast<double>(leaps_ * 2 * x.size() * x.size());
        return std::move(out_);
    }

private:
    /// Driven signals at `fraction` of the period that starts at the present sample.
    void set_driven(double fraction) {
        for (const int s : system_.driven) {
            const std::vector<double>& v = drive_.values[static_cast<std::size_t>(s)];
            const bool held = drive_.held[static_cast<std::size_t>(s)] || sample_ + 1 >= v.size();
            motion_.input(s) = held ? v[sample_] : v[sample_] + fraction * (v[sample_ + 1] - v[sample_]);
        }
        for (const InputDerivative& d : system_.input_derivatives) {   // between samples: of what is held, or runs straight
            const std::vector<double>& v = drive_.values[static_cast<std::size_t>(d.signal)];
            const bool held = d.order > 1 || drive_.held[static_cast<std::size_t>(d.signal)] || sample_ + 1 >= v.size();
            motion_.input(d.input) = held ? 0.0 : (v[sample_ + 1] - v[sample_]) / drive_.period;
        }
        for (std::size_t d = 0; d < system_.delays.size(); ++d) {
            if (!system_.delays[d].moves) motion_.delayed(d) = delayed_value(d, fraction);
        }
    }

    /// How long ago each delayed signal is, and where in a period such a signal has a sample: a step ends there.
    void set_delays(const std::vector<double>& parameters) {
        for (const DelayedSignal& d : system_.delays) {
            ago_.push_back(samples_ago(d.parameter < 0 ? d.by : parameters[static_cast<std::size_t>(d.parameter)], span_));
            if (!d.moves && ago_.back().rest > 0) breaks_.push_back(ago_.back().rest * span_);
            past_.emplace_back();
        }
        std::sort(breaks_.begin(), breaks_.end());
    }

    /// Of a recorded input, or of what a law has held so far.
    double delayed_value(std::size_t d, double fraction) const {
        const std::size_t s = static_cast<std::size_t>(system_.delays[d].signal);
        const std::vector<double>& recorded = drive_.values[s];
        if (!recorded.empty()) return past_value(recorded, drive_.held[s], sample_, fraction, since_, ago_[d], drive_.from_rest ? 0.0 : recorded.front());
        const std::vector<double>& held = out_.signals[s];
        return held.empty() ? 0.0 : past_value(held, true, sample_ - options_.first, fraction, since_, ago_[d], held.front());
    }

    std::size_t entry_of(int signal) const {
        std::size_t i = 0;
        while (system_.states[i].signal != signal || system_.states[i].order != 0) ++i;
        return i;
    }

    /// The past of signals that move, at the present sample.
    void set_past() {
        for (std::size_t d = 0; d < past_.size(); ++d) {
            if (!system_.delays[d].moves) continue;
            if (past_[d].value.empty()) {   // the run starts
                past_[d].value.push_back(motion_.input(system_.delays[d].signal));
                past_[d].slope_behind.push_back(0.0);
            }
            motion_.delayed(d) = past_value(past_[d], ago_[d]);
        }
    }

    void keep_slopes_ahead(const State& x) {
        bool asked = false;
        for (const DelayedSignal& d : system_.delays) asked = asked || d.moves;
        if (!asked) return;
        rate(x, slope_, 0.0);
        for (std::size_t d = 0; d < past_.size(); ++d) {
            if (system_.delays[d].moves) past_[d].slope_ahead.push_back(slope_[entry_of(system_.delays[d].signal)] * span_);
        }
    }

    /// After a step that ended at a sample.
    void keep_past(const State& x) {
        for (std::size_t d = 0; d < past_.size(); ++d) {
            if (!system_.delays[d].moves) continue;
            const std::size_t entry = entry_of(system_.delays[d].signal);
            past_[d].value.push_back(x[entry]);
            past_[d].slope_behind.push_back(slope_ahead_[entry] * span_);
        }
    }

    void record() {
        const auto keep = [&](int signal) { out_.signals[static_cast<std::size_t>(signal)].push_back(motion_.input(signal)); };
        for (const int s : recorded_) keep(s);
        for (const Law& law : system_.laws) keep(law.signal);
    }

    /// The typical size of a layer's argument: the largest that one state of its own typical size makes of it.
    void set_layers() {
        for (const Layer& l : system_.layers) {
            double size = 0;
            for (std::size_t i = 0; i < scale_.size(); ++i) {
                State x(scale_.size(), 0.0);
                x[i] = scale_[i];
                set_driven(0.0);
                motion_.set_state(x);
                motion_.evaluate();
                size = std::max(size, std::abs(motion_.argument(l.argument)));
            }
            motion_.input(l.width) = options_.layer_width * (size > 0 ? size : 1.0);
        }
    }

    /// Sets every relay for the rate at x.
    void set_relays(const State& x) {
        for (std::size_t r = 0; r < modes_.size(); ++r) {
            if (modes_[r] != Mode::holding) motion_.relay(r) = modes_[r] == Mode::positive ? 1.0 : -1.0;
        }
        for (std::size_t r = 0; r < modes_.size(); ++r) {
            if (modes_[r] == Mode::holding) motion_.relay(r) = std::clamp(motion_.holding_value(r, x, scale_), -1.0, 1.0);
        }
    }

    void rate(const State& x, State& out, double fraction) {
        set_driven(fraction);
        motion_.set_state(x);
        set_relays(x);
        motion_.set_state(x);   // holding relays have tried other states
        motion_.rate(out);
    }

    double argument_at(std::size_t r, const State& x, double fraction) {
        set_driven(fraction);
        motion_.set_state(x);
        motion_.evaluate();
        return motion_.argument(system_.relays[r].argument);
    }

    /// Beyond this an argument is not zero: rounding of a located switch.
    double argument_tolerance(std::size_t r) const { return 1e-9 * std::max(argument_scale_.size() > r ? argument_scale_[r] : 0.0, 1e-12); }

    /// At the start of a period, where inputs may jump: on which side each relay is, or whether it holds.
    void choose_modes(const State& x, double fraction) {
        argument_scale_.resize(modes_.size(), 0.0);
        for (std::size_t r = 0; r < modes_.size(); ++r) {
            const double g = argument_at(r, x, fraction);
            argument_scale_[r] = std::max(argument_scale_[r], std::abs(g));
            if (std::abs(g) > argument_tolerance(r)) modes_[r] = g > 0 ? Mode::positive : Mode::negative;
            else choose_at_zero(r, x);
        }
    }

    /// With the argument at zero: it holds where both sides push it back, else it leaves to the side that pulls.
    void choose_at_zero(std::size_t r, const State& x) {
        set_relays(x);
        const double value = motion_.holding_value(r, x, scale_);
        motion_.relay(r) = 1.0;
        const double up = motion_.argument_rate(r, x, scale_);
        if (std::abs(value) <= 1.0 && up <= 0) modes_[r] = Mode::holding;
        else modes_[r] = up > 0 ? Mode::positive : Mode::negative;
    }

    bool finite(const State& x) const {
        for (std::size_t i = 0; i < x.size(); ++i) if (!(std::abs(x[i]) <= farthest_[i])) return false;
        return true;
    }

    /// One step of size h from (x, t in the period); the largest error over the states, relative to the tolerance.
    double attempt(const State& x, double t, double h, State& next) {
        since_ = t / span_;
        const auto flow = [&](const State& s, State& out, double at) { rate(s, out, at / span_); };
        flow(x, slope_, t);   // afresh: a switch, or a step that was refused, may lie between this step and the last
        stepper_.do_step(flow, x, slope_, t, next, slope_ahead_, h, error_);
        double largest = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double size = options_.tolerance * (scale_[i] + std::abs(x[i]));
            largest = std::max(largest, std::abs(error_[i]) / size);
            if (!std::isfinite(next[i])) return std::numeric_limits<double>::infinity();
        }
        return largest;
    }

    /// The first relay that a step has carried to the other side; -1: none.
    int switched(const State& next, double t) {
        for (std::size_t r = 0; r < modes_.size(); ++r) {
            const double g = argument_at(r, next, t / span_);
            argument_scale_[r] = std::max(argument_scale_[r], std::abs(g));
            const double beyond = modes_[r] == Mode::positive ? -g : modes_[r] == Mode::negative ? g : std::abs(g);
            if (beyond > argument_tolerance(r)) return static_cast<int>(r);
        }
        return -1;
    }

    /// The exact step of a span, from what the rate changes by with each state.
    void set_linear_step(std::size_t count) {
        State rate(count);
        State moved(count);
        const State zero(count, 0.0);
        motion_.set_state(zero);
        motion_.rate(rate);
        Eigen::MatrixXd a(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
        for (std::size_t i = 0; i < count; ++i) {
            State x = zero;
            x[i] = scale_[i];
            motion_.set_state(x);
            motion_.rate(moved);
            for (std::size_t k = 0; k < count; ++k) a(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = (moved[k] - rate[k]) / scale_[k];
        }
        linear_step_ = linear_step(a, span_);   // of states in their typical sizes: digits are lost where a matrix is badly scaled
        const Eigen::Map<const Eigen::VectorXd> scale(scale_.data(), static_cast<Eigen::Index>(count));
        for (Eigen::MatrixXd* phi : {&linear_step_.phi1, &linear_step_.phi2}) *phi = scale.asDiagonal() * *phi * scale.cwiseInverse().asDiagonal();
    }

    /// A linear system through a span in one step; false where a relay holds, or would switch: smaller steps look where.
    bool leap(State& x) {
        if (std::find(modes_.begin(), modes_.end(), Mode::holding) != modes_.end()) return false;
        set_driven(0.0);
        set_relays(x);
        if (linear_step_.phi1.size() == 0) set_linear_step(x.size());
        motion_.set_state(x);
        motion_.rate(slope_);
        if (straight_) {
            set_driven(1.0);
            motion_.rate(slope_ahead_);
        }
        State next = x;
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (std::size_t k = 0; k < x.size(); ++k) {
                next[i] += linear_step_.phi1(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * slope_[k];
                if (straight_) next[i] += linear_step_.phi2(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * (slope_ahead_[k] - slope_[k]);
            }
        }
        ++leaps_;
        if (!modes_.empty() && switched(next, span_) >= 0) return false;
        x = std::move(next);
        return true;
    }

    /// Through the span to the next kept sample; false where the run diverges.
    bool advance(State& x) {
        if (linear_ && leap(x)) return finite(x);
        double from = 0;
        for (const double stop : breaks_) {
            if (!(stop > from)) continue;
            if (!advance(x, from, stop)) return false;
            from = stop;
            since_ = stop / span_;
            choose_modes(x, since_);
        }
        return advance(x, from, span_);
    }

    bool advance(State& x, double t, double end) {
        State next(x.size());
        for (int steps = 0; t < end - span_ * 1e-12; ++steps) {
            if (steps > most_steps_in_a_span || ++steps_taken_ > most_steps_a_sample * drive_.samples) return false;
            double h = std::min(step_, end - t);
            const double error = attempt(x, t, h, next);
            if (!(error <= 1.0)) {
                step_ = h * std::max(0.1, std::isfinite(error) ? 0.9 * std::pow(error, -0.2) : 0.1);
                if (step_ < 1e-12 * span_) return false;
                continue;
            }
            const int r = switched(next, t + h);
            if (r >= 0 && modes_[static_cast<std::size_t>(r)] != Mode::holding) {
                h = locate(x, t, h, static_cast<std::size_t>(r), next);
                x = next;
                t += h;
                set_driven(t / span_);
                choose_at_zero(static_cast<std::size_t>(r), x);
                if (!finite(x)) return false;
                continue;
            }
            if (r >= 0) {   // a held argument has broken away
                const double g = argument_at(static_cast<std::size_t>(r), next, (t + h) / span_);
                modes_[static_cast<std::size_t>(r)] = g > 0 ? Mode::positive : Mode::negative;
            }
            x = next;
            t += h;
            if (!finite(x)) return false;
            if (h == step_ || error < 0.1) step_ = std::max(step_, h * std::min(5.0, 0.9 * std::pow(std::max(error, 1e-10), -0.2)));
        }
        return true;
    }

    /// The part of the step after which the argument of relay r is zero: regula falsi on the step's size; leaves the state there.
    double locate(const State& x, double t, double h, std::size_t r, State& next) {
        double low = 0;
        double high = h;
        double g_low = argument_at(r, x, t / span_);
        double g_high = argument_at(r, next, (t + h) / span_);
        double at = h;
        int side = 0;
        for (int k = 0; k < 60; ++k) {
            at = g_high == g_low ? 0.5 * (low + high) : (low * g_high - high * g_low) / (g_high - g_low);
            if (!(at > low && at < high)) at = 0.5 * (low + high);
            attempt(x, t, at, next);
            const double g = argument_at(r, next, (t + at) / span_);
            if (std::abs(g) <= 0.5 * argument_tolerance(r) || high - low < 1e-14 * span_) break;
            if ((g > 0) == (g_high > 0)) {   // Illinois: halve the end that stays
                high = at;
                g_high = g;
                if (side == 1) g_low *= 0.5;
                side = 1;
            } else {
                low = at;
                g_low = g;
                if (side == -1) g_high *= 0.5;
                side = -1;
            }
        }
        return at;
    }

    const OdeSystem& system_;
    const Drive& drive_;
    const RunOptions& options_;
    StateJumps jumps_;
    FreeRun out_;
    Motion motion_;
    std::vector<Mode> modes_;
    Stepper stepper_;
    State slope_;
    State slope_ahead_;
    State error_;
    std::vector<double> scale_;
    std::vector<double> farthest_;
    std::vector<double> argument_scale_;
    std::vector<int> recorded_;          ///< signals that are kept, beside those of laws
    std::vector<SamplesAgo> ago_;        ///< by delayed signal
    std::vector<double> breaks_;         ///< s into a span
    std::vector<MovingPast> past_;       ///< by delayed signal; empty for those that do not move
    bool linear_ = false;                ///< while no relay switches
    bool straight_ = false;              ///< an input moves between samples
    LinearStep linear_step_;             ///< empty until it is needed
    std::size_t leaps_ = 0;
    double since_ = 0;                   ///< part of the span at which the present step began
    double span_;           ///< s, from one kept sample to the next
    std::size_t sample_ = 0;
    std::size_t steps_taken_ = 0;
    double step_ = 0;
};

}  // namespace

FreeRun free_run(const OdeSystem& system, const std::vector<double>& parameters, const std::vector<double>& initial, const Drive& drive,
                 const RunOptions& options, const std::function<void(double)>& progress) {
    return Run(system, parameters, drive, options).over(initial, progress);
}

}  // namespace algest::lab
