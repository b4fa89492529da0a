// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/screen.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "lab/golden_section.hpp"
#include "lab/spectrum.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr std::size_t bindings_of_one = 2;        ///< of one effect among those that the weak form takes
constexpr double least_share = 0.1;               ///< of the free run's error, for what the weak form does not take
constexpr double least_of_its_own = 1e-4;         ///< of an effect's slope that no parameter of the model makes
constexpr double probe = 0.02;                    ///< of what drives an equation
constexpr std::size_t lines_that_are_tried = 2;   ///< of each spectrum
constexpr double price_of_a_scan = 1.5;   ///< a scan finds something in any noise

std::vector<double> scan_values(const EffectScan& scan) {
    std::vector<double> out;
    const int steps = static_cast<int>((scan.to - scan.from) / scan.step + 1e-9);
    for (int k = 0; k <= steps; ++k) out.push_back(scan.from + k * scan.step);
    return out;
}

/// Equations are found again by name: amendments leave their order alone, dropped kinematics do not.
std::size_t index_of(const model::Model& model, const std::string& equation) {
    for (std::size_t e = 0; e < model.equations.size(); ++e) if (model.equations[e].name == equation) return e;
    return 0;
}

/// The weak residuals of the model as it is, by equation and window length: every candidate is compared with them.
class Screen {
public:
    Screen(const Workbench& bench, const Variant& base) : bench_(bench), base_(base), recorded_(base.bench), measured_() {
        for (const auto& m : base.bench.measured) measured_.push_back(!m.empty());
        recorded_.measured.push_back(bench.recording().t);   // an amendment that brings a signal brings time, as the last
    }

