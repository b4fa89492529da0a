// SPDX-License-Identifier: GPL-3.0-or-later
// The model left to itself: integrated over the recorded inputs, from given parameters and initial values.
#pragma once
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "lab/ode_system.hpp"

namespace algest::lab {

/// What drives a run: samples at a uniform period.
struct Drive {
    double period;                                ///< s
    std::size_t samples;                          ///< the run ends there
    std::vector<std::vector<double>> values;      ///< by the model's signals; empty for those that are not driven
    std::vector<bool> held;                       ///< by signal: constant between samples, else linear
    bool from_rest = false;                       ///< nothing drove before the first sample: a delayed input was 0 there, else what it is first
};

/// Every moving, every fed-back and every output signal at every kept sample from the first on, by the model's signals; empty for the others.
struct FreeRun {
    std::vector<std::vector<double>> signals;
    std::size_t samples;                          ///< computed, one at least; fewer than asked for where the run diverged, or a sensor showed no number
};

/// Work of all runs that share it, in operations of the equations' tapes that they evaluate, those that stand still in a run counted too: counted, not
/// timed, so that the same search ends at the same place on every machine. About 1e9 take 1.5 s of a 3 GHz core.
struct Effort {
    double spent = 0;
    double limit = std::numeric_limits<double>::infinity();
    bool used_up() const { return spent >= limit; }
};

/// Half the width over which a sgn() of several signals rises, in typical sizes of its argument: what the ripple of a phase current blurs,
/// and what an ideal switch comes near to, at three times the cost each.
constexpr double blurred_layer = 2e-2;
constexpr double thin_layers[] = {5e-3, 1e-3};

struct RunOptions {
    double tolerance = 1e-8;                      ///< local, relative to the scale of each state
    std::vector<double> scale;                    ///< by state entry: typical size
    std::vector<double> farthest;                 ///< by state entry: a run beyond it has diverged
    std::size_t first = 0;                        ///< sample at which the run starts
    std::size_t end = 0;                          ///< sample before which it ends; 0: where the drive does
    std::size_t stride = 1;                       ///< every how many samples the run is kept; above 1 for systems that nothing drives
    double layer_width = blurred_layer;
    Effort* effort = nullptr;                     ///< that every run adds its own to
};

/// Integrates from `initial` (one value per state entry) with a Dormand-Prince step of controlled size inside each period, inputs as
/// they are held. A sgn() is a relay: a step never straddles its switch, and where the motion holds its argument at zero
/// (sticking friction) the relay takes the value that keeps it there, so no width of smoothing enters. No step straddles a sample of a
/// delayed input either; before its first sample such a signal has its first value, or 0 (Drive::from_rest).
/// Cost: samples times at least six evaluations of the residual's tape per highest derivative and one; one or two where it is linear (linear_motion.hpp).
FreeRun free_run(const OdeSystem& system, const std::vector<double>& parameters, const std::vector<double>& initial, const Drive& drive,
                 const RunOptions& options, const std::function<void(double)>& progress = {});

}  // namespace algest::lab
