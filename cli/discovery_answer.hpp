// SPDX-License-Identifier: GPL-3.0-or-later
// What `algest discover` answers: JSON for programs, text for people, and the files that it names.
#pragma once
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "lab/discovery.hpp"

namespace algest::cli {

/// Where the files of a discovery lie.
struct DiscoveryFiles {
    std::vector<std::string> before;   ///< by recording: before.csv, before_2.csv, ...
    std::vector<std::string> after;
    std::string model;
    std::string patch;
    std::string report;

    std::vector<std::string> all() const {
        std::vector<std::string> out = {model, patch, report};
        out.insert(out.end(), before.begin(), before.end());
        out.insert(out.end(), after.begin(), after.end());
        return out;
    }
};

/// {"verdict", "effects", "alternatives", "experiments", "doubts", "evidence", "parameters_before", "parameters_after", "where", "outputs",
/// "recordings", "model", "patch", "report"}. amended: model and patch are written, else null.
nlohmann::ordered_json discovery_json(const lab::Discovery& d, const DiscoveryFiles& files, bool amended);

std::string discovery_text(const lab::Discovery& d, const std::string& report_file);

}  // namespace algest::cli
