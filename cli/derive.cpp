// SPDX-License-Identifier: GPL-3.0-or-later
// algest derive: the derivation of an estimator, for a person, for a paper, for a program.
#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "generator/generate.hpp"

namespace algest::cli {

int derive(const DeriveOptions& options) {
    Diagnostics diagnostics;
    generator::PlanOptions plan_options;
    plan_options.weights = options.weights;   // of discrete tables; those of kernels are made anew
    const auto plan = generator::plan_from_model(options.model, plan_options, diagnostics);
    if (!plan) return fail(diagnostics, options.format == "json");
    if (options.weights && options.format != "json")
        diagnostics.note(options.model, "--weights shows in --format json alone");
    print_diagnostics(diagnostics);
    std::string text = options.format == "json"    ? generator::derivation_json(*plan, options.weights)
                       : options.format == "latex" ? generator::derivation_latex(*plan)
                                                   : generator::derivation_text(*plan);
    if (!text.ends_with('\n')) text += '\n';
    print(text);
    return exit_done;
}

}  // namespace algest::cli
