// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/discover.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "lab/amend.hpp"
#include "lab/fit.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr double fit_share = 0.7;            ///< of the training rows are fitted, the rest validate
constexpr double needed_gain = 0.93;         ///< an effect must bring the validation error below this times what it was
constexpr std::size_t finalists = 4;         ///< candidates that are fitted in free run
constexpr int most_effects = 2;
constexpr double share_of_structure = 0.15;  ///< of a residual that the state foretells: noise does not reach it
constexpr double at_the_floor = 1.15;        ///< gap over floor that counts as none

/// A model text with what was added to it, ready to run.
struct Variant {
    std::string text;
    std::vector<Amendment> amendments;
    model::Model model;
    model::Model whole;      ///< the model of the text; `model` is without idle kinematics
    Bench bench;
    Fit fit;
    double validation = 0;   ///< rms over outputs of nrmse on the validation rows
};

struct Candidate {
    Binding binding;
    double scan = 0;
    double gain = 0;                        ///< relative reduction of the weak residual
    double strength = 0;                    ///< F statistic of it
    std::vector<double> start;              ///< parameters of the amended model
};

class Search {
public:
    Search(const std::string& path, const Recording& recording, const std::vector<Effect>& effects, Diagnostics& diagnostics, const StepReport& progress)
        : path_(path), recording_(recording), effects_(effects), diagnostics_(diagnostics), progress_(progress) {}

    std::optional<Discovery> run(const std::string& text, const DiscoverOptions& options) {
        auto nominal = prepare(text, {});
        if (!nominal) return std::nullopt;
        if (!choose_rows(options)) return std::nullopt;
        const auto start = parameter_values(nominal->model, {}, diagnostics_);
        if (!start) return std::nullopt;
        say("fit the nominal model", 0.05);
        fit_variant(*nominal, *start, nominal->bench.initial);
        Discovery out;
        floors(*nominal);
        Variant best = *nominal;
        std::vector<std::pair<Variant, std::string>> rivals;
        double gap = gap_over_floor(*nominal);
        Verdict verdict = Verdict::none;
        if (gap > at_the_floor) {
            for (int step = 0; step < most_effects; ++step) {
                say("screen effects", 0.15 + 0.4 * step);
                std::vector<Candidate> candidates = screen(best);
                say("fit the most likely", 0.25 + 0.4 * step);
                std::vector<Variant> fitted;
                for (const Candidate& c : candidates) {
                    auto variant = amended_variant(best, c);
                    if (variant) fitted.push_back(std::move(*variant));
                }
                if (fitted.empty()) break;
                std::stable_sort(fitted.begin(), fitted.end(), [](const Variant& a, const Variant& b) { return a.validation < b.validation; });
                if (!(fitted[0].validation < needed_gain * best.validation)) break;
                rivals.clear();
                for (std::size_t k = 1; k < fitted.size(); ++k) {
                    if (fitted[k].validation < 1.05 * fitted[0].validation) rivals.emplace_back(fitted[k], fitted[k].amendments.back().effect);
                }
                best = fitted[0];
                gap = gap_over_floor(best);
                if (gap <= at_the_floor) break;
            }
            verdict = judge(*nominal, best, rivals, gap);
        }
        out.verdict = verdict;
        if (verdict == Verdict::none || verdict == Verdict::unknown) best = *nominal;
        if (verdict == Verdict::ambiguous) {
            std::set<std::string> alternatives = {best.amendments.back().effect};
            for (const auto& [variant, name] : rivals) alternatives.insert(name);
            for (const std::string& name : alternatives) {
                out.alternatives.push_back({name});
                for (const Effect& effect : effects_) {
                    if (effect.name != name) continue;
                    for (const Rival& rival : effect.rivals) if (alternatives.count(rival.name) > 0 && std::find(out.experiments.begin(), out.experiments.end(), rival.experiment) == out.experiments.end()) out.experiments.push_back(rival.experiment);
                }
            }
        }
        say("confirm", 0.95);
        confirm(*nominal, best, out);
        return out;
    }

private:
    void say(const std::string& what, double share) const { if (progress_) progress_(what, share); }

