// SPDX-License-Identifier: GPL-3.0-or-later
// Which parameters a model's measured signals determine, before there is any data.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/model.hpp"

namespace algest::structure {

enum class Verdict {
    globally,   ///< one value fits
    locally,    ///< finitely many, apart from each other
    no          ///< a continuum
};

/// "globally", "locally", "not"
std::string text(Verdict verdict);

/// A parameter, or a combination of parameters.
struct Judged {
    std::string name;
    Verdict verdict;
    std::optional<int> values;   ///< how many values fit, complex ones counted; empty: not found out, or a continuum
    bool seen = true;              ///< false: the measured signals do not change with it
    std::vector<int> seen_in = {};   ///< of a parameter that is not identifiable: combinations that hold it
};

struct Structure {
    std::vector<std::string> measured;   ///< signals that equations move or give, and that are measured
    std::vector<std::string> inputs;     ///< known functions of time
    std::vector<std::string> hidden;
    std::vector<Judged> parameters;      ///< as the model's; of [discrete], its unknowns
    std::vector<Judged> combinations;    ///< independent ones of the parameters that are not identifiable, as many as there are

    bool identifiable() const;
};

/// For almost all parameters, initial values and inputs, noise-free measurements, unknown initial values, perturbations of kappa >= 1 unknown.
/// Local: the rank of the measured signals' sensitivity (taylor_rank.hpp; Sedoglavic 2002). Global: how many parameters give the same
/// input-output equations (Ljung and Glad 1994), counted by a Groebner basis; where those equations are out of reach the number of values is
/// empty. Complains (bad input) about names that are no signals, hidden inputs, and equations that cannot be brought to explicit form.
/// Cost: well below a second for ten parameters and five states.
std::optional<Structure> structural_identifiability(const model::Model& model, const std::vector<std::string>& hidden, Diagnostics& diagnostics);

}  // namespace algest::structure
