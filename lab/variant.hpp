// SPDX-License-Identifier: GPL-3.0-or-later
// A model text with what was added to it, run, fitted and scored on the parts of a recording.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "lab/amend.hpp"
#include "lab/fit.hpp"

namespace algest::lab {

/// Which rows of a recording serve what. The test rows are scored once, at the end.
struct Parts {
    Rows train;
    Rows test;
    Rows fitted;       ///< the first part of train
    Rows validation;   ///< the rest of train: decides what is added
};

/// The parts of a recording of `samples` rows; nullopt, and an error in `diagnostics`, where a stretch is too short.
/// train, test: in seconds, or the default of 70 and 30 percent.
std::optional<Parts> parts_of(const Recording& recording, const std::optional<std::pair<double, double>>& train, const std::optional<std::pair<double, double>>& test, Diagnostics& diagnostics);

/// What decides which of two variants is nearer to the recording.
enum class Yardstick {
    free_run,   ///< error of each scored output in one long run
    rows        ///< residual of each equation on windows that annihilate their initial conditions: where a long run drifts
};

/// How far a variant is from the validation rows.
struct Score {
    std::vector<double> error;                  ///< by output (free_run) or equation (rows): rms, in its unit
    std::vector<double> floor;                  ///< the part of it that the sensors' noise makes
    std::vector<std::vector<double>> blocks;    ///< mean square error of each of `score_blocks` blocks
    std::vector<double> independent;            ///< samples that count, autocorrelated ones as less than one
    double rows = 0;                            ///< samples of each output, or windows of each equation
    double nrmse = 0;                           ///< rms of error / size (free_run), of residual / driving side (rows)

    /// Error over floor, rms over outputs or equations; infinite where a floor is zero.
    double gap() const;
};

constexpr std::size_t score_blocks = 16;
constexpr double at_the_floor = 1.15;         ///< gap that counts as none
constexpr double far_from_the_floor = 1.3;    ///< gap from which on what is left must be noise that nothing foretells

struct Variant {
    std::string text;
    std::vector<Amendment> amendments;
    model::Model model;      ///< what is run: without idle kinematics
    model::Model whole;      ///< of the text
    Bench bench;
    Fit fit;
    Score score;
};

/// The workplace of a search: one nominal text, one recording, and what all its variants share.
class Workbench {
public:
    /// path: of the model, for messages.
    Workbench(std::string path, const Recording& recording, Parts parts) : path_(std::move(path)), recording_(recording), parts_(parts) {}
    Workbench(const Workbench&) = delete;   // every bench that it prepares points to its effort
    Workbench& operator=(const Workbench&) = delete;

    /// Reads the text and makes it ready to run. Errors of the nominal text (no amendments) go to `diagnostics`; nullopt after them.
    /// The first call, with the nominal text, decides which kinematic equations are idle.
    std::optional<Variant> prepare(const std::string& text, std::vector<Amendment> amendments, Diagnostics& diagnostics);

    /// Fits to the first training rows, from the better of `start` and what the weak form makes of it, and scores on the validation rows.
    void fit_and_score(Variant& v, const std::vector<double>& start, const std::vector<double>& initial) const;

    /// Fits once more, to all training rows and to the end: what is reported, once nothing is left to decide. The score stays.
    void refine(Variant& v);

    /// Runs and fits of a search share an effort, counted from here; once it is used up what stands is the answer.
    void begin_search();
    bool used_up() const { return effort_.used_up(); }

    /// Free run of a fitted variant over the whole recording; the rows before the training stretch are a run of their own.
    FreeRun run(const Variant& v, double tolerance) const;

    /// True when a disturbed start is still there a third of the training rows later: a long run adds up every small error.
    bool drifts(const Variant& fitted) const;

    Yardstick yardstick() const { return yardstick_; }
    void measure_by(Yardstick yardstick) { yardstick_ = yardstick; }

    const Parts& parts() const { return parts_; }
    const Recording& recording() const { return recording_; }
    const std::string& path() const { return path_; }

    /// A text as it is run: without idle kinematics.
    std::optional<model::Model> runnable(const std::string& text) const;

private:
    void find_idle_kinematics(const model::Model& model);
    void drop_idle_kinematics(model::Model& model) const;
    Score free_run_score(const Variant& v) const;
    Score rows_score(const Variant& v) const;

    std::string path_;
    const Recording& recording_;
    Parts parts_;
    std::set<std::string> idle_;
    Yardstick yardstick_ = Yardstick::free_run;
    Effort effort_;
};

/// Initial values of v's states as another variant's fit has them; its own for those that the other lacks.
std::vector<double> carried_initial(const Variant& v, const Variant& from);

/// Twice the gain in log-likelihood of a over b, rows counted as they are independent (positive: a is nearer to the measurement):
/// the sum over outputs of rows times log(b^2/a^2).
double log_gain(const Score& a, const Score& b);

/// How sure it is that a is nearer than b: mean over its standard error, block by block, of the logarithm of the ratio of their squared
/// errors (logarithms, so that one stretch with a large error does not speak for all).
double significance(const Score& a, const Score& b);

}  // namespace algest::lab
