// SPDX-License-Identifier: GPL-3.0-or-later
// Random models whose coefficients are sums, products and quotients of parameters: what the rows see of random physical values,
// put into the inverse map, gives the same values back; a model that no data can tell apart is never accepted. The values that
// the rows should see, and how many of the parameters these determine, are computed here, beside the generator.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "generator/generate.hpp"
#include "generator/lumping.hpp"
#include "tests/lab/temporary_file.hpp"

namespace {

using namespace algest;
using exact::Rational;

constexpr int models = 5000;

/// A number and its derivatives by the parameters, exactly.
struct Value {
    Rational number = 0;
    std::vector<Rational> by;
};

/// A coefficient as a model file has it, and its value at the drawn parameters.
struct Coefficient {
    std::string text;
    Value value;
};

class Draw {
public:
    explicit Draw(unsigned seed) : random_(seed) {
        const int count = whole(1, 5);
        for (int k = 0; k < count; ++k) parameters.push_back(Rational(whole(50, 5000)) / whole(90, 400));
    }

    int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

    Coefficient constant() {
        const int n = whole(1, 9);
        return {std::to_string(n), {n, std::vector<Rational>(parameters.size(), 0)}};
    }

    Coefficient parameter() {
        const std::size_t k = static_cast<std::size_t>(whole(0, static_cast<int>(parameters.size()) - 1));
        Coefficient out{"p" + std::to_string(k + 1), {parameters[k], std::vector<Rational>(parameters.size(), 0)}};
        out.value.by[k] = 1;
        return out;
    }

    Coefficient coefficient(int depth) {
        const int what = whole(0, depth > 0 ? 11 : 3);
        if (what < 1) return constant();
        if (what < 4) return parameter();
        const Coefficient a = coefficient(depth - 1);
        const Coefficient b = coefficient(depth - 1);
        Coefficient out;
        out.value.by.resize(parameters.size(), 0);
        const Rational x = a.value.number;
        const Rational y = b.value.number;
        const auto each = [&](const auto& rule) {
            for (std::size_t k = 0; k < parameters.size(); ++k) out.value.by[k] = rule(a.value.by[k], b.value.by[k]);
        };
        if (what < 7) {
            out.text = "(" + a.text + ")*(" + b.text + ")";
            out.value.number = x * y;
            each([&](const Rational& da, const Rational& db) { return da * y + x * db; });
        } else if (what < 9 && !cln::zerop(y)) {
            out.text = "(" + a.text + ")/(" + b.text + ")";
            out.value.number = x / y;
            each([&](const Rational& da, const Rational& db) { return (da * y - x * db) / (y * y); });
        } else if (what < 11) {
            out.text = "(" + a.text + " + " + b.text + ")";
            out.value.number = x + y;
            each([&](const Rational& da, const Rational& db) { return da + db; });
        } else {
            out.text = "(" + a.text + " - " + b.text + ")";
            out.value.number = x - y;
            each([&](const Rational& da, const Rational& db) { return da - db; });
        }
        return out;
    }

    std::vector<Rational> parameters;

private:
    std::mt19937 random_;
};

/// leading * der(x) = sum of inputs * u
struct Equation {
    Coefficient leading;
    std::vector<Coefficient> inputs;   // u1, u2, ...
};

struct Model {
    std::vector<Rational> parameters;
    std::vector<Equation> equations;