    std::optional<Variant> prepare(const std::string& text, std::vector<Amendment> amendments) {
        Diagnostics own;
        Diagnostics& diagnostics = amendments.empty() ? diagnostics_ : own;
        auto model = model::read_from_text(text, path_, false, diagnostics);
        if (!model) return std::nullopt;
        if (amendments.empty()) find_idle_kinematics(*model);
        const model::Model whole = *model;
        drop_idle_kinematics(*model);
        auto bench = lab::bench(*model, recording_, diagnostics);
        if (!bench) return std::nullopt;
        bench->options.tolerance = 1e-6;
        return Variant{text, std::move(amendments), std::move(*model), whole, std::move(*bench), {}, 0};
    }

    static void names_in(const formula::Formula& f, std::set<std::string>& out) {
        if (f->kind == formula::Kind::name) out.insert(f->name);
        for (const formula::Formula& a : f->arguments) names_in(a, out);
    }

    /// Equations der(x) = v whose x nothing else uses and nothing scores: x is measured, and replayed where an effect needs it.
    void find_idle_kinematics(const model::Model& model) {
        for (std::size_t e = 0; e < model.equations.size(); ++e) {
            const formula::Formula& left = model.equations[e].sides.left;
            if (left->kind != formula::Kind::call || left->name != "der" || left->arguments.size() != 1) continue;
            const model::Signal& x = *model.signal(left->arguments[0]->name);
            bool used = false;
            for (std::size_t other = 0; other < model.equations.size(); ++other) {
                std::set<std::string> names;
                names_in(model.equations[other].sides.left, names);
                names_in(model.equations[other].sides.right, names);
                used = used || (other != e && names.count(x.name) > 0);
            }
            if (!used && !x.scored && recording_.column(x.column) != nullptr) idle_.insert(model.equations[e].name);
        }
    }

    void drop_idle_kinematics(model::Model& model) const {
        model.equations.erase(std::remove_if(model.equations.begin(), model.equations.end(), [&](const model::Equation& e) { return idle_.count(e.name) > 0; }), model.equations.end());
    }

    bool choose_rows(const DiscoverOptions& options) {
        const std::size_t samples = recording_.samples();
        const auto row = [&](double t) { return static_cast<std::size_t>(std::lower_bound(recording_.t.begin(), recording_.t.end(), t - 0.5 * recording_.period) - recording_.t.begin()); };
        train_ = options.train_s ? Rows{row(options.train_s->first), row(options.train_s->second)} : Rows{0, samples * 7 / 10};
        test_ = options.test_s ? Rows{row(options.test_s->first), std::min(row(options.test_s->second) + 1, samples)} : Rows{train_.end, samples};
        if (train_.end <= train_.begin + 100 || test_.end <= test_.begin + 10) {
            diagnostics_.error(recording_.file, {}, "too short: " + std::to_string(train_.size()) + " samples to train on, " + std::to_string(test_.size()) + " to test on", "at least 100 and 10 are needed");
            return false;
        }
        fit_rows_ = {train_.begin, train_.begin + static_cast<std::size_t>(fit_share * static_cast<double>(train_.size()))};
        return true;
    }

    void fit_variant(Variant& v, const std::vector<double>& start, const std::vector<double>& initial) const {
        v.fit = fit(v.model, v.bench, {start, {}, initial, fit_rows_, 15});
        RunOptions options = v.bench.options;
        options.first = fit_rows_.begin;
        Drive drive = v.bench.drive;
        drive.samples = train_.end;
        const FreeRun run = free_run(v.bench.system, v.fit.parameters, v.fit.initial, drive, options);
        v.validation = 0;
        const auto outputs = scored_outputs(v.model, v.bench);
        for (const int s : outputs) {
            const std::size_t k = static_cast<std::size_t>(s);
            double squares = 0;
            for (std::size_t row = fit_rows_.end; row < train_.end; ++row) {
                const double miss = row - fit_rows_.begin < run.samples ? v.bench.measured[k][row] - run.signals[k][row - fit_rows_.begin] : 1e3 * size_of(v.bench.measured[k]);
                squares += miss * miss;
            }
            v.validation += squares / static_cast<double>(train_.end - fit_rows_.end) / std::pow(size_of(v.bench.measured[k]), 2) / static_cast<double>(outputs.size());
        }
        v.validation = std::sqrt(v.validation);
    }

