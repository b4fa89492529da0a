// SPDX-License-Identifier: GPL-3.0-or-later
// functional = "annihilator": polynomial kernels on a window (000 and 003).
#include <array>
#include <map>

#include "generator/annihilator.hpp"
#include "generator/perturbation.hpp"
#include "generator/row_functional.hpp"

namespace algest::generator {

namespace {

using exact::Rational;

class AnnihilatorFunctional : public RowFunctional {
public:
    AnnihilatorFunctional(const model::Model& model, const std::vector<equation::OperatorForm>& forms, plan::Scalar scalar)
        : model_(model), forms_(forms), scalar_(scalar) {}

    plan::Functional kind() const override { return plan::Functional::annihilator; }
    int intervals() const override { return cln::cl_I_to_int(cln::numerator(*model_.window / model_.window_period())); }
    bool weights_differentiate() const override { return true; }

    /// Derived once: every row and term of these orders has it.
    kernel::Coefficients kernel(std::size_t equation, int derivative, Kind kind) override {
        const annihilator::Orders o = orders(equation);
        const auto [at, fresh] = kernels_.try_emplace({derivative, kind.p, kind.perturbation, o.n, o.kappa});
        if (fresh) at->second = kind.p > 0 ? annihilator::kernel(derivative, kind.p, o) : perturbation::kernel(kind.perturbation, derivative, o.n, o.kappa);
        return at->second;
    }

    std::string table_name(std::size_t equation, int derivative, Kind kind, plan::Hold hold) const override {
        const annihilator::Orders o = orders(equation);
        const plan::Quadrature quadrature = model_.estimator.quadrature;
        const std::string rule = hold == plan::Hold::zoh ? "zoh"
                                 : quadrature == plan::Quadrature::exact ? "linear"
                                 : quadrature == plan::Quadrature::trapezoid ? "trapezoid" : "simpson";
        return "n" + std::to_string(o.n) + "_kappa" + std::to_string(o.kappa) + (kind.p > 0 && o.form == 2 ? "_form2" : "") + (kind.p > 0 ? "_F_" : "_C_") +
               std::to_string(derivative) + "_" + std::to_string(kind.p > 0 ? kind.p : kind.perturbation) + "_" + rule;
    }

    std::vector<double> weights(std::size_t equation, int derivative, Kind kind, plan::Hold hold) override {
        return kernel::weights(kernel(equation, derivative, kind), intervals(), hold, model_.estimator.quadrature, scalar_);
    }

    Rational of_one(std::size_t equation, int derivative, Kind kind) override {
        return kernel::integral(kernel(equation, derivative, kind), intervals(), plan::Hold::linear, model_.estimator.quadrature);
    }

    Rational time_scale(int derivative) const override { return exact::power(*model_.window, -derivative); }
    Rational square_norm(std::size_t equation, int p) override { return kernel::square_norm(kernel(equation, forms_[equation].n, {p, 0})); }
    Rational noise_gain(int n) const override { return time_scale(n); }

    std::vector<plan::Annihilated> annihilated(std::size_t equation, const std::vector<ChosenRow>& rows) const override {
        std::vector<plan::Annihilated> out;
        const annihilator::Orders o = orders(equation);
        for (const ChosenRow& row : rows) {
            if (row.equation != static_cast<int>(equation) || (o.form == 1 && !out.empty())) continue;
            out.push_back({o.form == 1 ? 0 : row.p, {}});
            for (int i = 0; i <= o.n; ++i) {
                std::vector<plan::LeibnizTerm> terms;
                for (const auto& t : annihilator::leibniz_expansion(i, o, row.p)) terms.push_back({exact::text(t.coefficient), t.power, t.derivative});
                out.back().leibniz.push_back(terms);
            }
        }
        return out;
    }

private:
    annihilator::Orders orders(std::size_t equation) const { return {forms_[equation].n, model_.equations[equation].kappa, model_.estimator.form}; }

    const model::Model& model_;
    const std::vector<equation::OperatorForm>& forms_;
    plan::Scalar scalar_;
    std::map<std::array<int, 5>, kernel::Coefficients> kernels_;   // by derivative, p, perturbation, n, kappa
};

}  // namespace

std::unique_ptr<RowFunctional> annihilator_functional(const model::Model& model, const std::vector<equation::OperatorForm>& forms, plan::Scalar scalar) {
    return std::make_unique<AnnihilatorFunctional>(model, forms, scalar);
}

}  // namespace algest::generator
