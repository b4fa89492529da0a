// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/screen.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lab/golden_section.hpp"
#include "lab/largest_size.hpp"
#include "lab/noise.hpp"
#include "lab/scan_values.hpp"
#include "lab/spectrum.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr std::size_t bindings_of_one = 2;        ///< of one effect among those that the weak form takes
constexpr double least_share = 0.1;               ///< of the free run's error, for what the weak form does not take
constexpr double nearby = 1.1;                  ///< times a scanned number: near enough for a power of it, far enough for a run's tolerance
constexpr double flattest = 0.3;                ///< power below which a number is not told by the size of what it does, (1 of delays, -2 of a saturation),
constexpr double steepest = 4;                  ///< nor above
constexpr double least_of_its_own = 1e-4;         ///< of an effect's slope that no parameter of the model makes
constexpr double least_driven = 0.3;              ///< of what inputs do without an effect, that they have to do beside it: a law of the position alone
                                                  ///< explains away a weight that is known, everything else of the equation at zero
constexpr double probe = 0.02;                    ///< of what drives an equation, or of a value that is replaced
constexpr double unsized_probe = 1e-3;            ///< where nothing tells its size, to begin with
constexpr std::size_t lines_that_are_tried = 2;   ///< of each spectrum
constexpr double one_line = 4;                    ///< widths, within which two lines are one
constexpr double least_to_sharpen = 10;           ///< F statistic from which on a scanned value is worth placing between those of the scan
constexpr std::size_t most_scanned_by_run = 16;
constexpr double small_change = 0.02;             ///< of the outputs, that a probe of a parameter makes
constexpr int most_probes = 4;
constexpr Eigen::Index stretches_of_a_run = 32;   ///< by which a share is sure or not: chosen, some hundred samples each

/// The weak residuals of the model as it is, by equation and window length: every candidate is compared with them.
class Screen {
public:
    Screen(Workbench& bench, const Variant& base) : bench_(bench), base_(base), measured_(base.bench.measured.size(), true) {
        for (std::size_t r = 0; r < bench.recordings(); ++r) {
            recorded_.push_back(bench_of(base, r));
            for (std::size_t s = 0; s < measured_.size(); ++s) measured_[s] = measured_[s] && !recorded_[r].measured[s].empty();
            recorded_[r].measured.push_back(bench.recording(r).t);   // an amendment that brings a signal brings time, as the last
        }
        for (std::size_t r = 0; r < bench.recordings(); ++r) with_time_.push_back({&recorded_[r], bench.parts(r).fitted});
    }

    std::vector<Candidate> of(const Effect& effect) {
        std::vector<Candidate> out;
        for (const Binding& binding : bindings(effect, base_.whole, measured_)) {
            if (enters_what_was_added(binding) || goes_below_zero(binding)) continue;
            Candidate best{binding, 0, 0, 0, {}, {}};
            const std::vector<double> scans = effect.scans.empty() ? std::vector<double>{0.0} : effect.scans[0].spectrum ? lines(binding) : scan_values(effect.scans[0], counted_in(effect.scans[0], binding));
            // Rows do not see a state, and what equations share they see one by one; a scan's value they know better than a run that has gone astray.
            const bool by_rows = effect.rewrite == Rewrite::add_term || (!effect.scans.empty() && effect.states.empty()) || effect.rewrite == Rewrite::free_constant;
            std::vector<Candidate> weighed;
            for (const double scan : by_rows ? scans : std::vector<double>()) {
                weighed.push_back(weigh(binding, scan));
                if (scans.size() > 1) weighed.back().strength /= price_of_a_scan;
                if (weighed.back().strength > best.strength || weighed.back().strength < 0) best = weighed.back();
            }
            if (best.strength < 0) continue;
            if (best.strength > 0 && !effect.scans.empty() && effect.scans[0].spectrum) {
                for (Candidate& wave : waves(std::move(weighed))) out.push_back(std::move(wave));
                continue;
            }
            if (best.strength > least_to_sharpen && !effect.scans.empty() && effect.scans[0].fitted) {
                best = sharpened(std::move(best), below(scans, best.scan) - best.scan, above(scans, best.scan) - best.scan);
            }
            if (best.strength == 0 && !effect.scans.empty() && scans.size() <= most_scanned_by_run) best.scans = scans;
            out.push_back(std::move(best));
        }
        return out;
    }

private:
    /// Equations that amendments have brought stand behind those of the nominal model; a scanned constant is in no doubt of its own.
    bool enters_what_was_added(const Binding& binding) const {
        for (const Amendment& a : base_.amendments) for (const NewName& n : a.names) if (n.name == binding.freed && !n.let_go) return true;
        std::size_t added = 0;
        for (const Amendment& a : base_.amendments) added += a.states.size();
        return std::any_of(binding.equations.begin(), binding.equations.end(), [&](std::size_t e) { return e + added >= base_.whole.equations.size(); });
    }