    void floors(const Variant& nominal) {
        for (const int s : scored_outputs(nominal.model, nominal.bench)) {
            const model::Signal& signal = nominal.model.signals[static_cast<std::size_t>(s)];
            const double noise = signal.noise ? exact::nearest(*signal.noise, plan::Scalar::float64) : 0.0;
            const double step = signal.resolution ? exact::nearest(*signal.resolution, plan::Scalar::float64) : 0.0;
            floor_.push_back(std::sqrt(noise * noise + step * step / 12.0) / size_of(nominal.bench.measured[static_cast<std::size_t>(s)]));
        }
    }

    /// rms over outputs of the validation error over the floor's.
    double gap_over_floor(const Variant& v) const {
        double squares = 0;
        for (const double f : floor_) squares += f * f / static_cast<double>(floor_.size());
        return squares > 0 ? v.validation / std::sqrt(squares) : std::numeric_limits<double>::infinity();
    }

    std::vector<bool> measured(const Variant& v) const {
        std::vector<bool> out;
        for (const auto& m : v.bench.measured) out.push_back(!m.empty());
        return out;
    }

    /// The most likely candidates by the weak form of the equation that they enter.
    std::vector<Candidate> screen(const Variant& base) {
        std::vector<Candidate> all;
        for (const Effect& effect : effects_) {
            if (std::any_of(base.amendments.begin(), base.amendments.end(), [&](const Amendment& a) { return a.effect == effect.name; })) continue;
            for (const Binding& binding : bindings(effect, base.whole, measured(base))) {
                Candidate best{binding, 0, 0, -1, {}};
                const std::vector<double> scans = scan_values(effect);
                for (const double scan : scans) {
                    Candidate c = weigh(base, binding, scan);
                    c.strength /= scans.size() > 1 ? 1.5 : 1.0;   // a scan finds something in any noise
                    if (c.strength > best.strength) best = c;
                }
                if (best.strength > 0) all.push_back(best);
            }
        }
        std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
        if (all.size() > finalists) all.resize(finalists);
        return all;
    }

    static std::vector<double> scan_values(const Effect& effect) {
        if (effect.scans.empty()) return {0.0};
        std::vector<double> out;
        for (double v = effect.scans[0].from; v <= effect.scans[0].to + 1e-9; v += effect.scans[0].step) out.push_back(v);
        return out;
    }

    /// Equations are found again by name: amendments leave their order alone, dropped kinematics do not.
    static std::size_t index_of(const model::Model& model, const std::string& equation) {
        for (std::size_t e = 0; e < model.equations.size(); ++e) if (model.equations[e].name == equation) return e;
        return 0;
    }

    std::string amended_text(const Variant& base, const Amendment& a) {
        return amended(base.text, base.whole, a);
    }

    Candidate weigh(const Variant& base, const Binding& binding, double scan) {
        Candidate out{binding, scan, 0, -1, {}};
        const Amendment a = amendment(binding, base.model, scan);
        Diagnostics quiet;
        auto model = model::read_from_text(amended_text(base, a), path_, false, quiet);
        if (!model) return out;
        drop_idle_kinematics(*model);
        std::vector<double> start;
        for (const model::Parameter& p : model->parameters) {
            const int old = base.model.parameter_index(p.name);
            start.push_back(old >= 0 ? base.fit.parameters[static_cast<std::size_t>(old)] : 0.0);
        }
        const std::string& where = base.whole.equations[binding.equations[0]].name;
        for (const int intervals : {16, 64}) {
            const auto without = weak_form(base.model, base.bench, index_of(base.model, where), fit_rows_, intervals);
            const auto with = weak_form(*model, base.bench, index_of(*model, where), fit_rows_, intervals);
            if (!without || !with || with->coefficients.size() == without->coefficients.size()) continue;   // the product stands there already
            const WeakFit before = weak_fit(*without, base.fit.parameters);
            const WeakFit after = weak_fit(*with, start);
            const double freedom = std::max(after.windows - after.unknowns, 1);
            const double strength = (before.residual - after.residual) / (after.residual / freedom) / std::max(after.unknowns - before.unknowns, 1);
            if (strength > out.strength) {
                out.strength = strength;
                out.gain = 1 - after.residual / before.residual;
                out.start = after.parameters;
            }
        }
        return out;
    }

