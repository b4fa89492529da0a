// SPDX-License-Identifier: GPL-3.0-or-later
// Which effects the data speak for before any of them is fitted: by the weak form of the equations, and by the slope of the free run.
#pragma once
#include <vector>

#include "lab/effects.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

constexpr double price_of_a_scan = 1.5;   ///< that the F statistic of the best of many scanned values is divided by: a scan finds something in any noise

/// An effect in a place, with the value of its scan that fits best.
struct Candidate {
    Binding binding;
    double scan;
    double strength;              ///< F statistic of the reduction of the weak residual, over the price of a scan; 0 where the weak form cannot see it
    double share;                 ///< of the free run's squared error on the fitted rows that it would take, to first order
    std::vector<double> scans;    ///< values that only a free run can weigh; empty: none
    std::vector<double> start;    ///< parameters of the amended model, by whichever of the two speaks louder
    double sureness = 0;          ///< square of the share's t over stretches of the run; 0: not weighed, or more than one parameter
};

/// The most likely candidates beside what `base` already holds: at most `by_rows` by the weak form, best first, at most two of one effect,
/// then at most `by_run` more by the free run's slope, which sees what adds up over a run and what equations share.
/// Cost: one weak form a candidate, window length and scanned value; one run a parameter of a candidate.
std::vector<Candidate> screen(Workbench& bench, const Variant& base, const std::vector<Effect>& effects, std::size_t by_rows, std::size_t by_run);

/// Every candidate, one of each law and place, weighed by the free run's slope where that is the yardstick, those first that the rows see best.
std::vector<Candidate> weighed_by_run(Workbench& bench, const Variant& base, const std::vector<Effect>& effects);

}  // namespace algest::lab
