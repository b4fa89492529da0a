// SPDX-License-Identifier: GPL-3.0-or-later
// The front door of the generator: model file -> plan -> text.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generator/diagnostics.hpp"
#include "generator/plan.hpp"

namespace algest::generator {

/// What the command line may decide over the model file.
struct PlanOptions {
    plan::Scalar scalar = plan::Scalar::float64;
    std::string engine;    ///< "fir", "moments", or empty: as the model says
    bool weights = true;   ///< false: tables without weights, for who only shows where they come from; most of the work
};

/// Reads and checks a model file; every complaint goes to `diagnostics`. True when the model is sound and identifiable.
/// With strict, a missing unit is an error.
bool check_model(const std::string& path, bool strict, Diagnostics& diagnostics);

/// Derives the estimator of a model file. Empty when `diagnostics` says why not; each model needs diagnostics of its own, since
/// an error that stands there already counts as one of this model.
std::optional<plan::Plan> plan_from_model(const std::string& path, const PlanOptions& options, Diagnostics& diagnostics);

/// Needs no weights in the plan. The derivation for a person, for a paper, and for a program (design.md, section 8; `weights` adds the tables).
std::string derivation_text(const plan::Plan& plan);
std::string derivation_latex(const plan::Plan& plan);
std::string derivation_json(const plan::Plan& plan, bool weights);

/// A file that `generate` writes: path relative to the output directory, and its bytes.
struct EmittedFile {
    std::string path;
    std::string text;
};
/// NAME/NAME.hpp, NAME/NAME_tables.hpp, NAME/NAME.md. Throws std::logic_error if a template asks for a name it is not given.
std::vector<EmittedFile> emit(const plan::Plan& plan);

/// What `generate` makes of a model file: an estimator's files, or those of a [filter] (NAME/NAME.hpp and NAME/NAME.md).
struct Generated {
    std::string name;
    std::vector<std::string> notes;   ///< what was chosen for the user, in words
    std::vector<EmittedFile> files;
};
/// Empty when `diagnostics` says why not, as plan_from_model.
std::optional<Generated> generate(const std::string& path, const PlanOptions& options, Diagnostics& diagnostics);

/// Unified diff of two texts, under the two names; `patch` applies it. Empty: no difference.
std::string unified_diff(const std::string& before_name, const std::string& before, const std::string& after_name, const std::string& after);

/// What differs between a file as it should be and as it is on disk (nullopt: missing): unified diff for code and
/// derivation; for tables a summary (rows changed, largest change in units in the last place). Empty: no difference.
std::string difference(const EmittedFile& wanted, const std::optional<std::string>& present);

}  // namespace algest::generator