    std::optional<Variant> amended_variant(const Variant& base, const Candidate& c) {
        Amendment a = amendment(c.binding, base.model, c.scan);
        for (NewName& n : a.names) {
            if (n.constant) continue;
            // The weak form's value is where the fit starts.
            Diagnostics quiet;
            const auto probe = model::read_from_text(amended_text(base, a), path_, false, quiet);
            if (!probe) return std::nullopt;
            const int index = probe->parameter_index(n.name);
            double value = index >= 0 && static_cast<std::size_t>(index) < c.start.size() ? c.start[static_cast<std::size_t>(index)] : 0.0;
            if (n.not_negative) value = std::max(value, 0.0);
            n.value = value;
        }
        auto amendments = base.amendments;
        amendments.push_back(a);
        auto variant = prepare(amended_text(base, a), amendments);
        if (!variant) return std::nullopt;
        std::vector<double> start;
        for (std::size_t p = 0; p < variant->model.parameters.size(); ++p) {
            const int old = base.model.parameter_index(variant->model.parameters[p].name);
            start.push_back(old >= 0 ? base.fit.parameters[static_cast<std::size_t>(old)] : exact::nearest(*variant->model.parameters[p].initial, plan::Scalar::float64));
        }
        fit_variant(*variant, start, base.fit.initial);
        return variant;
    }

    Verdict judge(const Variant& nominal, const Variant& best, const std::vector<std::pair<Variant, std::string>>& rivals, double gap) const {
        if (best.amendments.empty()) return structured(nominal) ? Verdict::unknown : Verdict::none;
        if (gap > 1.5 && structured(best)) return Verdict::unknown;
        if (gap > 1.5 && !(best.validation < 0.6 * nominal.validation)) return structured(nominal) ? Verdict::unknown : Verdict::none;
        return rivals.empty() ? Verdict::named : Verdict::ambiguous;
    }

    /// True when a residual of some equation can be foretold from the state: no noise does that.
    bool structured(const Variant& v) const {
        for (std::size_t e = 0; e < v.model.equations.size(); ++e) {
            const auto form = weak_form(v.model, v.bench, e, train_, 32);
            if (!form) continue;
            const WeakFit f = weak_fit(*form, v.fit.parameters);
            if (foretold(v, *form, weak_residual(*form, f.parameters)) > share_of_structure) return true;
        }
        return false;
    }

    /// Share of the residual's power that features of the state explain on windows they were not fitted to.
    double foretold(const Variant& v, const WeakForm& form, const Eigen::VectorXd& r) const {
        std::vector<std::vector<double>> features;
        for (std::size_t s = 0; s < v.bench.measured.size(); ++s) {
            const std::vector<double>& m = v.bench.measured[s];
            if (m.empty()) continue;
            const double size = std::max(size_of(m), 1e-300);
            std::vector<double> linear, cubic, sign, square;
            for (const std::size_t row : form.centre) {
                const double x = m[row] / size;
                linear.push_back(x);
                square.push_back(x * x);
                cubic.push_back(x * x * x);
                sign.push_back(x > 0 ? 1.0 : -1.0);
            }
            for (auto* f : {&linear, &square, &cubic, &sign}) features.push_back(*f);
            for (const std::size_t lag : {1, 2, 4}) {   // what remembers, such as hysteresis, shows against the past
                std::vector<double> past(linear.size(), 0.0), past_sign(linear.size(), 0.0);
                for (std::size_t w = lag; w < linear.size(); ++w) {
                    past[w] = linear[w - lag];
                    past_sign[w] = sign[w - lag];
                }
                features.push_back(past);
                features.push_back(past_sign);
            }
        }
        const Eigen::Index windows = r.size();
        Eigen::MatrixXd X(windows, static_cast<Eigen::Index>(features.size()) + 1);
        X.col(0).setOnes();
        for (std::size_t f = 0; f < features.size(); ++f) for (Eigen::Index w = 0; w < windows; ++w) X(w, static_cast<Eigen::Index>(f) + 1) = features[f][static_cast<std::size_t>(w)];
        const Eigen::Index half = windows / 2;
        if (half < 2 * X.cols()) return 0;
        const Eigen::VectorXd first = X.topRows(half).colPivHouseholderQr().solve(r.head(half));
        const Eigen::VectorXd second = X.bottomRows(windows - half).colPivHouseholderQr().solve(r.tail(windows - half));
        const double missed = (r.tail(windows - half) - X.bottomRows(windows - half) * first).squaredNorm() + (r.head(half) - X.topRows(half) * second).squaredNorm();
        return 1 - missed / r.squaredNorm();
    }

