// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/whole_word.hpp"

#include <cctype>

namespace algest::lab {

std::size_t find_whole_word(const std::string& text, const std::string& name, std::size_t from) {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = text.find(name, from); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !is_word(text[at - 1])) && (end == text.size() || !is_word(text[end]))) return at;
    }
    return std::string::npos;
}

}  // namespace algest::lab
