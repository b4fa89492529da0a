// SPDX-License-Identifier: GPL-3.0-or-later
// algest generate: writes estimators, or compares them with what is there.
#include "generator/generate.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "lab/write_file.hpp"

namespace algest::cli {

namespace {

using nlohmann::ordered_json;

/// A model that was asked for, and what came of it.
struct Estimator {
    std::string model;
    std::string name;
    std::vector<generator::EmittedFile> files;  ///< paths as they will be written
};

/// Plans every model; those that fail leave diagnostics. Two estimators of one name would share files: then there are none.
std::vector<plan::Plan> plan_all(const GenerateOptions& options, std::vector<std::string>& models,
                                 Diagnostics& diagnostics) {
    const generator::PlanOptions plan_options{options.scalar == "float" ? plan::Scalar::float32 : plan::Scalar::float64,
                                              options.engine};
    std::vector<plan::Plan> plans;
    std::map<std::string, std::string> model_of_name;
    for (const std::string& model : options.models) {
        auto plan = generator::plan_from_model(model, plan_options, diagnostics);
        if (!plan) continue;
        const auto [first, is_new] = model_of_name.emplace(plan->name, model);
        if (!is_new) {
            diagnostics.error(model, {}, "its name is `" + plan->name + "`, that of " + first->second + " too",
                              "a `name` of its own for each model");
            return {};
        }
        if (!options.check) {
            for (const std::string& text : plan->notes) diagnostics.note(model, text);
        }
        models.push_back(model);
        plans.push_back(std::move(*plan));
    }
    return plans;
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
bool write(const Estimator& estimator, Diagnostics& diagnostics) {
    std::vector<lab::StagedFile> staged;
    for (const generator::EmittedFile& file : estimator.files) {
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
        note("wrote " + estimator.files[k].path);
    }
    return true;
}

/// Shows how the files differ from what is there; the differences as JSON.
ordered_json differences(const Estimator& estimator, bool json, Diagnostics& diagnostics) {
    ordered_json out = ordered_json::array();
    for (const generator::EmittedFile& file : estimator.files) {
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
    Diagnostics diagnostics;
    std::vector<std::string> models;
    const std::vector<plan::Plan> plans = plan_all(options, models, diagnostics);

    bool different = false;
    ordered_json done = ordered_json::array();
    for (std::size_t k = 0; k < plans.size(); ++k) {
        Estimator estimator{models[k], plans[k].name, generator::emit(plans[k])};
        for (generator::EmittedFile& file : estimator.files) {
            file.path = (std::filesystem::path(options.directory) / file.path).string();
        }
        ordered_json entry = {{"model", estimator.model}, {"name", estimator.name}};
        if (options.check) {
            entry["differences"] = differences(estimator, options.json, diagnostics);
            different = different || !entry["differences"].empty();
        } else {
            if (!write(estimator, diagnostics)) continue;
            entry["written"] = ordered_json::array();
            for (const generator::EmittedFile& file : estimator.files) entry["written"].push_back(file.path);
        }
        done.push_back(std::move(entry));
    }

    if (diagnostics.failed()) return fail(diagnostics, options.json);
    print_diagnostics(diagnostics);
    if (options.json) print_json({{"models", std::move(done)}});
    return different ? exit_no : exit_done;
}

}  // namespace algest::cli
