// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/output_file.hpp"

#include <filesystem>
#include <system_error>

namespace algest::cli {

namespace {

bool output_is_input(const std::string& output, const std::vector<std::string>& inputs, Diagnostics& diagnostics) {
    for (const std::string& input : inputs) {
        std::error_code no_matter;
        if (output.empty() || !std::filesystem::is_regular_file(output, no_matter) ||
            !std::filesystem::equivalent(output, input, no_matter)) {
            continue;
        }
        diagnostics.error(output, {}, "is to be read and to be written", "another file");
        return true;
    }
    return false;
}

}  // namespace

bool outputs_collide(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs, Diagnostics& diagnostics) {
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        if (output_is_input(outputs[k], inputs, diagnostics)) return true;
        for (std::size_t other = 0; other < k; ++other) {
            if (outputs[k].empty() || std::filesystem::path(outputs[k]).lexically_normal() != std::filesystem::path(outputs[other]).lexically_normal()) continue;
            diagnostics.error(outputs[k], {}, "is to be written twice", "a file of its own for each output");
            return true;
        }
    }
    return false;
}

}  // namespace algest::cli
