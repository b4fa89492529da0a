// SPDX-License-Identifier: GPL-3.0-or-later
// A model text with what was added to it, run, fitted and scored on the parts of a recording.
#pragma once
#include <optional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "lab/amend.hpp"
#include "lab/fit.hpp"
#include "lab/weak_form.hpp"

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
    std::vector<double> error;                  ///< by recording, and in it by output (free_run) or equation (rows): rms, in its unit
    std::vector<std::size_t> recording;         ///< of each error
    std::vector<double> floor;                  ///< the part of it that the sensors' noise makes
    std::vector<std::vector<double>> blocks;    ///< mean square error of each of `score_blocks` blocks
    std::vector<double> independent;            ///< samples that count, autocorrelated ones as less than one
    std::vector<double> rows;                   ///< samples of each output, or windows of each equation
    double nrmse = 0;                           ///< rms of error / size (free_run), of residual / driving side (rows)

    /// Error over floor, rms over outputs or equations; infinite where a floor is zero.
    double gap() const;
    /// True when every error is as rough as a sensor's noise: then it is noise, however little was declared.
    bool white() const;
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
    std::vector<Bench> further = {};   ///< of the further recordings
};

/// By recording, the first one first.
const Bench& bench_of(const Variant& v, std::size_t recording);
const std::vector<double>& initial_of(const Variant& v, std::size_t recording);

/// The workplace of a search: one nominal text, one recording or several of one machine, and what all its variants share.
class Workbench {
public:
    /// path: of the model, for messages.
    Workbench(std::string path, const Recording& recording, Parts parts) : path_(std::move(path)), trials_{{&recording, parts}} {}
    Workbench(const Workbench&) = delete;   // every bench that it prepares points to its effort
    Workbench& operator=(const Workbench&) = delete;

    /// One more recording of the machine, before anything is prepared. Each is run at its own period then.
    void add_recording(const Recording& recording, Parts parts) { trials_.push_back({&recording, parts}); }

    /// Reads the text and makes it ready to run. Errors of the nominal text (no amendments) go to `diagnostics`; nullopt after them.
    /// The first call, with the nominal text, decides which kinematic equations are idle.
    std::optional<Variant> prepare(const std::string& text, std::vector<Amendment> amendments, Diagnostics& diagnostics);

    /// Fits to the first training rows, from the better of `start` and what the weak form makes of it, and scores on the validation rows.
    void fit_and_score(Variant& v, const std::vector<double>& start, const std::vector<double>& initial) const;

    /// Again, from what the rows say, over an eighth of the fitted rows at first, then over more: for what has a false minimum on every long run, as wells
    /// of an angle do. The fit that was there stays where it is nearer. Free run only. Cost: about two fits.
    void fit_growing(Variant& v) const;

    /// Fits once more, to all training rows and to the end: what is reported, once nothing is left to decide. The score stays.
    void refine(Variant& v);

    /// Runs and fits of a search share an effort, counted from here; once it is used up what stands is the answer.
    void begin_search();
    /// A look at what was found costs no more than its last fit.
    void begin_check();

    /// `const OneOfMany share(bench);` while it lives no more than a share of the search's effort is spent: one candidate that is stiff must
    /// not cost the others their turn. The bench remembers a candidate that came to the end of its share: what it scored says little.
    class OneOfMany {
    public:
        explicit OneOfMany(Workbench& bench);
        ~OneOfMany();
        OneOfMany(const OneOfMany&) = delete;
        OneOfMany& operator=(const OneOfMany&) = delete;

    private:
        Workbench& bench_;
        double limit_;
    };
    bool used_up() const { return effort_.used_up(); }
    /// The search, or a candidate of it, came to the end of its effort.
    bool cut_short() const { return cut_ || used_up(); }

    /// Free run of a fitted variant over a whole recording; the rows before the training stretch are a run of their own.
    FreeRun run(const Variant& v, double tolerance, std::size_t recording = 0) const;

