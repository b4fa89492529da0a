// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/recording_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/fit.hpp"
#include "lab/noise.hpp"

namespace algest::lab {

namespace {

constexpr double clipped_share = 0.005;       ///< of the samples at one extreme value, in runs
constexpr std::size_t clipped_run = 5;        ///< samples in a row at an extreme that no noise would make alike
constexpr double abrupt = 2.5;                ///< smallest steps of the signal: what settles on a step of its sensor, or turns round there, comes and goes by one
constexpr double overstated = 3;              ///< declared noise over roughness: white noise is as rough as it is large, coloured noise less
constexpr double still_share = 0.5;           ///< of an input's steps that are zero: it is held
constexpr std::size_t least_jumps = 3;

double smallest_step(const std::vector<double>& x) {
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < x.size(); ++k) if (x[k] != x[k - 1]) out = std::min(out, std::abs(x[k] - x[k - 1]));
    return out;
}

/// Share of samples that stand in runs at the largest or smallest value, into which or out of which the signal jumps.
double clipped(const std::vector<double>& x) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    const double jump = abrupt * smallest_step(x);
    std::size_t count = 0;
    for (const double extreme : {*low, *high}) {
        std::size_t run = 0;
        for (std::size_t k = 0; k <= x.size(); ++k) {
            if (k < x.size() && x[k] == extreme) {
                ++run;
                continue;
            }
            const auto into = [&] { return run < k && std::abs(extreme - x[k - run - 1]) > jump; };
            const auto out_of = [&] { return k < x.size() && std::abs(x[k] - extreme) > jump; };
            if (run >= clipped_run && (into() || out_of())) count += run;
            run = 0;
        }
    }
    return static_cast<double>(count) / static_cast<double>(x.size());
}

/// True for a staircase: it stands still, and jumps.
bool is_held(const std::vector<double>& x) {
    std::size_t still = 0;
    std::size_t jumps = 0;
    for (std::size_t k = 1; k < x.size(); ++k) ++(x[k] == x[k - 1] ? still : jumps);
    return jumps >= least_jumps && static_cast<double>(still) > still_share * static_cast<double>(x.size());
}

std::size_t beyond_limits(const model::Signal& signal, const std::vector<double>& x) {
    const auto bound = [](const auto& value) { return exact::nearest(*value, plan::Scalar::float64); };
    return static_cast<std::size_t>(std::count_if(x.begin(), x.end(), [&](double v) { return (signal.min && v < bound(signal.min)) || (signal.max && v > bound(signal.max)); }));
}

}  // namespace

std::vector<std::string> recording_doubts(const model::Model& model, const Bench& bench) {
    std::vector<std::string> out;
    const auto outputs = scored_outputs(model, bench);
    for (std::size_t s = 0; s < bench.measured.size(); ++s) {
        const std::vector<double>& x = bench.measured[s];
        if (x.empty()) continue;
        const model::Signal& signal = model.signals[s];
        if (const std::size_t count = beyond_limits(signal, x); count > 0) {
            out.push_back(fmt::format("'{}' is beyond its declared limits in {} of {} samples: a controller would reject them, a fit follows them", signal.name, count, x.size()));
        }
        if (std::find(outputs.begin(), outputs.end(), static_cast<int>(s)) != outputs.end()) {
            const double share = clipped(x);
            const double declared = signal.noise ? exact::nearest(*signal.noise, plan::Scalar::float64) : 0.0;
            const double rough = roughness(x);
            if (rough > 0 && declared > overstated * rough) {
                out.push_back(fmt::format("'{}' is {:.2g} times smoother than the noise that it declares, {:.3g} {}: an effect that hides below that is not looked for", signal.name, declared / rough, declared, signal.unit));
            }
            if (share > clipped_share) out.push_back(fmt::format("'{}' stands at its largest or smallest value for {:.1f} percent of the recording: its sensor may be clipped", signal.name, 100 * share));
        }
        if (bench.drive.values[s].empty()) continue;
        const auto [low, high] = std::minmax_element(x.begin(), x.end());
        if (*low == *high) out.push_back(fmt::format("'{}' is {:.6g} {} from end to end: what takes a changing input to show stays hidden", signal.name, *low, signal.unit));
        else if (!bench.drive.held[s] && is_held(x)) out.push_back(fmt::format("'{}' stands still between jumps, as a command does that is held, but is declared linear: does it miss hold = \"zoh\"?", signal.name));
    }
    return out;
}

}  // namespace algest::lab
