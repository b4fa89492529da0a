// SPDX-License-Identifier: GPL-3.0-or-later
// The generator without the rest of algest, for emitted.py, which builds it with several compilers. It writes the bytes that
// `algest generate MODEL... -o FOLDER --scalar S` and `algest derive MODEL --format F [--weights]` write, and takes no other words.
#include "generator/generate.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

using namespace algest;

namespace {

int fail(const Diagnostics& diagnostics) {
    for (const Diagnostic& d : diagnostics.sorted()) std::fprintf(stderr, "%s\n", d.text().c_str());
    return 2;
}

int generate(const std::vector<std::string>& models, const std::filesystem::path& folder, plan::Scalar scalar) {
    for (const std::string& model : models) {
        Diagnostics diagnostics;
        const auto made = generator::generate(model, {scalar, ""}, diagnostics);
        if (!made) return fail(diagnostics);
        for (const generator::EmittedFile& file : made->files) {
            std::filesystem::create_directories((folder / file.path).parent_path());
            std::ofstream(folder / file.path, std::ios::binary) << file.text;
        }
    }
    return 0;
}

int derive(const std::string& model, std::string_view format, bool weights) {
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(model, {plan::Scalar::float64, "", weights}, diagnostics);
    if (!plan) return fail(diagnostics);
    std::string text = format == "json"    ? generator::derivation_json(*plan, weights)
                       : format == "latex" ? generator::derivation_latex(*plan)
                                           : generator::derivation_text(*plan);
    if (!text.ends_with('\n')) text += '\n';
    std::fputs(text.c_str(), stdout);
    return 0;
}

}  // namespace

int main(int count, char** words) {
    const std::vector<std::string> all(words + 1, words + count);
    std::vector<std::string> models;
    std::string folder, scalar, format;
    bool weights = false;
    for (std::size_t k = 1; k < all.size(); ++k) {
        std::string* const value = all[k] == "-o" ? &folder : all[k] == "--scalar" ? &scalar : all[k] == "--format" ? &format : nullptr;
        if (all[k] == "--weights") {
            weights = true;
        } else if (value == nullptr) {
            models.push_back(all[k]);
        } else if (k + 1 < all.size()) {
            *value = all[++k];
        }
    }
    if (all.empty() || models.empty()) return 2;
    if (all[0] == "derive") return derive(models[0], format, weights);
    return generate(models, folder, scalar == "float" ? plan::Scalar::float32 : plan::Scalar::float64);
}