    /// What stands for an unsigned sensor is negative somewhere, by more than noise makes of zero.
    bool goes_below_zero(const Binding& binding) const {
        constexpr double deviations = 4;
        for (const auto& [role, kind] : binding.effect->roles) {
            if (kind != "unsigned_sensor") continue;
            const auto s = static_cast<std::size_t>(base_.model.signal_index(binding.roles[0].at(role)));
            for (std::size_t r = 0; r < bench_.recordings(); ++r) {
                const Bench& own = bench_of(base_, r);
                const double least = *std::min_element(own.measured[s].begin(), own.measured[s].end());
                if (least < -deviations * noise_by_signal(base_.model, own)[s]) return true;
            }
        }
        return false;
    }

    double counted_in(const EffectScan& scan, const Binding& binding) {
        if (scan.of.empty()) return 1;
        if (scan.of == "period") return base_.bench.drive.period;
        if (scan.of == "duration") return static_cast<double>(bench_.parts().train.size()) * base_.bench.drive.period;
        return largest_size(binding.roles[0].at(scan.of), base_.model, seen());
    }

    /// The first recording, hidden states as the base's run has them: a vessel that nobody measures runs over too.
    const Bench& seen() {
        if (seen_) return *seen_;
        seen_ = base_.bench;
        const bool hides = std::any_of(seen_->system.moving.begin(), seen_->system.moving.end(), [&](int s) { return seen_->measured[static_cast<std::size_t>(s)].empty(); });
        if (!hides || bench_.yardstick() != Yardstick::free_run) return *seen_;
        const auto run = prediction(base_.bench, base_.fit.parameters, base_.fit.initial, bench_.parts().fitted);
        for (const int s : seen_->system.moving) {
            std::vector<double>& m = seen_->measured[static_cast<std::size_t>(s)];
            if (m.empty()) m = run[static_cast<std::size_t>(s)];
        }
        return *seen_;
    }

    Candidate weigh(const Binding& binding, double scan) {
        Candidate out{binding, scan, 0, 0, {}, {}};
        const Amendment a = amendment(binding, base_.model, scan);
        const auto model = bench_.runnable(amended(base_.text, base_.whole, a));
        if (!model) return out;
        std::vector<double> start;
        for (const model::Parameter& p : model->parameters) {
            const int old = base_.model.parameter_index(p.name);
            const auto added = std::find_if(a.names.begin(), a.names.end(), [&](const NewName& n) { return n.name == p.name; });
            start.push_back(old >= 0 ? base_.fit.parameters[static_cast<std::size_t>(old)] : added != a.names.end() ? added->value : 0.0);
        }
        const bool adds_terms = binding.effect->rewrite == Rewrite::add_term;
        // An effect that enters several equations at once is measured by the one that it explains least.
        for (const int intervals : weak_intervals(bench_.parts().fitted)) {
            double least = std::numeric_limits<double>::infinity();
            std::vector<double> parameters = start;
            for (const std::size_t e : binding.equations) {
                if (binding.beside.count(e) > 0) continue;
                const std::string& where = base_.whole.equations[e].name;
                const auto& before = without(where, intervals);
                const auto with = weak_form(*model, with_time_, equation_index(*model, where), intervals);
                if (adds_terms && with && before && with->coefficients.size() == before->terms && known_alone(*with, *model)) {
                    out.strength = -1;   // the same product with a value that is declared known: that value is in doubt, not an effect missing
                    return out;
                }
                if (!before || !with || (adds_terms && with->coefficients.size() == before->terms)) {   // the product stands there: only a free run may tell
                    least = -1;
                    break;
                }
                if (with->left_out > before->left_out) {   // rows that lack what those of the others have cannot be compared
                    bench_.refuse(binding.effect->name, where);
                    out.strength = -1;
                    return out;
                }
                const WeakFit after = weak_fit(*with, start);
                if (input_size(*with, after.parameters) < least_driven * before->input) {   // it takes the place of what drives the machine
                    least = -1;
                    break;
                }
                const double strength = f_statistic(before->fit, after);
                if (strength < least) {
                    least = strength;
                    parameters = after.parameters;
                }
            }
            if (least > out.strength) {
                out.strength = least;
                out.start = parameters;
            }
        }
        return out;
    }

