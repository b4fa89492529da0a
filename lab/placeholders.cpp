// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/placeholders.hpp"

namespace algest::lab {

std::string filled(std::string text, const std::map<std::string, std::string>& with) {
    for (const auto& [name, what] : with) {
        const std::string placeholder = "{" + name + "}";
        for (std::size_t at = text.find(placeholder); at != std::string::npos; at = text.find(placeholder, at + what.size())) text.replace(at, placeholder.size(), what);
    }
    return text;
}

std::string filled_unit(const std::string& text, const std::map<std::string, std::string>& with) {
    for (const auto& [name, unit] : with) if (unit.empty() && text.find("{" + name + "}") != std::string::npos) return "";
    return filled(text, with);
}

}  // namespace algest::lab
