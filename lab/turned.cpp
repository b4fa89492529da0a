// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/turned.hpp"

#include <algorithm>
#include <cctype>

namespace algest::lab {

namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

/// Behind the operand that begins here: a number, a name, or what is in parentheses or braces.
std::size_t behind_operand(const std::string& sum, std::size_t at) {
    if (sum[at] == '(' || sum[at] == '{') {
        int depth = 0;
        for (; at < sum.size(); ++at) {
            if (sum[at] == '(' || sum[at] == '{') ++depth;
            if ((sum[at] == ')' || sum[at] == '}') && --depth == 0) return at + 1;
        }
        return at;
    }
    const bool is_number = is_digit(sum[at]) || sum[at] == '.';
    for (; at < sum.size(); ++at) {
        const bool of_exponent = is_number && (sum[at] == '-' || sum[at] == '+') && (sum[at - 1] == 'e' || sum[at - 1] == 'E');
        if (!is_of_word(sum[at]) && !of_exponent) break;
    }
    return at;
}

}  // namespace

std::string turned(const std::string& sum) {
    std::string out;
    bool begun = false;     // the first term
    bool complete = false;  // an operand stands before: a sign joins terms, else it is the operand's own
    for (std::size_t at = 0; at < sum.size();) {
        const char c = sum[at];
        const bool is_sign = c == '+' || c == '-';
        if (c == ' ') {
            out += c;
            ++at;
            continue;
        }
        if (!begun && !is_sign) out += '-';
        if (is_sign || c == '*' || c == '/' || c == '^') {
            out += !is_sign || (begun && !complete) ? c : c == '+' ? '-' : '+';
            complete = false;
            ++at;
        } else {
            const std::size_t end = std::max(behind_operand(sum, at), at + 1);
            out.append(sum, at, end - at);
            complete = true;
            at = end;
        }
        begun = true;
    }
    return out;
}

}  // namespace algest::lab