    /// True when a term that a new parameter multiplies has no parameter of the base's beside it.
    bool known_alone(const WeakForm& with, const model::Model& model) const {
        for (const Polynomial& coefficient : with.coefficients) {
            bool added = false;
            bool old = false;
            for (std::size_t p = 0; p < model.parameters.size(); ++p) {
                if (!uses(coefficient, p)) continue;
                (base_.model.parameter_index(model.parameters[p].name) < 0 ? added : old) = true;
            }
            if (added && !old) return true;
        }
        return false;
    }

    /// The strongest lines of the spectra of an equation's residual, rad/s, by windows of every length: short ones drown slow waves in noise,
    /// long ones average fast ones away.
    std::vector<double> lines(const Binding& binding) const {
        const std::size_t e = equation_index(base_.model, base_.whole.equations[binding.equations[0]].name);
        std::vector<double> out;
        for (const int intervals : weak_intervals(bench_.parts().fitted)) {
            const auto form = weak_form(base_.model, base_.bench, e, bench_.parts().fitted, intervals);
            if (!form) continue;
            const double spacing = static_cast<double>(form->centre.at(1) - form->centre.at(0)) * base_.bench.drive.period;
            const Eigen::VectorXd r = weak_residual(*form, weak_fit(*form, base_.fit.parameters).parameters);
            for (const SpectralLine& line : spectral_lines(r, lines_that_are_tried)) if (is_new(binding, line.step / spacing)) out.push_back(line.step / spacing);
        }
        return out;
    }

