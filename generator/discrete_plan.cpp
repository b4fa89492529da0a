// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/discrete_plan.hpp"

#include <algorithm>
#include <limits>

#include "generator/discrete.hpp"
#include "generator/polynomial.hpp"
#include "generator/tape_builder.hpp"

namespace algest::generator {

namespace {

using exact::Integer;
using exact::Rational;

/// scale * taps is what one unknown multiplies.
struct Column {
    plan::Combination text;
    Rational scale;
    std::vector<Integer> taps;
};

class DiscretePlanner {
public:
    DiscretePlanner(const model::Model& model, const PlanOptions& options, plan::Plan& plan)
        : model_(model), discrete_(*model.discrete), options_(options), plan_(plan), pooled_(plan.solve == Solve::least_squares) {}

    void run() {
        if (pooled_) plan_.intervals = discrete_.n;
        columns();
        inputs();
        unknowns();
        description();
        rows();
        notes();
        plan_.normalise = !pooled_;
    }

private:
    bool in_q() const { return discrete_.domain == plan::Domain::q; }
    Rational omega0() const { return 2 / *model_.period; }

    void add_column(const std::string& name, bool input, const discrete::Taps& taps, int sign) {
        std::map<std::size_t, Rational> present;
        for (std::size_t s = 0; s < taps.size(); ++s) if (!cln::zerop(taps[s])) present.emplace(s, taps[s]);
        const Rational common = cln::abs(content(present));
        Column out{{name, input, exact::text(common * sign), {}}, common * sign, {}};
        for (const Rational& t : taps) {
            out.taps.push_back(cln::numerator(t / common));
            out.text.taps.push_back(exact::text(t / common));
        }
        columns_.push_back(out);
    }

    /// As (3) and (9) have them: the denominator's terms and the numerator's with a minus on the unknown side, what stands without an unknown
    /// with a minus on the known side.
    void columns() {
        const std::vector<std::string> names = model::unknown_names(discrete_);
        for (int i = 0; i < discrete_.n; ++i) {
            add_column(names[static_cast<std::size_t>(i)], false, in_q() ? discrete::denominator_in_q(i + 1, discrete_.n, omega0()) : discrete::denominator_in_z(i, discrete_.n), 1);
        }
        for (int i = 0; i <= discrete_.numerator; ++i) {
            const discrete::Taps taps = in_q() ? discrete::numerator_in_q(i, discrete_.n, discrete_.m, omega0()) : discrete::numerator_in_z(i, discrete_.n, discrete_.m, discrete_.numerator);
            add_column(names[static_cast<std::size_t>(discrete_.n + i)], true, taps, -1);
        }
        add_column("known", false, in_q() ? discrete::denominator_in_q(0, discrete_.n, omega0()) : discrete::denominator_in_z(discrete_.n, discrete_.n), -1);
    }

    void inputs() {
        TapeBuilder tape(model_, plan_.scalar, {});
        const double infinity = std::numeric_limits<double>::infinity();
        for (const model::Signal& s : model_.signals) {
            if (s.name != discrete_.output && s.name != discrete_.input) continue;
            const int k = static_cast<int>(plan_.inputs.size());
            plan_.inputs.push_back({s.name, s.unit, s.column, s.min ? exact::nearest(*s.min, plan_.scalar) : -infinity, s.max ? exact::nearest(*s.max, plan_.scalar) : infinity, false});
            plan_.window_signals.push_back({s.name, s.hold, s.hold == plan::Hold::zoh, false});
            (s.name == discrete_.input ? input_ : output_) = k;
            tape.result(tape.input(k));
        }
        plan_.signals = tape.finish();
    }

    /// Of A_i: s^i; of B_i: the output's over the input's, times s^i; z counts no time. Empty where a unit of a signal is not declared.
    std::string unit_of(std::size_t unknown) const {
        const bool below = unknown < static_cast<std::size_t>(discrete_.n);
        const int power = !in_q() ? 0 : static_cast<int>(unknown) + (below ? 1 : -discrete_.n);
        const std::string time = power == 0 ? "" : power == 1 ? "s" : "s^" + std::to_string(power);
        if (below) return time.empty() ? "1" : time;
        const std::string& above = model_.signal(discrete_.output)->unit;
        const std::string& under = model_.signal(discrete_.input)->unit;
        if (above.empty() || under.empty()) return "";
        const bool one_word = under.find_first_of("./*^ -") == std::string::npos;
        const std::string gain = above == under ? "1" : under == "1" ? above : above + (one_word ? "/" + under : "/(" + under + ")");
        return time.empty() ? gain : gain == "1" ? time : gain + "." + time;
    }

    void unknowns() {
        TapeBuilder map(model_, plan_.scalar, {});
        for (std::size_t u = 0; u + 1 < columns_.size(); ++u) {
            const std::string& name = columns_[u].text.name;
            plan_.lumped.push_back({name, name, std::numeric_limits<double>::quiet_NaN()});
            plan_.parameters.push_back({name, unit_of(u), name, 0.0, false});
            map.result(map.input(static_cast<int>(u)));
        }
        plan_.parameter_map = map.finish();
    }

