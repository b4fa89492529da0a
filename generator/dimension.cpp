// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/dimension.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "generator/constant_value.hpp"
#include "generator/model.hpp"
#include "generator/source_text.hpp"

namespace algest::model {

namespace {

using formula::Formula;
using formula::Kind;
using units::Unit;

struct Walk {
    const Model& model;
    std::function<void(const Formula& f, const std::string& what, const std::string& right)> complain;

    static Unit declared(const std::string& unit) {
        if (unit.empty()) return {};
        return Unit::parse(unit).value_or(Unit());
    }

    /// The unit of a sum of two; complains where they do not fit.
    Unit alike(const Unit& a, const Unit& b, const Formula& left, const Formula& right, const Formula& at) const {
        if (!a.known()) return b;
        if (!b.known()) return a;
        const auto sides = [&] {
            return quoted(formula::text(left)) + " [" + a.text() + "] and " + quoted(formula::text(right)) + " [" + b.text() + "]";
        };
        if (!a.same_dimension(b)) {
            complain(at, sides() + " differ in dimension", "check the units, or declare a constant with the missing one");
            return {};
        }
        const double factor = b.factor_to(a);
        if (std::abs(factor - 1.0) > 1e-9) {
            complain(at, sides() + " differ in scale", "declare every quantity of the equation in units without prefixes, such as H for mH; a recording is converted");
        } else if (!b.same_origin(a)) {
            complain(at, sides() + " differ in their zero", "declare both in degC or both in K; a recording is converted");
        }
        return a;
    }

    void expect_number(const Unit& unit, const Formula& f, const std::string& function) const {
        if (!unit.known()) return;
        const Unit one = Unit::dimensionless();
        if (!unit.same_dimension(one) || std::abs(unit.factor_to(one) - 1.0) > 1e-9) {
            complain(f, "the argument of " + function + " has the unit [" + unit.text() + "]", "divide it by a constant of that unit");
        }
    }

    static bool names_nothing(const Formula& f) {
        return f->kind != Kind::name && std::all_of(f->arguments.begin(), f->arguments.end(), [](const Formula& a) { return names_nothing(a); });
    }

    /// A bare number counts as seconds.
    void expect_seconds(const Formula& f) const {
        const Unit unit = of(f);
        const Unit second = *Unit::parse("s");
        if (!unit.known() || names_nothing(f) || (unit.same_dimension(second) && std::abs(unit.factor_to(second) - 1.0) <= 1e-9)) return;
        complain(f, "the time of a delay has the unit [" + unit.text() + "]", "declare it in s");
    }

    Unit power(const Formula& f) const {
        const Unit base = of(f->arguments[0]);
        const Formula& e = f->arguments[1];
        const auto exponent = constant_value(model, e);
        if (!exponent) {
            expect_number(of(e), e, "an exponent");
            expect_number(base, f->arguments[0], "a power with a variable exponent");
            return {};
        }
        if (cln::abs(*exponent) > formula::largest_exponent || cln::denominator(*exponent) > formula::largest_exponent) return {};
        return base.root(cln::cl_I_to_int(cln::denominator(*exponent))).power(cln::cl_I_to_int(cln::numerator(*exponent)));
    }

    Unit call(const Formula& f) const {
        const Formula& x = f->arguments[0];
        if (f->name == "der") {
            const int order = formula::derivative_order(f);
            return of(x).over(Unit::parse("s")->power(order));
        }
        const Unit unit = of(x);
        if (f->name == "delay") {
            expect_seconds(f->arguments[1]);
            return unit;
        }
        if (f->name == "sqrt") return unit.root(2);
        if (f->name == "abs") return unit;
        if (f->name == "sgn") return Unit::dimensionless();
        if (formula::is_function_of_two(f->name)) return alike(unit, of(f->arguments[1]), x, f->arguments[1], f);
        expect_number(unit, x, f->name);
        return Unit::dimensionless();
    }

    Unit of(const Formula& f) const {
        switch (f->kind) {
            case Kind::number: return cln::zerop(f->value) ? Unit() : Unit::dimensionless();
            case Kind::name:
                if (const Signal* s = model.signal(f->name)) return declared(s->unit);
                if (const Constant* c = model.constant(f->name)) return declared(c->unit);
                if (const Parameter* p = model.parameter(f->name)) return declared(p->unit);
                return {};
            case Kind::negate: return of(f->arguments[0]);
            case Kind::add:
            case Kind::subtract: {
                const Unit left = of(f->arguments[0]);
                const Unit out = alike(left, of(f->arguments[1]), f->arguments[0], f->arguments[1], f->arguments[1]);
                // A difference of two temperatures in degC is one in K: a product has no origin.
                return f->kind == Kind::subtract ? out.times(Unit::dimensionless()) : out;
            }
            case Kind::multiply: {
                const Unit left = of(f->arguments[0]);
                return left.times(of(f->arguments[1]));
            }
            case Kind::divide: {
                const Unit left = of(f->arguments[0]);
                return left.over(of(f->arguments[1]));
            }
            case Kind::power: return power(f);
            case Kind::call: return call(f);
        }
        return {};
    }
};

}  // namespace

void check_dimension(const Model& model, const Equation& equation, Diagnostics& diagnostics) {
    const Walk walk{model, [&](const Formula& f, const std::string& what, const std::string& right) {
                        diagnostics.error(equation.file, equation.place(f->start), what, right);
                    }};
    const Unit left = walk.of(equation.sides.left);
    const Unit right = walk.of(equation.sides.right);
    (void)walk.alike(left, right, equation.sides.left, equation.sides.right, equation.sides.right);
}

void check_dimension(const Model& model, const Feedback& feedback, Diagnostics& diagnostics) {
    const Walk walk{model, [&](const Formula& f, const std::string& what, const std::string& right) {
                        diagnostics.warning(model.path, feedback.places[std::min(static_cast<std::size_t>(f->start), feedback.places.size() - 1)], what, right);
                    }};
    const Formula signal = std::make_shared<const formula::Node>(formula::Node{Kind::name, 0, 0, 0, feedback.signal, {}});
    const Unit wanted = walk.of(signal);
    (void)walk.alike(wanted, walk.of(feedback.law), signal, feedback.law, feedback.law);
}

units::Unit unit_of_equation(const Model& model, const Equation& equation) {
    const Walk walk{model, [](const Formula&, const std::string&, const std::string&) {}};
    const Unit left = walk.of(equation.sides.left);
    return left.known() ? left : walk.of(equation.sides.right);
}

}  // namespace algest::model