    /// Lines that are more than one line, strongest first, each placed anew: the strongest in the rows may be of their own making, where a
    /// regressor's noise meets what drives the machine. The free run tells.
    std::vector<Candidate> waves(std::vector<Candidate> weighed) {
        std::stable_sort(weighed.begin(), weighed.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
        std::vector<Candidate> out;
        for (Candidate& c : weighed) {
            const bool apart = std::all_of(out.begin(), out.end(), [&](const Candidate& o) { return std::abs(o.scan - c.scan) > one_line * width(); });
            if (apart && c.strength > 0 && out.size() < lines_that_are_tried) out.push_back(sharpened(std::move(c), -0.5 * width(), 0.5 * width()));
        }
        return out;
    }

    double width() const { return line_width(bench_.parts().fitted.size(), base_.bench.drive.period); }

    /// False beside a wave that the base has already: what is left there is that wave's own inaccuracy.
    bool is_new(const Binding& binding, double frequency) const {
        for (const Amendment& a : base_.amendments) {
            if (a.effect != binding.effect->name || a.equations != binding.equations) continue;
            for (const NewName& n : a.names) if (n.constant && std::abs(n.value - frequency) < one_line * width()) return false;
        }
        return true;
    }

    /// The scanned values on both sides of one.
    static double below(const std::vector<double>& scans, double value) {
        const auto at = std::find(scans.begin(), scans.end(), value);
        return at == scans.begin() ? value : *(at - 1);
    }
    static double above(const std::vector<double>& scans, double value) {
        const auto at = std::find(scans.begin(), scans.end(), value);
        return at + 1 == scans.end() ? value : *(at + 1);
    }

    /// The value near a scanned one at which the weak form explains most: golden section over a stretch around it.
    Candidate sharpened(Candidate c, double from, double to) {
        const double there = least_by_golden_section([&](double value) { return -weigh(c.binding, value).strength; }, c.scan + from, c.scan + to);
        Candidate best = weigh(c.binding, there);
        best.strength /= price_of_a_scan;
        return best.strength > c.strength ? best : c;
    }

    struct Before {
        WeakFit fit;
        std::size_t terms;
        double input;
        std::size_t left_out;
    };

    const std::optional<Before>& without(const std::string& equation, int intervals) {
        const auto key = std::pair(equation, intervals);
        const auto known = before_.find(key);
        if (known != before_.end()) return known->second;
        std::optional<Before> out;
        const auto form = weak_form(base_.model, bench_.stretches(base_, &Parts::fitted), equation_index(base_.model, equation), intervals);
        if (form) {
            const WeakFit fit = weak_fit(*form, base_.fit.parameters);
            out = Before{fit, form->coefficients.size(), input_size(*form, fit.parameters), form->left_out};
        }
        return before_.emplace(key, std::move(out)).first->second;
    }

    Workbench& bench_;
    const Variant& base_;
    std::vector<Bench> recorded_;        ///< of the base, with time, by recording
    std::vector<BenchRows> with_time_;
    std::optional<Bench> seen_;
    std::vector<bool> measured_;         ///< by signal, in every recording
    std::map<std::pair<std::string, int>, std::optional<Before>> before_;
};

}  // namespace

namespace {

/// The free run's error at the base's fit, without what its parameters could still take, and how far an effect would take it.
class Slope {
public:
    Slope(Workbench& bench, const Variant& base) : bench_(bench), base_(base), at_(bench.start_of(base, base, &Parts::fitted)) {
        residual_ = output_residual(base.model, base.bench, at_);
        const Eigen::HouseholderQR<Eigen::MatrixXd> qr(output_slopes(base.model, base.bench, at_));
        basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), std::min(qr.rows(), qr.cols()));
        left_ = outside(Eigen::Map<const Eigen::VectorXd>(residual_.data(), static_cast<Eigen::Index>(residual_.size())));
    }

    /// Sets the candidate's share and, where the weak form has none, its start and the value of its scan.
    void weigh(Candidate& c) const {
        const Workbench::OneOfMany share(bench_);
        if (c.scans.empty()) return weigh_at(c);
        Candidate best = c;
        for (const double scan : c.scans) {
            Candidate here = c;
            here.scan = scan;
            weigh_at(here);
            if (here.share > best.share) best = std::move(here);
            if (bench_.used_up()) break;
        }
        c = std::move(best);
    }

