// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a replay's report, as data: estimates with their intervals, the condition, and what the status was.
#pragma once
#include <optional>

#include "generator/plan.hpp"
#include "lab/figure.hpp"
#include "lab/replay.hpp"

namespace algest::lab {

/// Tints of the statuses but ok.
namespace colour {
constexpr char filling[] = "#999999";
constexpr char singular[] = "#e69f00";
constexpr char rejected[] = "#cc0000";
constexpr char interval[] = "#b5d4ea";   ///< of the estimate, +-2 standard deviations
constexpr char held[] = "#8a8a8a";       ///< an estimate that is held
}  // namespace colour

/// A parameter over time: estimates while the status is ok, the held one elsewhere, the interval where standard deviations were computed, the
/// statuses tinted. The axis is that of most estimates: outliers leave it. Nullopt where nothing was ever estimated.
std::optional<Figure> estimate_figure(const plan::Plan& plan, const Replay& replay, std::size_t parameter);

/// The logarithm of the condition over time. Nullopt where there never was one.
std::optional<Figure> condition_figure(const Replay& replay);

}  // namespace algest::lab
