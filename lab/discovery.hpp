// SPDX-License-Identifier: GPL-3.0-or-later
// What a discovery found, as data: the verdict, the evidence for it, and the series that a report draws.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "lab/free_run.hpp"

namespace algest::lab {

enum class Verdict { named, ambiguous, none, unknown };
const char* name(Verdict verdict);

/// A parameter of a model or of an effect.
struct NamedParameter {
    std::string name;
    std::string unit;
    double value;
    double sd;            ///< infinite where the data do not see it, 0 for a constant that was scanned
};

/// An effect in the place where it enters.
struct NamedEffect {
    std::string name;
    std::string equation;                     ///< its name in the model file; several are joined by ", "
    std::string term;
    std::string summary;                      ///< what it is, from the library
    std::string shows;                        ///< how it shows, from the library
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

/// One candidate of the search, best first.
struct Evidence {
    std::string effect;
    std::string equation;
    std::string term;
    double strength;      ///< F statistic of the weak residual's reduction
    double validation;    ///< nrmse on the validation rows once fitted in free run
    double improvement;   ///< of the information criterion over the model without it, deflated for autocorrelation
    bool chosen;
    bool rival;           ///< the data do not tell it from what was chosen
    int step;             ///< 1: beside the nominal model; 2: beside the first effect; ...
};

/// The residual of one equation, window by window.
struct EquationResidual {
    std::string equation;
    std::string unit;                 ///< empty: unknown
    std::vector<double> t;            ///< s, the middle of each window
    std::vector<double> before;       ///< refitted nominal model
    std::vector<double> after;        ///< amended model; empty where nothing was added to any equation
    double noise;                     ///< standard deviation that the declared sensor noise makes of it
    // Against the signal that explains it best; all empty where none does.
    std::string signal;
    std::string signal_unit;
    std::vector<double> x;            ///< of the signal, by window
    std::vector<double> law;          ///< by window: what the added terms say; empty where none enters this equation
};

/// What one recording says of it.
struct RecordingEvidence {
    std::string file;
    std::vector<OutputGap> outputs;
    double gain;                                          ///< of the amended model over the nominal one on its validation rows, as Evidence's improvement; 0: nothing named
    FreeRun before;                                       ///< over the whole recording, by the model's signals
    FreeRun after;
    double train_from_s, train_to_s, test_from_s, test_to_s;
};

/// What was found, and what a reader needs to believe or doubt it. One fit and one verdict over all recordings; where, residuals and the
/// report's figures are those of the first one.
struct Discovery {
    Verdict verdict;
    std::vector<NamedEffect> effects;
    std::vector<std::vector<std::string>> alternatives;   ///< other sets of effects that the data allow
    std::vector<std::string> experiments;                 ///< that would tell them apart
    std::vector<std::string> doubts;                      ///< a sentence each: what a reader should not take for granted
    std::vector<Where> where;
    std::vector<Evidence> evidence;
    std::vector<EquationResidual> residuals;
    std::vector<NamedParameter> parameters_before;        ///< of the refitted nominal model
    std::vector<NamedParameter> parameters_after;         ///< of the amended one, what the effects bring included
    std::string model_text;                               ///< amended, with the fitted values as initial ones
    std::vector<RecordingEvidence> recordings;            ///< in the order given, one at least

    const RecordingEvidence& first() const { return recordings.front(); }
};

}  // namespace algest::lab
