// SPDX-License-Identifier: GPL-3.0-or-later
// A transfer equation by its orders, written out as an ODE:  sum a_i y^(i) = sum b_i u^(i).
#pragma once
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/exact.hpp"

namespace algest::model {

struct Model;
struct Equation;

struct UnknownCoefficient {
    std::string name;
    Position at;
};
struct KnownCoefficient {
    std::string name;
    Position at;
    exact::Rational value;
};
struct Coefficients {
    std::vector<UnknownCoefficient> unknowns;
    std::vector<KnownCoefficient> known;
};

struct TransferInput {
    std::string signal;
    Position at;
    int m = 0;
    Position m_at;
    Coefficients coefficients;   ///< only with several inputs
};

/// What [transfer] says. With one input, `coefficients` holds those of output and input: letter a for the output, any
/// other for the input; with several, the output's only. The number at the end of a name is the order of the derivative.
struct Transfer {
    Position at;
    std::string output;
    Position output_at;
    int n = 1;
    Coefficients coefficients;
    std::vector<TransferInput> inputs;
};

/// Adds the unknowns to the model's parameters (units follow from those of the signals) and writes text and formula of
/// the equation; a_n = 1 unless it is named. False after a complaint.
bool write_out(const Transfer& transfer, Model& model, Equation& equation, Diagnostics& diagnostics);

}  // namespace algest::model