private:
    void weigh_at(Candidate& c) const {
        const Amendment a = amendment(c.binding, base_.model, c.scan);
        Diagnostics quiet;
        auto amendments = base_.amendments;
        amendments.push_back(a);
        auto v = bench_.prepare(amended(base_.text, base_.whole, a), std::move(amendments), quiet);
        if (!v || !(left_.squaredNorm() > 0)) return;
        carry_past(*v, base_);
        if (v->bench.options.stride != base_.bench.options.stride) return;   // it brings time to a run that nothing drove: other samples are kept
        FitStart at = bench_.start_of(*v, base_, &Parts::fitted);
        at.parameters = neutral_parameters(*v, a);
        const std::vector<const NewName*> added = moved_by_slope(a);
        Eigen::MatrixXd slopes(left_.size(), static_cast<Eigen::Index>(added.size()));
        std::vector<double> sizes;
        for (std::size_t k = 0; k < added.size(); ++k) sizes.push_back(probe_of(*v, at, *added[k], c.binding, slopes.col(static_cast<Eigen::Index>(k))));
        if (added.empty()) return weigh_scan_alone(c, *v, at);
        const double whole = slopes.squaredNorm();
        slopes = outside(slopes);
        if (!(slopes.squaredNorm() > least_of_its_own * whole)) return;   // what the parameters do already
        const Eigen::VectorXd move = within_bounds(slopes, added, sizes, at.parameters, v->model);
        if (move.isZero(0)) return;
        for (std::size_t k = 0; k < added.size(); ++k) at.parameters[static_cast<std::size_t>(v->model.parameter_index(added[k]->name))] += move[static_cast<Eigen::Index>(k)] * sizes[k];
        const Eigen::VectorXd rest = left_ + slopes * move;
        c.share = 1 - rest.squaredNorm() / left_.squaredNorm();
        const double scatter = slopes.cols() == 1 ? squared_scatter(slopes.col(0), rest) : 0;
        if (scatter > 0) c.sureness = std::pow(slopes.col(0).dot(left_), 2) / scatter;
        if (c.strength > 0) return;
        c.start = at.parameters;
    }

    /// The move of the added parameters, in their sizes, that takes most of what is left; one that it would take below its bound stays where it is.
    Eigen::VectorXd within_bounds(const Eigen::MatrixXd& slopes, const std::vector<const NewName*>& added, const std::vector<double>& sizes, const std::vector<double>& neutral, const model::Model& model) const {
        std::vector<Eigen::Index> open;
        for (Eigen::Index k = 0; k < slopes.cols(); ++k) open.push_back(k);
        Eigen::VectorXd out = Eigen::VectorXd::Zero(slopes.cols());
        while (!open.empty()) {
            const Eigen::VectorXd move = slopes(Eigen::all, open).colPivHouseholderQr().solve(-left_);
            const auto leaves = [&](Eigen::Index k) {
                const NewName& n = *added[static_cast<std::size_t>(k)];
                const double there = neutral[static_cast<std::size_t>(model.parameter_index(n.name))] + move[std::find(open.begin(), open.end(), k) - open.begin()] * sizes[static_cast<std::size_t>(k)];
                return n.min && there < *n.min;
            };
            const auto first = std::find_if(open.begin(), open.end(), leaves);
            if (first == open.end()) {
                for (std::size_t k = 0; k < open.size(); ++k) out[open[k]] = move[static_cast<Eigen::Index>(k)];
                return out;
            }
            open.erase(first);
        }
        return out;
    }

    /// How far the sum of a slope times the rest of the error scatters, by its sums over stretches: what lasts within one counts as it does.
    static double squared_scatter(const Eigen::VectorXd& slope, const Eigen::VectorXd& rest) {
        double squares = 0;
        for (Eigen::Index k = 0; k < stretches_of_a_run; ++k) {
            const Eigen::Index from = k * rest.size() / stretches_of_a_run;
            const Eigen::Index length = (k + 1) * rest.size() / stretches_of_a_run - from;
            squares += std::pow(slope.segment(from, length).dot(rest.segment(from, length)), 2);
        }
        return squares;
    }

    /// An effect of a scanned number alone: what it takes where it is, or would take as far along as suits it, since the model's parameters give
    /// way by more than their slope tells.
    void weigh_scan_alone(Candidate& c, const Variant& v, FitStart at) const {
        const Eigen::VectorXd whole = change_at(v, at);
        const Eigen::VectorXd change = outside(whole);
        if (!(change.squaredNorm() > least_of_its_own * whole.squaredNorm())) return;
        const double here = 1 - (left_ + change).squaredNorm() / left_.squaredNorm();
        const double further = std::max(-left_.dot(change) / change.squaredNorm(), 0.0);
        const double there = 1 - (left_ + further * change).squaredNorm() / left_.squaredNorm();
        c.start = at.parameters;
        c.share = here;
        if (c.binding.effect->scans.empty()) return;
        c.share = std::max(here, there);
        const EffectScan& scan = c.binding.effect->scans[0];
        const int p = v.model.parameter_index(scanned_name(v.amendments.back()));
        if (there > here && scan.fitted && p >= 0 && !c.scans.empty()) {
            double& value = at.parameters[static_cast<std::size_t>(p)];
            value = nearby * c.scan;
            const double power = power_of_scan(change.norm(), outside(change_at(v, at)).norm());
            c.scan = std::clamp(std::pow(further, 1 / power) * c.scan, c.scans.front(), c.scans.back());
            value = c.scan;
        }
        c.start = at.parameters;
    }

    /// The power of its scanned number that an effect grows with: 1 of a delay, -2 of a current at which an iron saturates.
    static double power_of_scan(double change, double change_nearby) {
        const double power = std::log(change_nearby / change) / std::log(nearby);
        return std::abs(power) > flattest ? std::clamp(power, -steepest, steepest) : 1;   // NaN: 1
    }

    static std::string scanned_name(const Amendment& a) {
        const auto found = std::find_if(a.names.begin(), a.names.end(), [](const NewName& n) { return n.scanned; });
        return found == a.names.end() ? "" : found->name;
    }

    Eigen::MatrixXd outside(const Eigen::MatrixXd& x) const { return x - basis_ * (basis_.transpose() * x); }

    /// The base's fit, with what an amendment brings at values where it does nothing, and scanned numbers where they are.
    std::vector<double> neutral_parameters(const Variant& v, const Amendment& a) const {
        std::vector<double> out;
        for (const model::Parameter& p : v.model.parameters) {
            const int old = base_.model.parameter_index(p.name);
            const auto added = std::find_if(a.names.begin(), a.names.end(), [&](const NewName& n) { return n.name == p.name; });
            if (old >= 0) out.push_back(base_.fit.parameters[static_cast<std::size_t>(old)]);
            else if (added == a.names.end()) out.push_back(0);
            else out.push_back(added->scanned ? added->value : neutral_value(*added));
        }
        return out;
    }

    double neutral_value(const NewName& n) const {
        if (n.neutral.empty()) return 0;
        const int p = base_.model.parameter_index(n.neutral);
        if (p >= 0) return base_.fit.parameters[static_cast<std::size_t>(p)];
        const model::Constant* c = base_.model.constant(n.neutral);
        return c != nullptr ? exact::nearest(c->value, plan::Scalar::float64) : std::stod(n.neutral);
    }

    static std::vector<const NewName*> moved_by_slope(const Amendment& a) {
        std::vector<const NewName*> out;
        for (const NewName& n : a.names) if (!n.constant && !n.scanned) out.push_back(&n);
        return out;
    }

    /// What the free run's residual changes by.
    Eigen::VectorXd change_at(const Variant& v, const FitStart& at) const {
        const std::vector<double> there = output_residual(v.model, v.bench, at);
        return Eigen::Map<const Eigen::VectorXd>(there.data(), static_cast<Eigen::Index>(there.size())) - Eigen::Map<const Eigen::VectorXd>(residual_.data(), static_cast<Eigen::Index>(residual_.size()));
    }

    /// A small move of an added parameter, and the change that it makes: a small part of what drives the equation, where rows tell, of what is
    /// replaced, else of the outputs.
    double probe_of(const Variant& v, FitStart at, const NewName& n, const Binding& binding, Eigen::Ref<Eigen::VectorXd> change) const {
        double& value = at.parameters[static_cast<std::size_t>(v.model.parameter_index(n.name))];
        const double neutral = value;
        double size = neutral != 0 ? probe * std::abs(neutral) : binding.effect->rewrite == Rewrite::add_term ? row_probe(v, at.parameters, n, binding) : 0;
        const bool sized = size > 0;
        if (!sized) size = unsized_probe;
        for (int k = 0; k < most_probes; ++k) {
            value = neutral + size;
            change = change_at(v, at);
            const double far = change.norm() / small_change;
            if (sized || (far > 0.1 && far < 10)) break;
            if (k + 1 < most_probes) size *= far > 0 ? std::clamp(1 / far, 1e-6, 1e6) : 1e6;
        }
        return size;
    }

    /// The value of a parameter at which its term is a small part of what drives the equation; 0: rows do not tell.
    double row_probe(const Variant& v, const std::vector<double>& parameters, const NewName& n, const Binding& binding) const {
        const std::size_t e = equation_index(v.model, base_.whole.equations[binding.equations[0]].name);
        const auto form = weak_form(v.model, v.bench, e, bench_.parts().fitted, weak_intervals(bench_.parts().fitted).front());
        if (!form) return 0;
        std::vector<double> one = parameters;
        one[static_cast<std::size_t>(v.model.parameter_index(n.name))] = 1.0;
        const double term = (weak_residual(*form, one) - weak_residual(*form, parameters)).norm() / std::sqrt(static_cast<double>(form->columns.rows()));
        const double driving = driving_size(*form, parameters);
        return term > 0 && driving > 0 ? probe * driving / term : 0;
    }

    Workbench& bench_;
    const Variant& base_;
    FitStart at_;
    std::vector<double> residual_;
    Eigen::MatrixXd basis_;
    Eigen::VectorXd left_;
};

}  // namespace

