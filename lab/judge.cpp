// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/noise.hpp"
#include "lab/outputs.hpp"
#include "lab/recording_doubts.hpp"
#include "lab/structure.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr double most_of_it = 0.6;            ///< error against the nominal model's, for a name far from the floor
constexpr double too_far_for_noise = 2.0;     ///< gap over floor beyond which it takes more than the process's own noise
constexpr double no_noise = 50;               ///< F statistic of the weak form that noise does not reach
constexpr double half_of_it = 0.5;            ///< of the signals: a fit that has not settled there has explained nothing
constexpr double near_enough = 0.05;          ///< of the driving side of an equation: a residual that an engineer would be glad of

/// The equations of motion whose rows cannot be formed, for a signal of theirs is not measured.
std::vector<std::string> unseen(const Variant& v) {
    std::vector<std::string> out;
    for (std::size_t e = 0; e < v.model.equations.size(); ++e) {
        if (output_of(v.model, v.model.equations[e]) < 0 && !has_weak_form(v.model, v.bench, e)) out.push_back(v.model.equations[e].name);
    }
    return out;
}

}  // namespace

Verdict judge(const Workbench& bench, const Variant& nominal, const Selection& selection, Floor floor) {
    const Variant& best = selection.best;
    if (nominal.score.gap() <= at_the_floor) return Verdict::none;
    const bool spoken_for = std::any_of(selection.evidence.begin(), selection.evidence.end(), [](const Evidence& e) { return e.strength > no_noise; });
    const bool noise_alone = nominal.score.gap() <= too_far_for_noise || nominal.score.white();
    // Where no equation has rows nobody can look for a shape in them: then only an error that is white has none.
    bool has_rows = false;
    for (std::size_t e = 0; e < nominal.model.equations.size(); ++e) has_rows = has_rows || has_weak_form(nominal.model, nominal.bench, e);
    const bool shape_is_hidden = !has_rows && !nominal.score.white();
    const auto nothing = [&] { return spoken_for || selection.cut_short || !noise_alone || shape_is_hidden || structured(bench, nominal) ? Verdict::unknown : Verdict::none; };
    if (best.amendments.empty()) return nothing();
    const double left = best.score.nrmse / nominal.score.nrmse;
    if (std::isnan(left) || std::isnan(best.score.gap())) return Verdict::unknown;   // an error that is no number explains nothing
    if (bench.yardstick() == Yardstick::rows) {   // real machines: what is left is never noise alone
        if (left > most_of_it && best.score.nrmse > near_enough) return nothing();
    } else if (best.score.gap() > far_from_the_floor && !(floor == Floor::a_guess && left <= most_of_it)) {
        if ((best.score.gap() > too_far_for_noise && !best.score.white()) || structured(bench, best)) return Verdict::unknown;
        if (left > most_of_it) return nothing();
    }
    return selection.rivals.empty() ? Verdict::named : Verdict::ambiguous;
}