    std::string text() const {
        std::string out = "name = \"m\"\n[sampling]\nperiod = 0.001\nwindow = 0.02\n[signals]\n";
        for (std::size_t e = 0; e < equations.size(); ++e) out += "x" + std::to_string(e + 1) + " = {}\n";
        for (int k = 1; k <= 6; ++k) out += "u" + std::to_string(k) + " = {}\n";
        out += "[parameters]\n";
        for (std::size_t k = 0; k < parameters.size(); ++k) out += "p" + std::to_string(k + 1) + " = {}\n";
        for (std::size_t e = 0; e < equations.size(); ++e) {
            out += "[[equation]]\node = \"" + equations[e].leading.text + "*der(x" + std::to_string(e + 1) + ") = 0";
            for (std::size_t k = 0; k < equations[e].inputs.size(); ++k) out += " + " + equations[e].inputs[k].text + "*u" + std::to_string(k + 1);
            out += "\"\n";
        }
        return out;
    }
};

Model drawn(unsigned seed) {
    Draw draw(seed);
    Model out;
    out.parameters = draw.parameters;
    const int equations = draw.whole(1, 3);
    for (int e = 0; e < equations; ++e) {
        Equation equation;
        do equation.leading = draw.coefficient(draw.whole(0, 1)); while (cln::zerop(equation.leading.value.number));
        const int inputs = draw.whole(1, 4);
        for (int k = 0; k < inputs; ++k) equation.inputs.push_back(draw.coefficient(draw.whole(0, 2)));
        out.equations.push_back(equation);
    }
    return out;
}

/// How many of the parameters the ratios input/leading determine near the drawn values: the rank of their derivatives.
std::size_t determined(const Model& model) {
    std::vector<std::vector<Rational>> rows;
    for (const Equation& e : model.equations) {
        const Value& below = e.leading.value;
        for (const Coefficient& c : e.inputs) {
            std::vector<Rational> row;
            for (std::size_t k = 0; k < model.parameters.size(); ++k) {
                row.push_back(c.value.by[k] * below.number - c.value.number * below.by[k]);
            }
            rows.push_back(row);
        }
    }
    std::size_t rank = 0;
    for (std::size_t column = 0; column < model.parameters.size(); ++column) {
        std::size_t pivot = rank;
        while (pivot < rows.size() && cln::zerop(rows[pivot][column])) ++pivot;
        if (pivot == rows.size()) continue;
        std::swap(rows[rank], rows[pivot]);
        for (std::size_t r = rank + 1; r < rows.size(); ++r) {
            const Rational factor = rows[r][column] / rows[rank][column];
            for (std::size_t j = 0; j < rows[r].size(); ++j) rows[r][j] = rows[r][j] - factor * rows[rank][j];
        }
        ++rank;
    }
    return rank;
}

Rational value_of(const Polynomial& p, const std::vector<Rational>& at) {
    Rational out = 0;
    for (const auto& [exponents, coefficient] : p) {
        Rational term = coefficient;
        for (std::size_t k = 0; k < exponents.size(); ++k) term = term * exact::power(at[k], exponents[k]);
        out = out + term;
    }
    return out;
}

Rational value_of(const Quotient& q, const std::vector<Rational>& at) { return value_of(q.numerator, at) / value_of(q.denominator, at); }

/// What the rows see of the drawn values is input/leading, exactly, and the inverse map gives the values back.
void check_exactly(const Model& drawn, const std::vector<equation::OperatorForm>& forms, const lumping::Lumping& lumping) {
    std::vector<Rational> unknowns;
    for (const lumping::Unknown& u : lumping.unknowns) unknowns.push_back(value_of(u.meaning, drawn.parameters));
    for (std::size_t e = 0; e < forms.size(); ++e) {
        if (!lumping.equations[e].used) continue;
        std::map<std::string, Rational> seen;
        for (const lumping::LumpedTerm& term : lumping.equations[e].terms) {
            Rational value = term.known;
            for (const auto& [unknown, factor] : term.unknown) value = value + factor * unknowns[static_cast<std::size_t>(unknown)];
            seen[forms[e].text(forms[e].terms[static_cast<std::size_t>(term.term)].product)] = value;
        }
        const Rational leading = seen.at("der(x" + std::to_string(e + 1) + ")");
        REQUIRE(!cln::zerop(leading));
        for (std::size_t k = 0; k < drawn.equations[e].inputs.size(); ++k) {
            const auto found = seen.find("u" + std::to_string(k + 1));
            const Rational ratio = found == seen.end() ? Rational(0) : -found->second / leading;
            REQUIRE(ratio == drawn.equations[e].inputs[k].value.number / drawn.equations[e].leading.value.number);
        }
    }
    for (std::size_t k = 0; k < drawn.parameters.size(); ++k) {
        REQUIRE(lumping.inverse[k].has_value());
        REQUIRE(value_of(*lumping.inverse[k], unknowns) == drawn.parameters[k]);
    }
}

/// The same through the plan's tape, in double.
void check_plan(const Model& drawn, const lumping::Lumping& lumping, const plan::Plan& plan) {
    std::vector<double> unknowns;
    for (const lumping::Unknown& u : lumping.unknowns) unknowns.push_back(exact::nearest(value_of(u.meaning, drawn.parameters), plan::Scalar::float64));
    std::vector<double> scratch(plan.parameter_map.operations.size());
    std::vector<double> parameters(plan.parameters.size());
    plan::evaluate<double>(plan.parameter_map, unknowns.data(), nullptr, nullptr, scratch.data(), parameters.data());
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        const double wanted = exact::nearest(drawn.parameters[k], plan::Scalar::float64);
        CHECK(std::abs(parameters[k] - wanted) <= 1e-9 * wanted);
    }
}

}  // namespace

TEST_CASE("parameter maps of random models give the physical values back, or the model is refused for what is true") {
    const test::TemporaryFolder folder;
    int accepted = 0;
    int unidentifiable = 0;
    int refused_as_not_solvable = 0;
    for (int seed = 0; seed < models; ++seed) {
        const Model model = drawn(static_cast<unsigned>(seed));
        const std::string text = model.text();
        INFO("seed " << seed << "\n" << text);
        const bool identifiable = determined(model) == model.parameters.size();

        Diagnostics diagnostics;
        const auto read = model::read_from_text(text, "m.toml", false, diagnostics);
        REQUIRE(read);
        std::vector<equation::OperatorForm> forms;
        for (const model::Equation& e : read->equations) {
            const auto form = equation::operator_form(*read, e, diagnostics);
            REQUIRE(form);
            forms.push_back(*form);
        }
        const auto lumping = lumping::lump(*read, forms, diagnostics);
        REQUIRE(lumping.has_value() == !diagnostics.failed());
        if (!lumping) {
            if (diagnostics.is_unidentifiable()) CHECK(!identifiable);
            (diagnostics.has_errors() ? refused_as_not_solvable : unidentifiable) += 1;
            continue;
        }
        CHECK(identifiable);
        ++accepted;
        check_exactly(model, forms, *lumping);

        Diagnostics of_plan;
        const auto plan = generator::plan_from_model(folder.write("m.toml", text), {}, of_plan);
        REQUIRE(plan);
        check_plan(model, *lumping, *plan);
    }
    CHECK(accepted > models / 10);   // not all of one kind
    CHECK(unidentifiable > models / 10);
    CHECK(refused_as_not_solvable > models / 100);
}