    void confirm(Variant& nominal, Variant& best, Discovery& out) {
        const auto whole = [&](const Variant& v) {
            RunOptions options = v.bench.options;
            options.tolerance = 1e-8;
            options.first = fit_rows_.begin;
            return free_run(v.bench.system, v.fit.parameters, v.fit.initial, v.bench.drive, options);
        };
        out.before = whole(nominal);
        out.after = best.amendments.empty() ? out.before : whole(best);
        const auto outputs = scored_outputs(nominal.model, nominal.bench);
        const auto error = [&](const Variant& v, const FreeRun& run, std::size_t s) {
            double squares = 0;
            for (std::size_t row = test_.begin; row < test_.end; ++row) {
                const double miss = row - fit_rows_.begin < run.samples ? v.bench.measured[s][row] - run.signals[s][row - fit_rows_.begin] : 1e3 * size_of(v.bench.measured[s]);
                squares += miss * miss;
            }
            return std::sqrt(squares / static_cast<double>(test_.size())) / size_of(v.bench.measured[s]);
        };
        for (std::size_t o = 0; o < outputs.size(); ++o) {
            const std::size_t s = static_cast<std::size_t>(outputs[o]);
            out.outputs.push_back({nominal.model.signals[s].name, error(nominal, out.before, s), error(best, out.after, s), floor_[o]});
        }
        for (const Amendment& a : best.amendments) {
            NamedEffect named{a.effect, {}, {}, {}, {}, {}};
            for (std::size_t k = 0; k < a.equations.size(); ++k) {
                named.equation += (k > 0 ? ", " : "") + best.whole.equations[a.equations[k]].name;
                named.term += (k > 0 ? ", " : "") + a.terms[k];
            }
            for (const NewName& n : a.names) {
                const int p = best.model.parameter_index(n.name);
                if (p >= 0) named.parameters.push_back({n.name, n.unit, best.fit.parameters[static_cast<std::size_t>(p)], best.fit.sd[static_cast<std::size_t>(p)]});
                else named.parameters.push_back({n.name, n.unit, n.value, 0});
            }
            out.effects.push_back(named);
        }
        out.model_text = text_with_fitted_values(nominal, best);
        locate(nominal, out);
    }

    /// The nominal text amended once more, new parameters starting at what the fit found.
    static std::string text_with_fitted_values(const Variant& nominal, const Variant& best) {
        std::string text = nominal.text;
        for (Amendment a : best.amendments) {
            for (NewName& n : a.names) {
                const int p = best.model.parameter_index(n.name);
                if (p >= 0) n.value = best.fit.parameters[static_cast<std::size_t>(p)];
            }
            Diagnostics quiet;
            const auto model = model::read_from_text(text, nominal.model.path, false, quiet);
            if (model) text = amended(text, *model, a);
        }
        return text;
    }

