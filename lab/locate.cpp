// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/locate.hpp"

#include <algorithm>
#include <cmath>

#include "generator/dimension.hpp"
#include "lab/noise.hpp"
#include "lab/weak_form.hpp"

namespace algest::lab {

namespace {

constexpr double least_explained = 0.1;       ///< of a residual by one signal, to be called its region

/// As an engineer writes it, where UDUNITS would print base units.
std::string spelled(const units::Unit& unit) {
    for (const char* usual : {"V", "N.m", "N", "A", "W", "Pa", "m^3/s", "cm^3/s", "K/s", "rad/s", "m/s"}) {
        if (unit.known() && unit.same_dimension(*units::Unit::parse(usual)) && std::abs(unit.factor_to(*units::Unit::parse(usual)) - 1) < 1e-12) return usual;
    }
    return unit.text();
}

/// How a residual may hang on one signal.
enum class Shape { linear, sign, square };

double shaped(double x, Shape shape) {
    switch (shape) {
        case Shape::linear: return x;
        case Shape::sign: return x > 0 ? 1.0 : -1.0;
        case Shape::square: return x * std::abs(x);
    }
    return x;
}

/// What explains a residual best on its own.
struct Region {
    int signal = -1;
    Shape shape = Shape::linear;
    double share = least_explained;   ///< of the residual's variance
};

Region region_of(const Variant& v, const std::vector<std::size_t>& rows, const Eigen::VectorXd& r) {
    Region best;
    const double power = (r.array() - r.mean()).matrix().squaredNorm();
    for (std::size_t s = 0; s < v.bench.measured.size() && power > 0; ++s) {
        const std::vector<double>& m = v.bench.measured[s];
        if (m.empty()) continue;
        for (const Shape shape : {Shape::linear, Shape::sign, Shape::square}) {
            Eigen::MatrixXd X(r.size(), 2);
            X.col(0).setOnes();
            for (Eigen::Index w = 0; w < r.size(); ++w) X(w, 1) = shaped(m[rows[static_cast<std::size_t>(w)]], shape);
            const double missed = (r - X * X.colPivHouseholderQr().solve(r)).squaredNorm();
            if (1 - missed / power > best.share) best = {static_cast<int>(s), shape, 1 - missed / power};
        }
    }
    return best;
}

std::string in_words(const Region& region, const model::Model& model) {
    if (region.signal < 0) return "no single signal explains it";
    const std::string& name = model.signals[static_cast<std::size_t>(region.signal)].name;
    switch (region.shape) {
        case Shape::linear: return "grows with " + name;
        case Shape::sign: return "follows the sign of " + name;
        case Shape::square: return "grows with the square of " + name;
    }
    return "";
}

std::vector<double> as_vector(const Eigen::VectorXd& r) { return {r.data(), r.data() + r.size()}; }

/// What a window makes of a constant 1: residuals over it are means in the equation's own unit, late and early samples counting less.
/// Negative where the equation is of odd order.
double window_weight(const Variant& v, std::size_t e, int intervals) {
    double sum = 0;
    for (const double w : row_weights(v.model, e, intervals)) sum += w;
    return sum;
}

/// Parameters of one equation that fit it best on the training rows.
std::vector<double> own_parameters(const Workbench& bench, const Variant& v, std::size_t e, int intervals) {
    const auto form = weak_form(v.model, v.bench, e, bench.parts().train, intervals);
    return form ? weak_fit(*form, v.fit.parameters).parameters : v.fit.parameters;
}

/// Standard deviation that the sensors' noise gives to a residual of the weak form.
double noise_of_rows(const Workbench& bench, const Variant& v, std::size_t e, int intervals, const std::vector<double>& parameters) {
    return weak_noise(v.model, v.bench, e, bench.parts().train, intervals, parameters, noise_by_signal(v.model, v.bench));
}

/// The length of window whose residual stands highest above its noise: short ones drown in noise, long ones average over what is missing.
int telling_intervals(const Workbench& bench, const Variant& v, std::size_t e) {
    double highest = -1;
    int out = 0;
    for (const int intervals : weak_intervals(bench.parts().train)) {
        const auto form = weak_form(v.model, v.bench, e, bench.parts().train, intervals);
        if (!form) continue;
        const std::vector<double> own = weak_fit(*form, v.fit.parameters).parameters;
        const double residual = std::sqrt(weak_residual(*form, own).squaredNorm() / static_cast<double>(form->centre.size()));
        const double above = residual / std::max(noise_of_rows(bench, v, e, intervals, own), 1e-300);
        if (above <= highest) continue;
        highest = above;
        out = intervals;
    }
    return out;
}

/// Values of a residual, each at a row of the recording.
struct Series {
    std::vector<std::size_t> rows;
    std::vector<double> values;
    void add(std::size_t row, double value) {
        rows.push_back(row);
        values.push_back(value);
    }
};

/// By how much of the noise's power the residual's is above it; 0 where chance alone does that. Of n windows, every other one on its own,
/// the mean square varies by sqrt(2 / (n/2)).
double above_noise(double power, double noise, std::size_t values) {
    if (noise <= 0) return 0;
    constexpr double most_by_chance = 3;   // standard deviations
    const double excess = power / (noise * noise) - 1;
    return excess > most_by_chance * 2 / std::sqrt(static_cast<double>(values)) ? excess : 0;
}

/// share: as above_noise, not yet of the whole gap.
Where where_of(const std::string& equation, const Series& r, double noise, const Workbench& bench, const Variant& nominal) {
    double squares = 0;
    for (const double x : r.values) squares += x * x;
    const double power = squares / static_cast<double>(std::max<std::size_t>(r.values.size(), 1));
    Where out{equation, above_noise(power, noise, r.values.size()), 0, 0, ""};
    // The stretch between whose ends nine tenths of the power lie.
    double sum = 0;
    for (std::size_t k = 0; k < r.values.size(); ++k) {
        const double t = bench.recording().t[r.rows[k]];
        if (k == 0 || sum < 0.05 * squares) out.from_s = t;
        if (k == 0 || sum < 0.95 * squares) out.to_s = t;
        sum += r.values[k] * r.values[k];
    }
    out.region = in_words(region_of(nominal, r.rows, Eigen::Map<const Eigen::VectorXd>(r.values.data(), static_cast<Eigen::Index>(r.values.size()))), nominal.model);
    return out;
}

}  // namespace

std::vector<EquationResidual> residuals(const Workbench& bench, const Variant& nominal, const Variant* amended) {
    const Rows all = {0, bench.recording().samples()};
    std::vector<EquationResidual> out;
    for (std::size_t e = 0; e < nominal.model.equations.size(); ++e) {
        const int intervals = telling_intervals(bench, nominal, e);
        if (intervals == 0) continue;   // a signal of it is not measured
        const std::vector<double> parameters = own_parameters(bench, nominal, e, intervals);
        const auto form = weak_form(nominal.model, nominal.bench, e, all, intervals);
        const double weight = window_weight(nominal, e, intervals);
        EquationResidual r{nominal.model.equations[e].name, spelled(model::unit_of_equation(nominal.model, nominal.model.equations[e])), {}, {}, {}, 0, {}, {}, {}, {}};
        for (const std::size_t row : form->centre) r.t.push_back(bench.recording().t[row]);
        const Eigen::VectorXd before = weak_residual(*form, parameters);
        r.before = as_vector(before / weight);
        r.noise = noise_of_rows(bench, nominal, e, intervals, parameters) / std::abs(weight);
        int against = region_of(nominal, form->centre, before).signal;
        for (const Amendment& a : amended != nullptr ? amended->amendments : std::vector<Amendment>()) {
            const bool enters = std::any_of(a.equations.begin(), a.equations.end(), [&](std::size_t k) { return nominal.whole.equations[k].name == r.equation; });
            const int s = nominal.model.signal_index(a.against);
            if (enters && s >= 0 && !nominal.bench.measured[static_cast<std::size_t>(s)].empty()) against = s;
        }
        if (against >= 0) {
            const std::size_t s = static_cast<std::size_t>(against);
            r.signal = nominal.model.signals[s].name;
            r.signal_unit = nominal.model.signals[s].unit;
            for (const std::size_t row : form->centre) r.x.push_back(nominal.bench.measured[s][row]);
        }
        const auto with = amended != nullptr ? weak_form(amended->model, amended->bench, e, all, intervals) : std::nullopt;
        if (with) {
            const std::vector<double> own = own_parameters(bench, *amended, e, intervals);
            r.after = as_vector(weak_residual(*with, own) / weight);
            // What the added terms say: the residual without them, less the residual with them.
            std::vector<double> without = own;
            bool enters = false;
            for (const Amendment& a : amended->amendments) {
                for (const std::size_t k : a.equations) enters = enters || nominal.whole.equations[k].name == r.equation;
                for (const NewName& n : a.names) if (!n.constant) without[static_cast<std::size_t>(amended->model.parameter_index(n.name))] = 0;
            }
            if (enters && !r.x.empty()) r.law = as_vector((weak_residual(*with, without) - weak_residual(*with, own)) / weight);
        }
        out.push_back(std::move(r));
    }
    return out;
}

std::vector<Where> locate(const Workbench& bench, const Variant& nominal, const std::vector<EquationResidual>& residuals, const FreeRun& before) {
    std::vector<Where> out;
    for (const EquationResidual& r : residuals) {
        Series of_rows;
        for (std::size_t w = 0; w < r.t.size(); ++w) {
            const std::size_t row = static_cast<std::size_t>(std::lround((r.t[w] - bench.recording().t[0]) / bench.recording().period));
            if (row >= bench.parts().train.begin && row < bench.parts().train.end) of_rows.add(row, r.before[w]);
        }
        out.push_back(where_of(r.equation, of_rows, r.noise, bench, nominal));
    }
    const bool rows_see_it = nominal.score.gap() <= at_the_floor || std::any_of(out.begin(), out.end(), [](const Where& w) { return w.share > 0; });
    const std::vector<double> noise = noise_by_signal(nominal.model, nominal.bench);
    for (std::size_t e = 0; e < nominal.model.equations.size(); ++e) {
        const std::string& name = nominal.model.equations[e].name;
        const auto known = std::find_if(out.begin(), out.end(), [&](const Where& w) { return w.equation == name; });
        const std::size_t s = static_cast<std::size_t>(nominal.bench.system.gives[e]);
        if ((known != out.end() && rows_see_it) || nominal.bench.measured[s].empty()) continue;
        Series of_run;
        for (std::size_t row = bench.parts().train.begin; row < std::min(bench.parts().train.end, before.samples); ++row) of_run.add(row, nominal.bench.measured[s][row] - before.signals[s][row]);
        if (of_run.rows.empty()) continue;
        const Where where = where_of(name, of_run, noise[s], bench, nominal);
        if (known != out.end()) *known = where;
        else out.push_back(where);
    }
    double total = 0;
    for (const Where& w : out) total += w.share;
    const bool off = total > 0 && nominal.score.gap() > at_the_floor;   // a long run that stays within the noise knows better than rows with a switch in them
    for (Where& w : out) w.share = off ? w.share / total : 0;
    return out;
}

}  // namespace algest::lab