std::vector<std::string> doubts(const Workbench& bench, const Variant& nominal, const Selection& selection, Verdict verdict) {
    std::vector<std::string> out;
    const Variant& best = selection.best;
    const auto outputs = scored_outputs(nominal.model, nominal.bench);
    const std::vector<double> noise = noise_by_signal(nominal.model, nominal.bench);
    for (std::size_t o = 0; o < outputs.size(); ++o) {
        const std::size_t s = static_cast<std::size_t>(outputs[o]);
        const model::Signal& signal = nominal.model.signals[s];
        if (!declares_noise(signal)) out.push_back(fmt::format("'{}' declares no noise: {:.3g} {} is taken from its roughness, and what is called a gap hangs on it", signal.name, noise[s], signal.unit));
        if (bench.yardstick() != Yardstick::free_run) continue;
        const double over = best.score.error[o] / best.score.floor[o];
        const bool may_be_noise = best.score.white() && over > (verdict == Verdict::unknown ? far_from_the_floor : too_far_for_noise);
        if (may_be_noise) out.push_back(fmt::format("'{}' misses by {:.3g} times its declared noise, without any shape: is the noise that it declares too small?", signal.name, over));
        else if (over > far_from_the_floor && verdict != Verdict::unknown) out.push_back(fmt::format("'{}' is still {:.3g} times its noise away from the measurement: something else is missing, or the process itself is noisy", signal.name, over));
    }
    for (std::size_t r = 0; r < bench.recordings(); ++r) {
        const std::string where = bench.recordings() > 1 ? bench.recording(r).file + ": " : "";
        for (const std::string& doubt : recording_doubts(nominal.model, bench_of(nominal, r))) out.push_back(where + doubt);
    }
    if (verdict != Verdict::none || nominal.score.gap() > at_the_floor) {
        for (const std::string& e : unseen(nominal)) out.push_back(fmt::format("'{}' has a signal that is not measured: only the free run could look for what it lacks", e));
    }
    if (bench.yardstick() == Yardstick::free_run && !nominal.fit.sd.empty() && !nominal.fit.converged && nominal.score.nrmse > half_of_it) {
        out.push_back(fmt::format("the fit of the model as it is did not settle, {:.0f} percent of the signals away: what is called its gap is where the fit stopped; give initial values that are nearer, with min and max, "
                                  "or the noise and constants of the model another look", 100 * nominal.score.nrmse));
    }
    std::string unknown_parameters;
    for (std::size_t p = 0; p < nominal.fit.sd.size(); ++p) if (!std::isfinite(nominal.fit.sd[p])) unknown_parameters += (unknown_parameters.empty() ? "" : ", ") + nominal.model.parameters[p].name;
    if (!unknown_parameters.empty()) out.push_back(fmt::format("the model as it is: the data do not see {}, whose value is where the fit stopped", unknown_parameters));
    if (selection.cut_short) out.push_back("the search was stopped before every effect was tried, for its free runs take long: the recording is long, or the model stiff or unstable with what was fitted");
    if (bench.yardstick() == Yardstick::rows) {
        out.push_back(fmt::format("this machine does not forget a disturbance, so one long run adds up every small error: effects were decided by the residuals of the equations over short windows, of which {:.3g} percent are left (before: {:.3g} percent of the driving side)",
                                  100 * best.score.nrmse, 100 * nominal.score.nrmse));
    }
    if (verdict != Verdict::named && verdict != Verdict::ambiguous) return out;
    out.insert(out.end(), selection.as_well.begin(), selection.as_well.end());
    for (const Amendment& a : best.amendments) {
        for (const NewName& n : a.names) {
            const int p = best.model.parameter_index(n.name);
            if (p < 0) {
                out.push_back(fmt::format("{} = {:.6g} was scanned, not fitted: it is a constant of the amended model", n.name, n.value));
                continue;
            }
            const double value = best.fit.parameters[static_cast<std::size_t>(p)];
            const double sd = best.fit.sd[static_cast<std::size_t>(p)];
            if (!std::isfinite(sd)) out.push_back(fmt::format("the data do not see {}, whose value is where the fit stopped", n.name));
            else if (!(sd < 0.3 * std::abs(value))) out.push_back(fmt::format("{} = {:.3g} {} is known to {:.2g} {} only", n.name, value, n.unit, sd, n.unit));
        }
    }
    return out;
}

namespace {

/// One recording.
bool excited(const Workbench& bench, const Variant& nominal, std::size_t recording, Diagnostics& diagnostics) {
    const Bench& own = bench_of(nominal, recording);
    const std::string& file = bench.recording(recording).file;
    bool out = true;
    bool moves = false;
    const std::vector<double> noise = noise_by_signal(nominal.model, own);
    for (const int s : scored_outputs(nominal.model, own)) {
        const std::vector<double>& x = own.measured[static_cast<std::size_t>(s)];
        const model::Signal& signal = nominal.model.signals[static_cast<std::size_t>(s)];
        const auto [low, high] = std::minmax_element(x.begin(), x.end());
        if (*low == *high) {
            diagnostics.error(file, {}, "column '" + signal.column + "' is " + fmt::format("{:.6g}", *low) + " from end to end", "record the signal '" + signal.name + "', or give it scored = false");
            out = false;
        }
        double squares = 0;   // about zero: a machine that runs at one speed says little, but not nothing
        for (const double value : x) squares += value * value;
        moves = moves || std::sqrt(squares / static_cast<double>(x.size())) > 2 * noise[static_cast<std::size_t>(s)];
    }
    if (out && !moves) {
        diagnostics.error(file, {}, "no output rises above its noise: the machine was not excited", "record it while its inputs move");
        return false;
    }
    return out;
}

}  // namespace

bool excited(const Workbench& bench, const Variant& nominal, Diagnostics& diagnostics) {
    bool out = true;
    for (std::size_t r = 0; r < bench.recordings(); ++r) out = excited(bench, nominal, r, diagnostics) && out;
    return out;
}

}  // namespace algest::lab
