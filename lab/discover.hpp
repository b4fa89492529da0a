// SPDX-License-Identifier: GPL-3.0-or-later
// The gap workflow: simulate, fit, locate, name, amend, confirm (design.md, section 6).
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/amend.hpp"
#include "lab/fit.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

enum class Verdict { named, ambiguous, none, unknown };
const char* name(Verdict verdict);

/// A parameter of a named effect.
struct NamedParameter {
    std::string name;
    std::string unit;
    double value;
    double sd;
};

/// An effect in the place where it enters.
struct NamedEffect {
    std::string name;
    std::string equation;
    std::string term;
    std::vector<NamedParameter> parameters;
};

/// Share of the gap.
struct Where {
    std::string equation;
    double share;         ///< of the sum over equations of residual power above the noise
    double from_s;        ///< the stretch that holds most of it
    double to_s;
    std::string region;   ///< what explains the residual best, in words
};

struct OutputGap {
    std::string signal;
    double before;        ///< nrmse of the refitted nominal model on the test stretch
    double after;         ///< of the amended model; equal to before where nothing is named
    double floor;         ///< nrmse that the declared sensor noise alone makes
};

struct Discovery {
    Verdict verdict;
    std::vector<NamedEffect> effects;
    std::vector<std::vector<std::string>> alternatives;   ///< other sets of effects that the data allow
    std::vector<std::string> experiments;                 ///< that would tell them apart
    std::vector<Where> where;
    std::vector<OutputGap> outputs;
    std::string model_text;                               ///< amended, with the fitted values as initial ones
    FreeRun before;                                       ///< over the whole recording
    FreeRun after;
};

struct DiscoverOptions {
    std::optional<std::pair<double, double>> train_s;     ///< default: the first 70 percent
    std::optional<std::pair<double, double>> test_s;      ///< default: the rest
};

/// What is going on, in words, with a share of the work done.
using StepReport = std::function<void(const std::string&, double)>;

/// The whole workflow on one recording. Nullopt, and errors in `diagnostics`, where model and recording do not go together.
std::optional<Discovery> discover(const std::string& model_text, const std::string& model_path, const Recording& recording,
                                  const std::vector<Effect>& effects, const DiscoverOptions& options, Diagnostics& diagnostics, const StepReport& progress = {});

}  // namespace algest::lab
