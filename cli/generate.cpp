// SPDX-License-Identifier: GPL-3.0-or-later
// algest generate: writes estimators, or compares them with what is there.
#include "generator/cost.hpp"
#include "generator/generate.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "lab/write_file.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// A model that was asked for and could be planned.
struct Planned {
    std::string model;
    plan::Plan plan;
    ordered_json cost;   ///< of both engines, the chosen one first
};

const char* engine_name(const plan::Plan& plan) { return plan.moments ? "moments" : "fir"; }

ordered_json cost_json(const plan::Plan& plan) {
    const generator::Cost cost = generator::cost_of(plan);
    return {{"engine", engine_name(plan)}, {"operations", cost.operations * (cost.push + cost.estimate)}, {"memory", cost.instance_bytes}, {"tables", cost.table_bytes}};
}

/// What the plan costs, and what the other engine would, unless the model cannot have that.
ordered_json costs(const std::string& model, const plan::Plan& plan) {
    ordered_json out = {cost_json(plan)};
    Diagnostics said_before;
    const auto other = generator::plan_from_model(model, {plan.scalar, plan.moments ? "fir" : "moments", false}, said_before);
    if (other && other->moments.has_value() != plan.moments.has_value()) out.push_back(cost_json(*other));
    return out;
}

std::string text(const ordered_json& costs) {
    std::string out;
    for (const ordered_json& c : costs) {
        out += (out.empty() ? "engine " : "; ") + c["engine"].get<std::string>() + ": " + c["operations"].dump() + " operations a sample, " + c["memory"].dump() +
               " bytes of memory, " + c["tables"].dump() + " of tables";
    }
    return out;
}

/// Plans every model; those that fail tell `outcome`. Two estimators of one name would share files: then there are none.
std::vector<Planned> plan_all(const GenerateOptions& options, Outcome& outcome) {
    const generator::PlanOptions plan_options{options.scalar == "float" ? plan::Scalar::float32 : plan::Scalar::float64,
                                              options.engine};
    std::vector<Planned> out;
    std::map<std::string, std::string> model_of_name;
    bool names_differ = true;
    for (const std::string& model : options.models) {
        Diagnostics diagnostics;
        auto plan = generator::plan_from_model(model, plan_options, diagnostics);
        if (plan) {
            const auto [first, is_new] = model_of_name.emplace(plan->name, model);
            if (!is_new) {
                diagnostics.error(model, {}, "its name is `" + plan->name + "`, that of " + first->second + " too",
                                  "a `name` of its own for each model");
                names_differ = false;
            } else if (!options.check) {
                for (const std::string& note : plan->notes) diagnostics.note(model, note);
            }
            ordered_json cost = options.check ? ordered_json() : costs(model, *plan);
            if (!options.check) diagnostics.note(model, text(cost));
            out.push_back({model, std::move(*plan), std::move(cost)});
        }
        outcome.take(diagnostics);
    }
    return names_differ ? std::move(out) : std::vector<Planned>();
}

/// The files of an estimator, with the paths under which they are to lie.
std::vector<generator::EmittedFile> files_of(const plan::Plan& plan, const std::filesystem::path& directory) {
    std::vector<generator::EmittedFile> files = generator::emit(plan);
    for (generator::EmittedFile& file : files) file.path = (directory / file.path).string();
    return files;
}

/// The bytes of a file; nullopt if there is none. What is there and cannot be read is an error.
std::optional<std::string> present_text(const std::string& path, Diagnostics& diagnostics) {
    std::error_code no_matter;
    if (!std::filesystem::exists(path, no_matter)) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file.is_open() || file.bad() || std::filesystem::is_directory(path, no_matter)) {
        diagnostics.error(path, {}, "cannot be read", "a file that `algest generate` wrote");
        return std::nullopt;
    }
    return text;
}

/// Puts all files of one estimator in their places, or none where one cannot be written beside its place.
bool write(const std::vector<generator::EmittedFile>& files, Diagnostics& diagnostics) {
    std::vector<lab::StagedFile> staged;
    for (const generator::EmittedFile& file : files) {
        const std::filesystem::path folder = std::filesystem::path(file.path).parent_path();
        std::error_code error;
        std::filesystem::create_directories(folder, error);
        if (error) {
            diagnostics.error(folder.string(), {}, "cannot be made: " + error.message(),
                              "a folder that can be written, with -o");
            return false;
        }
        if (!staged.emplace_back(file.path, file.text, diagnostics).good()) return false;
    }
    for (std::size_t k = 0; k < staged.size(); ++k) {
        if (!staged[k].put(diagnostics)) return false;
        note("wrote " + files[k].path);
    }
    return true;
}

/// Shows how the files differ from what is there; the differences as JSON.
ordered_json differences(const std::vector<generator::EmittedFile>& files, bool json, Diagnostics& diagnostics) {
    ordered_json out = ordered_json::array();
    for (const generator::EmittedFile& file : files) {
        std::string text = generator::difference(file, present_text(file.path, diagnostics));
        if (text.empty()) continue;
        if (!text.ends_with('\n')) text += '\n';
        if (!json) print(text);
        out.push_back({{"path", file.path}, {"difference", text}});
    }
    return out;
}

}  // namespace

int generate(const GenerateOptions& options) {
    Outcome outcome;
    ordered_json done = ordered_json::array();
    for (const Planned& planned : plan_all(options, outcome)) {
        Diagnostics diagnostics;
        const std::vector<generator::EmittedFile> files = files_of(planned.plan, options.directory);
        ordered_json entry = {{"model", planned.model}, {"name", planned.plan.name}};
        if (options.check) {
            entry["differences"] = differences(files, options.json, diagnostics);
            if (!entry["differences"].empty()) outcome.say_no();
            done.push_back(std::move(entry));
        } else if (write(files, diagnostics)) {
            entry["written"] = ordered_json::array();
            for (const generator::EmittedFile& file : files) entry["written"].push_back(file.path);
            entry["cost"] = planned.cost;
            done.push_back(std::move(entry));
        }
        outcome.take(diagnostics);
    }
    outcome.print_result({{"models", std::move(done)}}, options.json);
    return outcome.code();
}

}  // namespace algest::cli
