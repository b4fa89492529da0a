// SPDX-License-Identifier: GPL-3.0-or-later
// algest check: are the models sound and identifiable?
#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "generator/generate.hpp"

namespace algest::cli {

int check(const CheckOptions& options) {
    Outcome outcome;
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    for (const std::string& model : options.models) {
        Diagnostics diagnostics;
        const bool ok = generator::check_model(model, options.strict, diagnostics);
        outcome.take(diagnostics);
        if (ok && !options.json) print(model + ": ok\n");
        models.push_back({{"model", model}, {"ok", ok}, {"warnings", warnings_json(diagnostics)}});
    }
    outcome.print_result({{"models", std::move(models)}}, options.json);
    return outcome.code();
}

}  // namespace algest::cli
