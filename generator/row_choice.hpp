// SPDX-License-Identifier: GPL-3.0-or-later
// Which rows p of which equations make up the system.
#pragma once
#include <optional>
#include <vector>

#include "generator/lumping.hpp"

namespace algest::generator {

struct ChosenRow {
    int equation;   ///< index into the model's equations
    int p;
};

/// The rows that the model asks for; for equations that do not say, as many as make the system square, in turn over the
/// equations, each row added only where it can determine one more unknown. Complains where that leaves an unknown over.
std::optional<std::vector<ChosenRow>> choose_rows(const model::Model& model, const lumping::Lumping& lumping, Diagnostics& diagnostics);

}  // namespace algest::generator
