// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/constant_value.hpp"

#include "generator/model.hpp"

namespace algest::model {

namespace {

using exact::Rational;
using formula::Formula;
using formula::Kind;

constexpr std::size_t most_bits = 10000;   // of numerator and denominator together

class Evaluation {
public:
    /// Without `complain` silent, and done with a sum or product as soon as one operand has no value.
    Evaluation(const Model& model, const formula::Complain* complain) : model_(model), complain_(complain) {}

    bool good() const { return good_; }

    /// `raised` is the product of the exponents around f.
    std::optional<Rational> of(const Formula& f, const Rational& raised = 1) {
        const auto value = value_of(f, raised);
        if (!value) return std::nullopt;
        const std::size_t bits = cln::integer_length(cln::numerator(*value)) + cln::integer_length(cln::denominator(*value));
        if (bits > most_bits) return fail(f, "a fraction of thousands of digits", "write it as a decimal");
        if (!within_power_of_ten(*value, largest_number)) {
            const std::string limit = std::to_string(largest_number);
            return fail(f, "a number beyond 1e" + limit + " or closer to 0 than 1e-" + limit, "choose units in which it is of usual size");
        }
        return value;
    }

private:
    std::nullopt_t fail(const Formula& f, const std::string& what, const std::string& right) {
        good_ = false;
        if (complain_ != nullptr) (*complain_)(f->start, what, right);
        return std::nullopt;
    }

    std::optional<Rational> value_of(const Formula& f, const Rational& raised) {
        switch (f->kind) {
            case Kind::number: return f->value;
            case Kind::name: {
                const Constant* c = model_.constant(f->name);
                return c == nullptr ? std::nullopt : std::optional<Rational>(c->value);
            }
            case Kind::negate: {
                const auto x = of(f->arguments[0], raised);
                return x ? std::optional<Rational>(-*x) : std::nullopt;
            }
            case Kind::add:
            case Kind::subtract:
            case Kind::multiply:
            case Kind::divide: return operation(f, raised);
            case Kind::power: return power(f, raised);
            case Kind::call: return call(f);
        }
        return std::nullopt;
    }

    std::optional<Rational> operation(const Formula& f, const Rational& raised) {
        const auto a = of(f->arguments[0], raised);
        if (!a && complain_ == nullptr) return std::nullopt;
        const auto b = of(f->arguments[1], raised);
        if (f->kind == Kind::divide && b && cln::zerop(*b)) return fail(f->arguments[1], "division by zero", "remove the term");
        if (!a || !b) return std::nullopt;
        if (f->kind == Kind::add) return *a + *b;
        if (f->kind == Kind::subtract) return *a - *b;
        return f->kind == Kind::multiply ? *a * *b : *a / *b;
    }

    std::optional<Rational> power(const Formula& f, const Rational& raised) {
        const auto e = of(f->arguments[1]);
        const Rational here = e && cln::abs(*e) > 1 ? cln::abs(*e) * raised : raised;
        if (here > formula::largest_exponent) {
            return fail(f->arguments[1], raised == 1 ? "the exponent is beyond " + std::to_string(formula::largest_exponent)
                                                     : "powers of powers beyond " + std::to_string(formula::largest_exponent),
                        "a model needs no such power");
        }
        const auto base = of(f->arguments[0], here);
        if (!e || !base) return std::nullopt;
        if (cln::zerop(*base) && !cln::plusp(*e)) return fail(f, "0 to a power that is not positive", "remove the term");
        if (exact::is_integer(*e)) return exact::power(*base, cln::cl_I_to_int(cln::numerator(*e)));
        if (cln::minusp(*base)) return fail(f, "a negative number to a power that is not whole", "it has no real value");
        if (cln::zerop(*base)) return 0;
        const auto value = exact::real_power(*base, *e);
        return value ? value : fail(f, "a power beyond all numbers", "remove the term");
    }

    std::optional<Rational> call(const Formula& f) {
        if (f->name == "der") return std::nullopt;
        if (f->name == "delay") {   // by a value, of a signal
            (void)of(f->arguments[1]);
            return std::nullopt;
        }
        const auto a = of(f->arguments[0]);
        const auto b = f->arguments.size() > 1 ? of(f->arguments[1]) : a;
        if (!a || !b) return std::nullopt;
        if (f->name == "abs") return cln::abs(*a);
        if (f->name == "sgn") return cln::signum(*a);
        if (f->name == "min") return cln::min(*a, *b);
        if (f->name == "max") return cln::max(*a, *b);
        if (f->name == "sqrt" && cln::zerop(*a)) return 0;
        const auto value = exact::function_value(f->name, *a);
        return value ? value : fail(f, f->name + " of this number is not a real number that can be computed with", "remove the term");
    }

    const Model& model_;
    const formula::Complain* complain_;
    bool good_ = true;
};

}  // namespace

bool within_power_of_ten(const Rational& value, int exponent) {
    const Rational size = cln::abs(value);
    return cln::zerop(value) || (size <= exact::power(Rational(10), exponent) && size >= exact::power(Rational(10), -exponent));
}

std::optional<Rational> constant_value(const Model& model, const Formula& f) {
    return Evaluation(model, nullptr).of(f);
}

bool check_constants(const Model& model, const Formula& f, const formula::Complain& complain) {
    Evaluation evaluation(model, &complain);
    (void)evaluation.of(f);
    return evaluation.good();
}

}  // namespace algest::model
