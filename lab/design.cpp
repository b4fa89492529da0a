// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "generator/planner.hpp"
#include "lab/excitation.hpp"
#include "lab/free_run_reference.hpp"
#include "lab/median.hpp"
#include "lab/replay.hpp"

namespace algest::lab {

namespace {

constexpr double step = 1.5;             ///< from one window to the next: the error has a flat minimum, and ten windows cover a factor of forty
constexpr int shortest = 6;              ///< intervals of the first window: seven samples, one more than the unknowns of the largest models; shorter ones are noise alone
constexpr int ordinary = 16;             ///< intervals of a window that only shows what is wrong with a model, whatever its window
constexpr double most_work = 4e9;        ///< multiply-adds of one replay: some seconds
constexpr double as_good = 1.1;          ///< errors within this factor of the least count as the same: between two windows of a flat minimum
constexpr double worth_a_change = 0.8;   ///< of the error, what another kappa or more rows must reach: less is the scatter from one recording to the next
constexpr double enough_ok = 0.5;        ///< of the best trial's share of ok samples: a window that is silent half of the time is compared on other data
constexpr double of_trials = 0.9;        ///< of the progress: the fit of the free run takes about as long as a tenth of the replays

double rms(const std::vector<double>& of) {
    if (of.empty()) return 0;
    return std::sqrt(std::inner_product(of.begin(), of.end(), of.begin(), 0.0) / static_cast<double>(of.size()));
}

class Designer {
public:
    Designer(const model::Model& model, const Recording& recording, const DesignOptions& options, Diagnostics& diagnostics, const std::function<void(double)>& progress)
        : model_(model), recording_(recording), options_(options), diagnostics_(diagnostics), progress_(progress) {}

    std::optional<Design> run() {
        if (!windows_fit()) return std::nullopt;
        const std::vector<int> lengths = intervals();
        if (lengths.size() < 2) {
            diagnostics_.error(recording_.file, {static_cast<int>(recording_.samples()) + 1, 1}, fmt::format("{} samples are too few to try windows on", recording_.samples()), "a longer recording");
            return std::nullopt;
        }
        const std::vector<model::Model> all = variants();
        std::vector<std::vector<Trial>> families;
        for (std::size_t v = 0; v < all.size(); ++v) families.push_back(family(all[v], lengths, of_trials * static_cast<double>(v) / static_cast<double>(all.size()), of_trials / static_cast<double>(all.size())));
        tell(of_trials);
        find_reference(families);
        for (std::size_t v = 0; v < families.size(); ++v) {
            for (Trial& t : families[v]) {
                judge(t);
                (v == 0 ? out_.curve : out_.others).push_back(t);
            }
        }
        out_.recommended = best();
        out_.reached = out_.recommended && out_.recommended->error <= options_.accuracy.value_or(1.0);   // beyond 1 an estimate is as wide as it is large
        out_.missing = lacking(out_.recommended ? as_tried(*out_.recommended) : with_window(lengths[lengths.size() / 2]));
        return out_;
    }

private:
    void tell(double share) const { if (progress_) progress_(share); }

    bool windows_fit() {
        if (!model_.period || model_.discrete || model_.filter || model_.estimator.functional != model::Functional::annihilator || model_.parameters.empty()) {
            diagnostics_.error(model_.path, model_.sampling_at, "the model has no windows to design", "parameters, [sampling] period and functional = \"annihilator\"");
            return false;
        }
        model::Model as_it_is = with_window(ordinary);
        if (model_.window) as_it_is = model_;
        const auto plan = plan_of(as_it_is, false, diagnostics_);   // says what is wrong with it, whatever the window
        if (!plan) return false;
        std::vector<std::vector<double>> inputs;
        const bool signals = read_inputs(*plan, recording_, inputs, diagnostics_);
        return check_period(recording_, model_.name, plan->period, diagnostics_) && signals;
    }

    static std::optional<plan::Plan> plan_of(const model::Model& model, bool weights, Diagnostics& diagnostics) {
        generator::PlanOptions options;
        options.weights = weights;
        return generator::plan_of(model, options, diagnostics);
    }

    /// In powers of `step`, as long as the first estimate comes in the first half of the recording; even ones, which every quadrature allows.
    std::vector<int> intervals() const {
        const double periods = static_cast<double>(recording_.samples()) / model_.decimate;
        const double pooled = model_.estimator.solve_window ? exact::nearest(*model_.estimator.solve_window / model_.window_period(), plan::Scalar::float64) : 0;
        std::vector<int> out;
        for (double m = shortest; m + pooled <= periods / 2 && m <= model::most_intervals && m * static_cast<double>(recording_.samples()) <= most_work; m *= step) {
            out.push_back(2 * static_cast<int>(m / 2));
        }
        return out;
    }

    int intervals_of(const Trial& t) const { return static_cast<int>(std::lround(t.window_s / exact::nearest(model_.window_period(), plan::Scalar::float64))); }

