// SPDX-License-Identifier: GPL-3.0-or-later
// functional = "derivative" (001): an equation holds at each instant, with measured signals and derivatives by the parabola filter. Its window is
// that instant alone.
//
// The filter's derivative at sample k lies between what a held command did before k and what it does from k on: while u_k grows by one a
// sample, the filter says u_k - 1/2. Where a signal is held, windows have two samples and it counts with the mean of both; all others with the newer.
#include "generator/parabola.hpp"
#include "generator/row_functional.hpp"

namespace algest::generator {

namespace {

using exact::Rational;

class DerivativeFunctional : public RowFunctional {
public:
    DerivativeFunctional(const model::Model& model, const std::vector<equation::OperatorForm>& forms) : model_(model) {
        for (const equation::OperatorForm& form : forms) {
            for (const equation::Term& term : form.terms) held_signals_ = held_signals_ || (!form.is_constant(term.product) && held(model, form, term.product));
        }
    }

    plan::Functional kind() const override { return plan::Functional::derivative; }
    int intervals() const override { return held_signals_ ? 1 : 0; }
    bool weights_differentiate() const override { return false; }
    kernel::Coefficients kernel(std::size_t, int, Kind) override { return {}; }
    std::string table_name(std::size_t, int, Kind, plan::Hold hold) const override { return hold == plan::Hold::zoh ? "mean_of_two" : "at_instant"; }
    std::vector<double> weights(std::size_t, int, Kind, plan::Hold hold) override {
        if (!held_signals_) return {1.0};
        return hold == plan::Hold::zoh ? std::vector<double>{0.5, 0.5} : std::vector<double>{0.0, 1.0};
    }
    Rational of_one(std::size_t, int, Kind) override { return 1; }
    Rational time_scale(int) const override { return 1; }
    Rational square_norm(std::size_t, int) override { return 1; }
    Rational noise_gain(int n) const override {
        return n == 0 ? Rational(1) : *exact::function_value("sqrt", parabola::noise_power(parabola::Output::slope)) / *model_.period;
    }
    std::vector<plan::Annihilated> annihilated(std::size_t, const std::vector<ChosenRow>&) const override { return {}; }

private:
    const model::Model& model_;
    bool held_signals_ = false;
};

}  // namespace

bool hold_at_instants(const model::Model& model, const lumping::Lumping& lumping, std::vector<equation::OperatorForm>& forms, Diagnostics& diagnostics) {
    bool good = true;
    for (std::size_t e = 0; e < forms.size(); ++e) {
        if (!lumping.equations[e].used) continue;
        forms[e].delayed = true;
        if (forms[e].n < 2) continue;
        const model::Equation& equation = model.equations[e];
        diagnostics.error(model.path, equation.at, "equation '" + equation.name + "' has a derivative of order " + std::to_string(forms[e].n) + ", and the parabola filter gives the first alone",
                          "measure the rate too and write der(rate), or use functional = \"annihilator\"");
        good = false;
    }
    return good;
}

std::unique_ptr<RowFunctional> derivative_functional(const model::Model& model, const std::vector<equation::OperatorForm>& forms) {
    return std::make_unique<DerivativeFunctional>(model, forms);
}

}  // namespace algest::generator
