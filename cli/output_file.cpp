// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/output_file.hpp"

#include <filesystem>
#include <system_error>

namespace algest::cli {

bool output_is_input(const std::string& output, const std::vector<std::string>& inputs, Diagnostics& diagnostics) {
    for (const std::string& input : inputs) {
        std::error_code no_matter;
        if (output.empty() || !std::filesystem::is_regular_file(output, no_matter) ||
            !std::filesystem::equivalent(output, input, no_matter)) {
            continue;
        }
        diagnostics.error(output, {}, "-o names the file that is read", "another file");
        return true;
    }
    return false;
}

}  // namespace algest::cli