namespace {

/// It brings no number at all.
bool is_sizeless(const Effect& effect) { return effect.parameters.empty() && effect.scans.empty() && effect.freed.empty(); }

}  // namespace

std::vector<Candidate> screen(Workbench& bench, const Variant& base, const std::vector<Effect>& effects, std::size_t by_rows, std::size_t by_run) {
    Screen screen(bench, base);
    std::vector<Candidate> all;
    for (const Effect& effect : effects) {
        for (Candidate& c : screen.of(effect)) {
            // Where it stands already it does not come again, a wave of another order does.
            const bool again = !effect.scans.empty() && effect.rewrite == Rewrite::add_term;
            const std::string own = identity(amendment(c.binding, base.model, c.scan));
            const bool stands = !again && std::any_of(base.amendments.begin(), base.amendments.end(), [&](const Amendment& a) { return identity(a) == own; });
            if (!stands) all.push_back(std::move(c));
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
    std::vector<Candidate> out;
    std::vector<Candidate> rest;
    std::map<std::string, std::size_t> of_one;
    for (Candidate& c : all) {
        const bool taken = c.strength > 0 && out.size() < by_rows && of_one[c.binding.effect->name] < bindings_of_one;
        if (taken) ++of_one[c.binding.effect->name];
        (taken ? out : rest).push_back(std::move(c));
    }
    if (bench.yardstick() != Yardstick::free_run) return out;
    const Slope slope(bench, base);
    for (Candidate& c : out) if (!bench.used_up()) slope.weigh(c);
    for (Candidate& c : rest) if ((c.binding.effect->scans.empty() || !c.scans.empty() || c.strength > 0) && !bench.used_up()) slope.weigh(c);   // else the weak form had to find the scan's value
    std::stable_sort(rest.begin(), rest.end(), [](const Candidate& a, const Candidate& b) { return a.share > b.share; });
    std::size_t taken = 0;
    for (Candidate& c : rest) {
        // What has no size has no slope either: only a fit can weigh it.
        if (is_sizeless(*c.binding.effect)) c.share = 1;
        else if (taken == by_run || !(c.share > least_share)) continue;
        else ++taken;
        out.push_back(std::move(c));
    }
    return out;
}

std::vector<Candidate> weighed_by_run(Workbench& bench, const Variant& base, const std::vector<Effect>& effects) {
    Screen screen(bench, base);
    std::vector<Candidate> out;
    std::set<std::string> known;
    for (const Effect& effect : effects) {
        for (Candidate& c : screen.of(effect)) {
            const Amendment a = amendment(c.binding, base.model, c.scan);
            if (known.insert(place(a, base.whole) + change(a)).second) out.push_back(std::move(c));
        }
    }
    std::stable_sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
    if (bench.yardstick() != Yardstick::free_run) return out;
    const Slope slope(bench, base);
    for (Candidate& c : out) if (!bench.used_up()) slope.weigh(c);
    return out;
}

}  // namespace algest::lab