    model::Model with_window(int intervals) const {
        model::Model out = model_;
        out.window = model_.window_period() * intervals;
        return out;
    }

    model::Model as_tried(const Trial& trial) const {
        model::Model out = with_window(intervals_of(trial));
        for (std::size_t e = 0; e < out.equations.size(); ++e) {
            out.equations[e].kappa = trial.kappa[e];
            out.equations[e].rows.count.reset();
            out.equations[e].rows.list = trial.rows[e];
        }
        return out;
    }

    /// The model as it is, then with one less and one more kappa, then with one more row.
    std::vector<model::Model> variants() const {
        std::vector<model::Model> out = {model_};
        for (const int change : {-1, 1}) {
            model::Model other = model_;
            bool possible = true;
            for (model::Equation& e : other.equations) {
                e.kappa += change;
                possible = possible && e.kappa >= 0 && e.kappa <= model::largest_kappa && (e.kappa > 0 || e.perturbation.empty());
            }
            if (possible) out.push_back(other);
        }
        Diagnostics said_before;
        const auto plan = plan_of(with_window(ordinary), false, said_before);
        if (!plan) return out;
        const auto rows = rows_of(*plan);
        model::Model more = model_;
        for (std::size_t e = 0; e < rows.size(); ++e) {
            more.equations[e].rows.count.reset();
            more.equations[e].rows.list = rows[e];
            if (!rows[e].empty()) more.equations[e].rows.list.push_back(*std::max_element(rows[e].begin(), rows[e].end()) + 1);
        }
        out.push_back(more);
        return out;
    }

    /// One model over all windows.
    std::vector<Trial> family(model::Model model, const std::vector<int>& lengths, double done, double share) const {
        std::vector<Trial> out;
        for (std::size_t k = 0; k < lengths.size(); ++k) {
            tell(done + share * static_cast<double>(k) / static_cast<double>(lengths.size()));
            model.window = model_.window_period() * lengths[k];
            if (const auto trial = tried(model)) out.push_back(*trial);
        }
        return out;
    }

    std::optional<Trial> tried(const model::Model& model) const {
        Diagnostics unsaid;   // another kappa may erase what is to be estimated: then it is no choice
        const auto plan = plan_of(model, true, unsaid);
        const auto replayed = plan ? replay(*plan, recording_, {}, unsaid) : std::nullopt;
        if (!replayed) return std::nullopt;
        Trial out{exact::nearest(*model.window, plan::Scalar::float64), {}, {}, cheaper_engine(model), 0, {}, {}};
        for (const model::Equation& e : model.equations) out.kappa.push_back(e.kappa);
        out.rows = rows_of(*plan);
        const std::size_t from = replayed->samples() / 2;
        std::vector<std::vector<double>> values(model_.parameters.size());
        for (std::size_t k = from; k < replayed->samples(); ++k) {
            if (replayed->status[k] != Status::ok) continue;
            for (std::size_t p = 0; p < values.size(); ++p) values[p].push_back(replayed->parameter(k, p));
        }
        out.ok = static_cast<double>(values[0].size()) / static_cast<double>(replayed->samples() - from);
        if (values[0].empty()) return std::nullopt;
        for (std::vector<double>& v : values) {
            out.mean.push_back(std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size()));
            for (double& x : v) x -= out.mean.back();
            out.scatter.push_back(rms(v));
        }
        return out;
    }

    /// By equation of the model: a plan lists those alone that have rows.
    std::vector<std::vector<int>> rows_of(const plan::Plan& plan) const {
        std::vector<std::vector<int>> out(model_.equations.size());
        for (const plan::Row& row : plan.rows) {
            const std::string& name = plan.equations[static_cast<std::size_t>(row.equation)].name;
            const auto at = std::find_if(model_.equations.begin(), model_.equations.end(), [&](const model::Equation& e) { return e.name == name; });
            out[static_cast<std::size_t>(at - model_.equations.begin())].push_back(row.p);
        }
        return out;
    }

    /// Median over a family, by parameter.
    static std::vector<double> consensus(const std::vector<Trial>& family) {
        std::vector<double> out;
        for (std::size_t p = 0; p < family.front().mean.size(); ++p) {
            std::vector<double> means;
            for (const Trial& t : family) means.push_back(t.mean[p]);
            out.push_back(*median(means));
        }
        return out;
    }

    /// By parameter: it differs from zero by more than the steadiest trial scatters.
    static std::vector<bool> not_zero(const std::vector<double>& values, const std::vector<Trial>& family) {
        std::vector<bool> out;
        for (std::size_t p = 0; p < values.size(); ++p) {
            const auto steadier = [p](const Trial& a, const Trial& b) { return a.scatter[p] < b.scatter[p]; };
            out.push_back(std::abs(values[p]) > std::min_element(family.begin(), family.end(), steadier)->scatter[p]);
        }
        return out;
    }