    /// Where the nominal model is off: the weak residual of every equation, in units of its largest term.
    void locate(const Variant& nominal, Discovery& out) const {
        std::vector<std::pair<WeakForm, Eigen::VectorXd>> residuals;
        std::vector<double> power;
        double total = 0;
        for (std::size_t e = 0; e < nominal.model.equations.size(); ++e) {
            const auto form = weak_form(nominal.model, nominal.bench, e, train_, 32);
            if (!form) continue;
            const Eigen::VectorXd r = weak_residual(*form, nominal.fit.parameters);
            double largest = 0;
            for (Eigen::Index k = 0; k < form->columns.cols(); ++k) {
                WeakForm one = *form;
                for (Eigen::Index other = 0; other < one.columns.cols(); ++other) if (other != k) one.columns.col(other).setZero();
                largest = std::max(largest, weak_residual(one, nominal.fit.parameters).squaredNorm());
            }
            power.push_back(largest > 0 ? r.squaredNorm() / largest : 0.0);
            total += power.back();
            residuals.emplace_back(*form, r);
            out.where.push_back({nominal.model.equations[e].name, 0, 0, 0, ""});
        }
        for (std::size_t k = 0; k < out.where.size(); ++k) {
            Where& w = out.where[k];
            const auto& [form, r] = residuals[k];
            w.share = total > 0 ? power[k] / total : 0;
            // The shortest stretch from the first to the last window between which nine tenths of the power lie.
            double sum = 0;
            const double all = r.squaredNorm();
            std::size_t first = 0, last = form.centre.size() - 1;
            for (Eigen::Index i = 0; i < r.size(); ++i) {
                const double before = sum;
                sum += r[i] * r[i];
                if (before < 0.05 * all) first = static_cast<std::size_t>(i);
                if (before < 0.95 * all) last = static_cast<std::size_t>(i);
            }
            w.from_s = recording_.t[form.centre[first]];
            w.to_s = recording_.t[form.centre[last]];
            w.region = region(nominal, form, r);
        }
    }

    /// The signal, or its sign, or the square with its sign, that explains a residual best on its own.
    static std::string region(const Variant& v, const WeakForm& form, const Eigen::VectorXd& r) {
        std::string best = "no single signal explains it";
        double most = 0.1;
        for (std::size_t s = 0; s < v.bench.measured.size(); ++s) {
            const std::vector<double>& m = v.bench.measured[s];
            if (m.empty()) continue;
            const std::string& name = v.model.signals[s].name;
            for (const int kind : {0, 1, 2}) {
                Eigen::MatrixXd X(r.size(), 2);
                X.col(0).setOnes();
                for (Eigen::Index w = 0; w < r.size(); ++w) {
                    const double x = m[form.centre[static_cast<std::size_t>(w)]];
                    X(w, 1) = kind == 0 ? x : kind == 1 ? (x > 0 ? 1.0 : -1.0) : x * std::abs(x);
                }
                const double missed = (r - X * X.colPivHouseholderQr().solve(r)).squaredNorm();
                const double centred = (r.array() - r.mean()).matrix().squaredNorm();
                const double share = centred > 0 ? 1 - missed / centred : 0;
                if (share > most) {
                    most = share;
                    best = kind == 0 ? "grows with " + name : kind == 1 ? "follows the sign of " + name : "grows with the square of " + name;
                }
            }
        }
        return best;
    }

    std::string path_;
    const Recording& recording_;
    const std::vector<Effect>& effects_;
    Diagnostics& diagnostics_;
    const StepReport& progress_;
    std::set<std::string> idle_;
    Rows train_{};
    Rows test_{};
    Rows fit_rows_{};
    std::vector<double> floor_;
};

}  // namespace

const char* name(Verdict verdict) {
    switch (verdict) {
        case Verdict::named: return "named";
        case Verdict::ambiguous: return "ambiguous";
        case Verdict::none: return "none";
        case Verdict::unknown: return "unknown";
    }
    return "?";
}

std::optional<Discovery> discover(const std::string& model_text, const std::string& model_path, const Recording& recording, const std::vector<Effect>& effects,
                                  const DiscoverOptions& options, Diagnostics& diagnostics, const StepReport& progress) {
    return Search(model_path, recording, effects, diagnostics, progress).run(model_text, options);
}

}  // namespace algest::lab
