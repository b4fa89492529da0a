// SPDX-License-Identifier: GPL-3.0-or-later
// algest generate: writes estimators, or compares them with what is there.
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
#include "generator/cost.hpp"
#include "lab/write_file.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// A model that was asked for and could be generated.
struct Made {
    std::string model;
    generator::Generated generated;
    ordered_json cost;   ///< of the chosen engine first, then of the other
};

ordered_json json(const std::vector<generator::EngineCost>& costs) {
    ordered_json out = ordered_json::array();
    for (const auto& [engine, cost] : costs) {
        out.push_back({{"engine", engine}, {"operations", cost.operations * (cost.push + cost.estimate)}, {"memory", cost.instance_bytes}, {"tables", cost.table_bytes}});
    }
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

/// Generates every model; those that fail tell `outcome`. Two of one name would share files: then there are none.
std::vector<Made> make_all(const GenerateOptions& options, Outcome& outcome) {
    const generator::PlanOptions plan_options{options.scalar == "float" ? plan::Scalar::float32 : plan::Scalar::float64,
                                              options.engine};
    std::vector<Made> out;
    std::map<std::string, std::string> model_of_name;
    bool names_differ = true;
    for (const std::string& model : options.models) {
        Diagnostics diagnostics;
        auto generated = generator::generate(model, plan_options, diagnostics);
        if (generated) {
            const auto [first, is_new] = model_of_name.emplace(generated->name, model);
            if (!is_new) {
                diagnostics.error(model, {}, "its name is `" + generated->name + "`, that of " + first->second + " too",
                                  "a `name` of its own for each model");
                names_differ = false;
            } else if (!options.check) {
                for (const std::string& text : generated->notes) diagnostics.note(model, text);
            }
            ordered_json cost = json(options.check ? std::vector<generator::EngineCost>() : generator::engine_costs(model, plan_options));
            if (!cost.empty()) diagnostics.note(model, text(cost));
            out.push_back({model, std::move(*generated), std::move(cost)});
        }
        outcome.take(diagnostics);
    }
    return names_differ ? std::move(out) : std::vector<Made>();
}

/// The files with the paths under which they are to lie.
std::vector<generator::EmittedFile> placed(std::vector<generator::EmittedFile> files, const std::filesystem::path& directory) {
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
    for (const Made& made : make_all(options, outcome)) {
        Diagnostics diagnostics;
        const std::vector<generator::EmittedFile> files = placed(made.generated.files, options.directory);
        ordered_json entry = {{"model", made.model}, {"name", made.generated.name}};
        if (options.check) {
            entry["differences"] = differences(files, options.json, diagnostics);
            if (!entry["differences"].empty()) outcome.say_no();
            done.push_back(std::move(entry));
        } else if (write(files, diagnostics)) {
            entry["written"] = ordered_json::array();
            for (const generator::EmittedFile& file : files) entry["written"].push_back(file.path);
            entry["cost"] = made.cost;
            done.push_back(std::move(entry));
        }
        outcome.take(diagnostics);
    }
    outcome.print_result({{"models", std::move(done)}}, options.json);
    return outcome.code();
}

}  // namespace algest::cli
