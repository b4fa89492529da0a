// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/screen.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "lab/spectrum.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr std::size_t lines_that_are_tried = 2;   ///< of each spectrum
constexpr int steps_of_sharpening = 12;           ///< 0.6^12: to 1/300 of a line's width
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
            Candidate best{binding, 0, -1, {}};
            const std::vector<double> scans = effect.scans.empty() ? std::vector<double>{0.0} : effect.scans[0].spectrum ? lines(binding) : scan_values(effect.scans[0]);
            for (const double scan : scans) {
                Candidate c = weigh(binding, scan);
                if (scans.size() > 1) c.strength /= price_of_a_scan;
                if (c.strength > best.strength) best = std::move(c);
            }
            if (best.strength > 0 && !effect.scans.empty() && effect.scans[0].spectrum) best = sharpened(std::move(best));
            if (best.strength > 0) out.push_back(std::move(best));
        }
        return out;
    }

private:
    Candidate weigh(const Binding& binding, double scan) {
        Candidate out{binding, scan, -1, {}};
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
                if (!before || !with || with->coefficients.size() == before->terms) {   // the product stands there already
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
            for (const SpectralLine& line : spectral_lines(r, lines_that_are_tried)) out.push_back(line.step / spacing);
        }
        return out;
    }

    /// The frequency near a line at which the weak form explains most: golden section over half a line's width on both sides.
    Candidate sharpened(Candidate c) {
        const double width = M_PI / (static_cast<double>(bench_.parts().fitted.size()) * base_.bench.drive.period);
        double low = c.scan - 0.5 * width;
        double high = c.scan + 0.5 * width;
        constexpr double golden = 0.6180339887498949;
        Candidate a = weigh(c.binding, high - golden * (high - low));
        Candidate b = weigh(c.binding, low + golden * (high - low));
        for (int step = 0; step < steps_of_sharpening; ++step) {
            if (a.strength > b.strength) {
                high = b.scan;
                b = std::move(a);
                a = weigh(c.binding, high - golden * (high - low));
            } else {
                low = a.scan;
                a = std::move(b);
                b = weigh(c.binding, low + golden * (high - low));
            }
        }
        Candidate& best = a.strength > b.strength ? a : b;
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

std::vector<Candidate> screen(const Workbench& bench, const Variant& base, const std::vector<Effect>& effects, std::size_t most, std::size_t most_of_one) {
    Screen screen(bench, base);
    std::vector<Candidate> all;
    for (const Effect& effect : effects) {
        std::vector<Candidate> own = screen.of(effect);
        std::stable_sort(own.begin(), own.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
        // Where it stands already it does not come again, a wave of another order does.
        own.erase(std::remove_if(own.begin(), own.end(), [&](const Candidate& c) {
            return effect.scans.empty() && std::any_of(base.amendments.begin(), base.amendments.end(), [&](const Amendment& a) { return a.effect == effect.name && a.equations == c.binding.equations; });
        }), own.end());
        if (own.size() > most_of_one) own.resize(most_of_one);
        all.insert(all.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
    }
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
    if (all.size() > most) all.resize(most);
    return all;
}

}  // namespace algest::lab
