// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/csv_text.hpp"

namespace algest::lab {

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string csv_heading(const std::string& name, const std::string& unit) {
    return csv_field(unit.empty() ? name : name + " [" + unit + "]");
}

}  // namespace algest::lab
