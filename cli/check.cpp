// SPDX-License-Identifier: GPL-3.0-or-later
// algest check: are the models sound and identifiable?
#include "cli/commands.hpp"
#include "cli/identifiability.hpp"
#include "cli/messages.hpp"
#include "generator/generate.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// Of one model: what --identifiability says. Text is printed at once.
ordered_json identifiability(const std::string& path, const CheckOptions& options, Outcome& outcome) {
    Diagnostics diagnostics;
    const auto model = model::read(path, options.strict, diagnostics);
    const auto structure = model ? structure::structural_identifiability(*model, options.hidden, diagnostics) : std::nullopt;
    outcome.take(diagnostics);
    ordered_json out = {{"model", path}, {"ok", structure && structure->identifiable()}, {"warnings", warnings_json(diagnostics)}};
    if (!structure) return out;
    if (!structure->identifiable()) outcome.say_no();
    if (!options.json) print(path + (structure->identifiable() ? ": identifiable\n" : ": not identifiable\n") + text(*structure));
    out["identifiability"] = json(*structure);
    return out;
}

ordered_json soundness(const std::string& path, const CheckOptions& options, Outcome& outcome) {
    Diagnostics diagnostics;
    const bool ok = generator::check_model(path, options.strict, diagnostics);
    outcome.take(diagnostics);
    if (ok && !options.json) print(path + ": ok\n");
    return {{"model", path}, {"ok", ok}, {"warnings", warnings_json(diagnostics)}};
}

}  // namespace

int check(const CheckOptions& options) {
    Outcome outcome;
    ordered_json models = ordered_json::array();
    for (const std::string& model : options.models) models.push_back(options.identifiability ? identifiability(model, options, outcome) : soundness(model, options, outcome));
    outcome.print_result({{"models", std::move(models)}}, options.json);
    return outcome.code();
}

}  // namespace algest::cli