    /// A variant on a part of each recording, its states starting where another one's fit has them (carried_initial); parameters as there.
    FitStart start_of(const Variant& v, const Variant& from, Rows Parts::*part) const;
    /// A part of each recording, for the rows of a variant's equations.
    std::vector<BenchRows> stretches(const Variant& v, Rows Parts::*part) const;

    /// Errors of the free run over a part of each recording that is not before the training stretch, which the run starts with.
    Score free_run_score(const Variant& v, Rows Parts::*part) const;

    /// Residuals of the equations over short windows of a part of each recording, as shares of their driving sides; no entries where the part
    /// is shorter than a window.
    Score rows_score(const Variant& v, Rows Parts::*part) const;

    /// True when a disturbed start is still there a third of the training rows later: a long run adds up every small error.
    bool drifts(const Variant& fitted) const;

    Yardstick yardstick() const { return yardstick_; }
    void measure_by(Yardstick yardstick) { yardstick_ = yardstick; }

    /// Effects whose amended text was no model, and why: nothing is known of them.
    const std::map<std::string, std::string>& unwritten() const { return unwritten_; }

    /// An effect that is no finite number everywhere in the recording, and the equation it would have entered.
    void refuse(const std::string& effect, const std::string& equation) { refused_.emplace(effect, equation); }
    const std::map<std::string, std::string>& refused() const { return refused_; }

    std::size_t recordings() const { return trials_.size(); }
    const Parts& parts(std::size_t recording = 0) const { return trials_[recording].parts; }
    const Recording& recording(std::size_t k = 0) const { return *trials_[k].recording; }
    const std::string& path() const { return path_; }

    /// A text as it is run: without idle kinematics.
    std::optional<model::Model> runnable(const std::string& text) const;

private:
    void find_idle_kinematics(const model::Model& model);
    void drop_idle_kinematics(model::Model& model) const;
    void fit_from_elsewhere(Variant& v, const FitStart& from) const;
    std::vector<std::vector<double>> weak_parameters(const Variant& v, const std::vector<double>& start) const;
    void fit_either_past(Variant& v, const FitStart& from) const;

    struct Trial {
        const Recording* recording;
        Parts parts;
    };

    std::optional<Bench> ready(const model::Model& model, const Trial& trial, Diagnostics& diagnostics);
    bool drifts(const Variant& fitted, std::size_t recording) const;

    std::string path_;
    std::vector<Trial> trials_;
    std::set<std::string> idle_;
    std::map<std::string, std::string> unwritten_;
    std::map<std::string, std::string> refused_;
    Yardstick yardstick_ = Yardstick::free_run;
    Effort effort_;
    bool cut_ = false;   ///< some candidate came to the end of its share
};

/// der(x) = v: a definition, in which no law can be missing.
bool is_kinematic(const model::Model& model, const model::Equation& equation);

/// Intervals of the windows that score equations, shorter where the rows would give too few.
int row_intervals(const Rows& rows);

/// Equations are found again by name: amendments leave their order alone, dropped kinematics do not. The first where there is none.
std::size_t equation_index(const model::Model& model, const std::string& name);

/// Initial values of v's states in a recording as another variant's fit has them; its own for those that the other lacks.
std::vector<double> carried_initial(const Variant& v, const Variant& from, std::size_t recording = 0);

/// What delayed inputs were before the first sample, as another variant's fit has it.
void carry_past(Variant& v, const Variant& from);

/// Twice the gain in log-likelihood of a over b, rows counted as they are independent (positive: a is nearer to the measurement):
/// the sum over outputs of rows times log(b^2/a^2).
double log_gain(const Score& a, const Score& b);
/// The part of it that one recording makes.
double log_gain(const Score& a, const Score& b, std::size_t recording);

/// How sure it is that a is nearer than b: mean over its standard error, block by block, of the logarithm of the ratio of their squared
/// errors (logarithms, so that one stretch with a large error does not speak for all).
double significance(const Score& a, const Score& b);

}  // namespace algest::lab