    /// How far its members typically are from their own consensus, scatter included. A parameter that one family takes for zero counts for
    /// none: there is nothing to divide by, and where it stands in for a perturbation it is steady and wrong.
    static double disagreement(const std::vector<Trial>& family, const std::vector<bool>& counts) {
        const std::vector<double> middle = consensus(family);
        std::vector<double> out;
        for (const Trial& t : family) {
            std::vector<double> off;
            for (std::size_t p = 0; p < middle.size(); ++p) {
                if (counts[p]) off.push_back(std::hypot(t.scatter[p], t.mean[p] - middle[p]) / std::abs(middle[p]));
            }
            out.push_back(rms(off));
        }
        return *median(out);
    }

    /// The free run's parameters where there are any, else the consensus of the family that agrees best: a perturbation that one kappa does
    /// not annihilate moves its windows apart.
    void find_reference(const std::vector<std::vector<Trial>>& families) {
        const auto fitted = free_run_reference(model_, recording_);
        out_.reference = {fitted.has_value(), fitted.value_or(std::vector<double>(model_.parameters.size())), std::vector<bool>(model_.parameters.size(), false)};
        std::vector<bool> nowhere_zero(model_.parameters.size(), true);
        for (const auto& family : families) {
            const std::vector<bool> here = family.empty() ? nowhere_zero : not_zero(consensus(family), family);
            for (std::size_t p = 0; p < here.size(); ++p) nowhere_zero[p] = nowhere_zero[p] && here[p];
        }
        const std::vector<Trial>* united = nullptr;
        for (const auto& family : families) {
            if (!family.empty() && (united == nullptr || disagreement(family, nowhere_zero) < disagreement(*united, nowhere_zero))) united = &family;
        }
        if (united == nullptr) return;
        if (!fitted) out_.reference.values = consensus(*united);
        out_.reference.counts = not_zero(out_.reference.values, *united);
    }

    void judge(Trial& t) const {
        std::vector<double> noise;
        std::vector<double> perturbation;
        for (std::size_t p = 0; p < t.mean.size(); ++p) {
            if (!out_.reference.counts[p]) continue;
            noise.push_back(t.scatter[p] / std::abs(out_.reference.values[p]));
            perturbation.push_back((t.mean[p] - out_.reference.values[p]) / std::abs(out_.reference.values[p]));
        }
        t.noise = rms(noise);
        t.perturbation = rms(perturbation);
        t.error = std::hypot(t.noise, t.perturbation);
    }

    /// Those that answer often enough to be compared.
    std::vector<const Trial*> candidates(const std::vector<Trial>& of) const {
        double most = 0;
        for (const Trial& t : out_.curve) most = std::max(most, t.ok);
        std::vector<const Trial*> out;
        for (const Trial& t : of) if (t.ok >= enough_ok * most && std::isfinite(t.error)) out.push_back(&t);
        return out;
    }

    /// Shortest first.
    const Trial* shortest_of(const std::vector<Trial>& of) const {
        const auto all = candidates(of);
        if (all.empty()) return nullptr;
        const double least = (*std::min_element(all.begin(), all.end(), [](const Trial* a, const Trial* b) { return a->error < b->error; }))->error;
        const double enough = options_.accuracy && *options_.accuracy > least ? *options_.accuracy : as_good * least;
        return *std::find_if(all.begin(), all.end(), [&](const Trial* t) { return t->error <= enough; });
    }

    /// None where no parameter rises above its scatter: errors of nothing are zero.
    std::optional<Trial> best() const {
        if (std::none_of(out_.reference.counts.begin(), out_.reference.counts.end(), [](bool counts) { return counts; })) return std::nullopt;
        const Trial* plain = shortest_of(out_.curve);
        if (plain == nullptr) return std::nullopt;
        const Trial* other = nullptr;
        for (const Trial* t : candidates(out_.others)) if (other == nullptr || t->error < other->error) other = t;
        const bool good_enough = options_.accuracy && plain->error <= *options_.accuracy;
        return other != nullptr && !good_enough && other->error < worth_a_change * plain->error ? *other : *plain;
    }

    std::vector<std::string> lacking(model::Model model) const {
        model.growing = false;   // rows at hand are those of whole windows, by weights
        model.estimator.engine = "fir";
        Diagnostics unsaid;
        const auto plan = plan_of(model, true, unsaid);
        return plan ? missing_excitation(model, *plan, recording_) : std::vector<std::string>();
    }

    const model::Model& model_;
    const Recording& recording_;
    const DesignOptions& options_;
    Diagnostics& diagnostics_;
    const std::function<void(double)>& progress_;
    Design out_{};
};

}  // namespace

std::optional<Design> design(const model::Model& model, const Recording& recording, const DesignOptions& options, Diagnostics& diagnostics, const std::function<void(double)>& progress) {
    return Designer(model, recording, options, diagnostics, progress).run();
}

}  // namespace algest::lab
