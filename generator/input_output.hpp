// SPDX-License-Identifier: GPL-3.0-or-later
// The input-output equations of a model: what its equations say of the measured signals alone, and their coefficients.
#pragma once
#include <optional>
#include <vector>

#include "generator/structural_form.hpp"

namespace algest::structure {

/// Takes out one hidden signal after the other: an equation that is linear in it gives it, its own equation then raises the order of that one.
/// Where none is, and a single measured signal sees what is hidden, its derivatives are taken until they give all of it. What no measured signal
/// sees is left out. The equations of the measured signals (= 0, without denominators); nullopt: hidden signals stand linearly nowhere. Throws TooLong.
std::optional<std::vector<GiNaC::ex>> input_output(std::vector<Explicit> equations, std::vector<bool> hidden, Symbols& symbols);

/// An equation as a polynomial of signals: the coefficients of its different products, each a polynomial of parameters and perturbations.
/// The factor that they have in common is open. `whole`: false where a function has a parameter in its argument, and nothing follows from them.
struct Coefficients {
    std::vector<GiNaC::ex> of_products;
    bool whole;
};
Coefficients coefficients(const GiNaC::ex& zero, const Symbols& symbols);

}  // namespace algest::structure