    std::vector<Candidate> of(const Effect& effect) {
        std::vector<Candidate> out;
        for (const Binding& binding : bindings(effect, base_.whole, measured_)) {
            Candidate best{binding, 0, 0, 0, {}};
            const std::vector<double> scans = effect.scans.empty() ? std::vector<double>{0.0} : effect.scans[0].spectrum ? lines(binding) : scan_values(effect.scans[0]);
            for (const double scan : scans) {
                Candidate c = weigh(binding, scan);
                if (scans.size() > 1) c.strength /= price_of_a_scan;
                if (c.strength > best.strength || c.strength < 0) best = std::move(c);
            }
            if (best.strength < 0) continue;
            if (best.strength > 0 && !effect.scans.empty() && effect.scans[0].spectrum) best = sharpened(std::move(best));
            out.push_back(std::move(best));
        }
        return out;
    }

private:
    Candidate weigh(const Binding& binding, double scan) {
        Candidate out{binding, scan, 0, 0, {}};
        const Amendment a = amendment(binding, base_.model, scan);
        const auto model = bench_.runnable(amended(base_.text, base_.whole, a));
        if (!model) return out;
        std::vector<double> start;
        for (const model::Parameter& p : model->parameters) {
            const int old = base_.model.parameter_index(p.name);
            start.push_back(old >= 0 ? base_.fit.parameters[static_cast<std::size_t>(old)] : 0.0);
        }
        // An effect that enters several equations at once is measured by the one that it explains least.
        for (const int intervals : weak_intervals(bench_.parts().fitted)) {
            double least = std::numeric_limits<double>::infinity();
            std::vector<double> parameters = start;
            for (const std::size_t e : binding.equations) {
                const std::string& where = base_.whole.equations[e].name;
                const auto& before = without(where, intervals);
                const auto with = weak_form(*model, recorded_, index_of(*model, where), bench_.parts().fitted, intervals);
                if (with && before && with->coefficients.size() == before->terms && known_alone(*with, *model)) {
                    out.strength = -1;   // the same product with a value that is declared known: that value is in doubt, not an effect missing
                    return out;
                }
                if (!before || !with || with->coefficients.size() == before->terms) {   // the product stands there: only a free run may tell
                    least = -1;
                    break;
                }
                const WeakFit after = weak_fit(*with, start);
                const double freedom = std::max(after.windows - after.unknowns, 1);
                const double strength = (before->fit.residual - after.residual) / (after.residual / freedom) / std::max(after.unknowns - before->fit.unknowns, 1);
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
        const std::size_t e = index_of(base_.model, base_.whole.equations[binding.equations[0]].name);
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

    /// False within four line widths of a wave that the base has already: what is left there is that wave's own inaccuracy.
    bool is_new(const Binding& binding, double frequency) const {
        const double width = line_width(bench_.parts().fitted.size(), base_.bench.drive.period);
        for (const Amendment& a : base_.amendments) {
            if (a.effect != binding.effect->name || a.equations != binding.equations) continue;
            for (const NewName& n : a.names) if (n.constant && std::abs(n.value - frequency) < 4 * width) return false;
        }
        return true;
    }

    /// The frequency near a line at which the weak form explains most: golden section over half a line's width on both sides.
    Candidate sharpened(Candidate c) {
        const double width = line_width(bench_.parts().fitted.size(), base_.bench.drive.period);
        const double there = least_by_golden_section([&](double frequency) { return -weigh(c.binding, frequency).strength; }, c.scan - 0.5 * width, c.scan + 0.5 * width);
        Candidate best = weigh(c.binding, there);
        best.strength /= price_of_a_scan;
        return best.strength > c.strength ? best : c;
    }

    struct Before {
        WeakFit fit;
        std::size_t terms;
    };

    const std::optional<Before>& without(const std::string& equation, int intervals) {
        const auto key = std::pair(equation, intervals);
        const auto known = before_.find(key);
        if (known != before_.end()) return known->second;
        std::optional<Before> out;
        const auto form = weak_form(base_.model, base_.bench, index_of(base_.model, equation), bench_.parts().fitted, intervals);
        if (form) out = Before{weak_fit(*form, base_.fit.parameters), form->coefficients.size()};
        return before_.emplace(key, std::move(out)).first->second;
    }

    const Workbench& bench_;
    const Variant& base_;
    Bench recorded_;   ///< of the base, with time
    std::vector<bool> measured_;
    std::map<std::pair<std::string, int>, std::optional<Before>> before_;
};

}  // namespace

namespace {

/// The free run's error at the base's fit, without what its parameters could still take, and how far an effect would take it.
class Slope {
public:
    Slope(Workbench& bench, const Variant& base) : bench_(bench), base_(base), at_{base.fit.parameters, {}, base.fit.initial, bench.parts().fitted} {
        residual_ = output_residual(base.model, base.bench, at_);
        const Eigen::HouseholderQR<Eigen::MatrixXd> qr(output_slopes(base.model, base.bench, at_));
        basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), std::min(qr.rows(), qr.cols()));
        left_ = outside(Eigen::Map<const Eigen::VectorXd>(residual_.data(), static_cast<Eigen::Index>(residual_.size())));
    }

    /// Sets the candidate's share and, where the weak form has none, its start.
    void weigh(Candidate& c) const {
        const Amendment a = amendment(c.binding, base_.model, c.scan);
        Diagnostics quiet;
        auto amendments = base_.amendments;
        amendments.push_back(a);
        const auto v = bench_.prepare(amended(base_.text, base_.whole, a), std::move(amendments), quiet);
        if (!v || !(left_.squaredNorm() > 0)) return;
        if (v->bench.options.stride != base_.bench.options.stride) return;   // it brings time to a run that nothing drove: other samples are kept
        FitStart at = at_;
        at.parameters.clear();
        for (const model::Parameter& p : v->model.parameters) {
            const int old = base_.model.parameter_index(p.name);
            at.parameters.push_back(old >= 0 ? base_.fit.parameters[static_cast<std::size_t>(old)] : 0.0);
        }
        std::vector<std::size_t> added;
        for (const NewName& n : a.names) if (!n.constant) added.push_back(static_cast<std::size_t>(v->model.parameter_index(n.name)));
        const std::vector<double> sizes = probes(*v, at.parameters, added, c.binding.equations);
        Eigen::MatrixXd slopes(left_.size(), static_cast<Eigen::Index>(added.size()));
        for (std::size_t k = 0; k < added.size(); ++k) {
            at.parameters[added[k]] = sizes[k];
            const std::vector<double> there = output_residual(v->model, v->bench, at);
            at.parameters[added[k]] = 0;
            for (std::size_t i = 0; i < there.size(); ++i) slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = there[i] - residual_[i];
        }
        const double whole = slopes.squaredNorm();
        slopes = outside(slopes);
        if (!(slopes.squaredNorm() > least_of_its_own * whole)) return;   // what the parameters do already
        const Eigen::VectorXd move = slopes.colPivHouseholderQr().solve(-left_);
        for (std::size_t k = 0; k < added.size(); ++k) {
            if (a.names[k].min && move[static_cast<Eigen::Index>(k)] * sizes[k] < *a.names[k].min) return;
        }
        c.share = 1 - (left_ + slopes * move).squaredNorm() / left_.squaredNorm();
        if (c.strength > 0) return;
        c.start = at.parameters;
        for (std::size_t k = 0; k < added.size(); ++k) c.start[added[k]] = move[static_cast<Eigen::Index>(k)] * sizes[k];
    }

private:
    Eigen::MatrixXd outside(const Eigen::MatrixXd& x) const { return x - basis_ * (basis_.transpose() * x); }

    /// Values of the added parameters at which their terms are a small part of what drives the equation.
    std::vector<double> probes(const Variant& v, const std::vector<double>& parameters, const std::vector<std::size_t>& added, const std::vector<std::size_t>& equations) const {
        std::vector<double> out(added.size(), 1e-3);
        const std::size_t e = index_of(v.model, base_.whole.equations[equations[0]].name);
        const auto form = weak_form(v.model, v.bench, e, bench_.parts().fitted, weak_intervals(bench_.parts().fitted).front());
        if (!form) return out;
        const double driving = driving_size(*form, parameters);
        for (std::size_t k = 0; k < added.size(); ++k) {
            std::vector<double> one = parameters;
            one[added[k]] = 1.0;
            const double term = (weak_residual(*form, one) - weak_residual(*form, parameters)).norm() / std::sqrt(static_cast<double>(form->columns.rows()));
            if (term > 0 && driving > 0) out[k] = probe * driving / term;
        }
        return out;
    }

    Workbench& bench_;
    const Variant& base_;
    FitStart at_;
    std::vector<double> residual_;
    Eigen::MatrixXd basis_;
    Eigen::VectorXd left_;
};

}  // namespace

std::vector<Candidate> screen(Workbench& bench, const Variant& base, const std::vector<Effect>& effects, std::size_t by_rows, std::size_t by_run) {
    Screen screen(bench, base);
    std::vector<Candidate> all;
    for (const Effect& effect : effects) {
        for (Candidate& c : screen.of(effect)) {
            // Where it stands already it does not come again, a wave of another order does.
            const bool stands = effect.scans.empty() && std::any_of(base.amendments.begin(), base.amendments.end(), [&](const Amendment& a) { return a.effect == effect.name && a.equations == c.binding.equations; });
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
    for (Candidate& c : rest) if (c.binding.effect->scans.empty() && !bench.used_up()) slope.weigh(c);   // a scan's value is the weak form's to find
    std::stable_sort(rest.begin(), rest.end(), [](const Candidate& a, const Candidate& b) { return a.share > b.share; });
    for (std::size_t k = 0; k < rest.size() && k < by_run && rest[k].share > least_share; ++k) out.push_back(std::move(rest[k]));
    return out;
}

}  // namespace algest::lab
