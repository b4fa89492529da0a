// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a discovery's report, as data: what is drawn against what, over which stretch.
#pragma once
#include <optional>
#include <vector>

#include "generator/model.hpp"
#include "lab/discovery.hpp"
#include "lab/figure.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// Colours that stay apart for the colour-blind and in print (Okabe and Ito).
namespace colour {
constexpr char measured[] = "#9a9a9a";
constexpr char before[] = "#d55e00";
constexpr char after[] = "#0072b2";
constexpr char without[] = "#cc79a7";    ///< the amended model with the added terms left out
constexpr char law[] = "#111111";
}  // namespace colour

/// Measured, before and after over the test stretch, and the errors below with the noise band; `noise` in the signal's unit, 0: not
/// declared. Where the stretch is too dense to be read, a detail stands beside it, where the model as it was is off most.
struct TestFigure {
    Figure figure;
    double noise;            ///< standard deviation, in the signal's unit
    bool detail;
    bool before_diverges;    ///< its free run ends or leaves the picture inside the test stretch
    bool after_diverges;
};
/// Nullopt where the signal is not measured or not simulated, or the test stretch has no sample.
std::optional<TestFigure> test_figure(const Discovery& discovery, const model::Model& model, const Recording& recording, const OutputGap& output);

/// The residual of an equation over time, with the noise band and the stretches. Nullopt without windows.
std::optional<Figure> time_figure(const Discovery& discovery, const EquationResidual& residual);

/// Against the signal that explains it: what the equation of the amended model leaves without the added terms, with what these say, and
/// beside it what is left with them; the residual before, where no term was added to this equation. Nullopt where no signal explains it.
std::optional<Figure> law_figure(const EquationResidual& residual);

}  // namespace algest::lab
