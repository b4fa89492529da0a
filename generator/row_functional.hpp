// SPDX-License-Identifier: GPL-3.0-or-later
// What [estimator] functional makes of an equation's terms: the one place where annihilator, derivative, ... differ for the planner.
// Every functional is a dot product of weights with the newest samples of a ring, so that the runtime is the same for all.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "generator/kernel.hpp"
#include "generator/lumping.hpp"
#include "generator/plan.hpp"
#include "generator/row_choice.hpp"

namespace algest::generator {

/// Which functional of an equation: of row p, or (p = 0) of the coefficient c_i of its perturbation.
struct Kind {
    int p;
    int perturbation;
};

/// equation: index into the model's equations. derivative: order of the derivative that the weights take; 0 where they take none.
class RowFunctional {
public:
    virtual ~RowFunctional() = default;

    virtual plan::Functional kind() const = 0;
    /// M: a window has M + 1 samples.
    virtual int intervals() const = 0;
    /// True: the weights differentiate and the ring holds the signal under a lone derivative. False: it holds that derivative, by the parabola
    /// filter, and every signal is one sample late.
    virtual bool weights_differentiate() const = 0;
    /// Of the weights on [0,1], lowest power first; empty: they are no polynomial's.
    virtual kernel::Coefficients kernel(std::size_t equation, int derivative, Kind kind) = 0;
    /// Tells tables apart.
    virtual std::string table_name(std::size_t equation, int derivative, Kind kind, plan::Hold hold) const = 0;
    /// M + 1 of them, oldest sample first, each rounded once.
    virtual std::vector<double> weights(std::size_t equation, int derivative, Kind kind, plan::Hold hold) = 0;
    /// The functional of the constant 1.
    virtual exact::Rational of_one(std::size_t equation, int derivative, Kind kind) = 0;
    /// What a derivative of this order multiplies a functional by: weights live on [0,1].
    virtual exact::Rational time_scale(int derivative) const = 0;
    /// Square of the norm by which row p of an equation is divided where rows are pooled.
    virtual exact::Rational square_norm(std::size_t equation, int p) = 0;
    /// Deviation that noise of deviation 1 gives the derivative of order n, in a row divided by that norm.
    virtual exact::Rational noise_gain(int n) const = 0;
    /// How Pi acts on the equation, for its derivation; empty: nothing is annihilated.
    virtual std::vector<plan::Annihilated> annihilated(std::size_t equation, const std::vector<ChosenRow>& rows) const = 0;

    /// Order of the derivative that the weights take of a product.
    int order(const equation::OperatorForm& form, const equation::Product& product) const { return weights_differentiate() ? form.order(product) : 0; }
    /// True when the ring's signal is constant between samples: all its signals have hold zoh, and no filter runs on them.
    bool held(const model::Model& model, const equation::OperatorForm& form, const equation::Product& product) const;
};

/// The functional that the model asks for. What it keeps a reference to must live longer: the model, and the forms of its equations.
std::unique_ptr<RowFunctional> row_functional(const model::Model& model, const std::vector<equation::OperatorForm>& forms, plan::Scalar scalar);

/// functional = "derivative": makes every equation that is used one sample late. Complains, and answers false, where one has a derivative
/// that the parabola filter does not give.
bool hold_at_instants(const model::Model& model, const lumping::Lumping& lumping, std::vector<equation::OperatorForm>& forms, Diagnostics& diagnostics);

std::unique_ptr<RowFunctional> annihilator_functional(const model::Model& model, const std::vector<equation::OperatorForm>& forms, plan::Scalar scalar);
std::unique_ptr<RowFunctional> derivative_functional(const model::Model& model, const std::vector<equation::OperatorForm>& forms);
std::unique_ptr<RowFunctional> average_functional();

}  // namespace algest::generator
