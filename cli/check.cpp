// SPDX-License-Identifier: GPL-3.0-or-later
// algest check: are the models sound and identifiable?
#include <algorithm>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "generator/generate.hpp"

namespace algest::cli {

int check(const CheckOptions& options) {
    int worst = exit_done;
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    nlohmann::ordered_json errors = nlohmann::ordered_json::array();
    for (const std::string& model : options.models) {
        Diagnostics diagnostics;
        const bool ok = generator::check_model(model, options.strict, diagnostics);
        print_diagnostics(diagnostics);
        worst = std::max(worst, exit_code(diagnostics));
        if (ok && !options.json) print(model + ": ok\n");
        models.push_back({{"model", model}, {"ok", ok}, {"warnings", warnings_json(diagnostics)}});
        for (auto& error : errors_json(diagnostics)) errors.push_back(std::move(error));
    }
    if (!options.json) return worst;
    if (errors.empty()) {
        print_json({{"models", std::move(models)}});
    } else {
        print_json({{"error", std::move(errors)}, {"models", std::move(models)}});
    }
    return worst;
}

}  // namespace algest::cli
