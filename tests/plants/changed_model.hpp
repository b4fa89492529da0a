// SPDX-License-Identifier: GPL-3.0-or-later
// A model's text with replacements: variants of one model stay next to each other.
#pragma once
#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace algest::plants {

/// Each text must stand in the model; its first place is replaced.
inline std::string changed(std::string model, const std::vector<std::pair<std::string, std::string>>& replacements) {
    for (const auto& [old, fresh] : replacements) {
        INFO(old);
        const auto at = model.find(old);
        REQUIRE(at != std::string::npos);
        model.replace(at, old.size(), fresh);
    }
    return model;
}

/// The text of models/NAME.toml.
inline std::string committed_model(const std::string& name) {
    std::ifstream file(ALGEST_SOURCE "/models/" + name + ".toml");
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace algest::plants