    void description() {
        plan::Discrete d{discrete_.domain, discrete_.n, discrete_.m, discrete_.numerator, discrete_.derivatives, discrete_.skip, discrete_.extra, exact::text(discrete_.gamma), exact::text(omega0()), pooled_, {}, {}, {}, {}};
        for (const Column& c : columns_) d.combinations.push_back(c.text);
        if (!pooled_) {
            for (const Integer& c : multiplier()) d.multiplier.push_back(exact::text(c));
            for (const Rational& c : discrete_.filter_numerator) d.filter_numerator.push_back(exact::text(c));
            for (const Rational& c : discrete_.filter_denominator) d.filter_denominator.push_back(exact::text(c));
        }
        plan_.discrete = d;
        const std::string k = "k-" + std::to_string(discrete_.n) + "+i";
        plan_.equations.push_back({"discrete", "sum a_i " + discrete_.output + "(" + k + ") = sum b_i " + discrete_.input + "(" + k + ")", discrete_.n, 0, false, "1", false, {}, 0, {}});
    }

    std::vector<Integer> multiplier() const { return pooled_ ? std::vector<Integer>{1} : discrete::multiplier(discrete_.n, discrete_.n, discrete_.derivatives); }

    /// What a level gives to the equation of so many samples ago.
    std::vector<Integer> by_age(int level, const std::vector<Integer>& filter) const {
        const std::vector<Integer> plain = discrete::level(level, discrete_.gamma, plan_.samples());
        return filter.empty() ? plain : discrete::convolved(plain, filter);
    }

    void rows() {
        const std::vector<Integer> chi = multiplier();
        const bool filtered = !pooled_ && !discrete_.filter_numerator.empty();
        const std::vector<Integer> filter = filtered ? discrete::impulse_response(discrete_.filter_numerator, discrete_.filter_denominator, plan_.samples()) : std::vector<Integer>();
        const int first = pooled_ ? 0 : discrete_.skip;
        const int last = pooled_ ? 0 : discrete_.highest_level();
        for (int level = first; level <= last; ++level) {
            const std::vector<Integer> ages = by_age(level, filter);
            plan::Row row{0, level, {}};
            long unit = 0;   // of the row, a power of two: that of its first table
            for (std::size_t c = 0; c < columns_.size(); ++c) {
                const std::vector<Integer> weights = discrete::weights(chi, ages, columns_[c].taps, plan_.intervals);
                const long scale = add_table(weights, level, static_cast<int>(c));
                if (c == 0) unit = scale;
                row.terms.push_back(term(c, scale - unit));
            }
            plan_.rows.push_back(row);
        }
    }

    /// Appends the weights over the power of two that makes their sum, without signs, 1/2 to 1; its exponent.
    long add_table(const std::vector<Integer>& weights, int level, int column) {
        Integer sum = 0;
        for (const Integer& w : weights) sum = sum + cln::abs(w);
        const long scale = static_cast<long>(cln::integer_length(sum));
        const Integer denominator = cln::ash(Integer(1), scale);
        plan::Table table{"level_" + std::to_string(level) + "_" + columns_[static_cast<std::size_t>(column)].text.name, discrete_.n, 0, 0, column, level, 0, plan::Hold::linear, {}, {}};
        if (options_.weights) {
            for (const Integer& w : weights) table.weights.push_back(exact::nearest(w, denominator, plan_.scalar));
        }
        plan_.tables.push_back(std::move(table));
        return scale;
    }

    plan::RowTerm term(std::size_t column, long exponent) const {
        const Column& c = columns_[column];
        const Rational two = exact::power(Rational(2), static_cast<int>(exponent));
        const bool known = column + 1 == columns_.size();
        return {known ? -1 : static_cast<int>(column), c.text.input ? input_ : output_, 0, static_cast<int>(plan_.tables.size()) - 1, c.text.scale, exact::nearest(c.scale * two, plan_.scalar), {}};
    }

    void notes() {
        if (pooled_) plan_.notes.push_back("solve = \"least_squares\" takes the difference equation of every sample since reset, (12) to (14): derivatives, skip, extra, gamma and the window are not used");
        if (plan_.scalar == plan::Scalar::float32 && !in_q()) plan_.notes.push_back("single precision does not hold the z setting: its rows differ in digits that a float does not have; use double, or domain = \"q\"");
    }

    const model::Model& model_;
    const model::Discrete& discrete_;
    const PlanOptions& options_;
    plan::Plan& plan_;
    bool pooled_;
    std::vector<Column> columns_;
    int input_ = 0;
    int output_ = 0;
};

}  // namespace

void plan_discrete(const model::Model& model, const PlanOptions& options, plan::Plan& plan) { DiscretePlanner(model, options, plan).run(); }

}  // namespace algest::generator
