// SPDX-License-Identifier: GPL-3.0-or-later
// What a reviewer is shown: a unified diff of code and derivation, a summary of tables.
#include <dtl/dtl.hpp>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "generator/generate.hpp"

namespace algest::generator {

namespace {

/// Where the last line has no end it is another line than with one, and shows as in diff.
std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    if (!text.empty() && text.back() != '\n') out.back() += "\n\\ No newline at end of file";
    return out;
}

/// The numbers of a line of weights; empty if it is anything else.
std::vector<double> weights_of(const std::string& line) {
    std::vector<double> out;
    const char* at = line.c_str();
    while (*at == ' ') ++at;
    while (*at != '\0') {
        if (*at != '-' && *at != '0') return {};
        char* end = nullptr;
        out.push_back(std::strtod(at, &end));
        if (end == at) return {};
        at = *end == 'f' ? end + 1 : end;
        if (*at == ',') ++at;
        while (*at == ' ') ++at;
    }
    return out;
}

/// Steps between two numbers of the scalar that the file is made of.
std::uint64_t units_in_last_place(double a, double b, bool single) {
    const auto ordered = [single](double x) {
        if (single) {
            const std::int32_t bits = std::bit_cast<std::int32_t>(static_cast<float>(x));
            return static_cast<std::int64_t>(bits < 0 ? -static_cast<std::int64_t>(bits & 0x7FFFFFFF) : bits);
        }
        const std::int64_t bits = std::bit_cast<std::int64_t>(x);
        return bits < 0 ? -(bits & 0x7FFFFFFFFFFFFFFF) : bits;
    };
    const std::int64_t x = ordered(a);
    const std::int64_t y = ordered(b);
    return x > y ? static_cast<std::uint64_t>(x) - static_cast<std::uint64_t>(y) : static_cast<std::uint64_t>(y) - static_cast<std::uint64_t>(x);
}

std::string table_summary(const std::string& path, const std::string& before, const std::string& after) {
    const std::vector<std::string> old_lines = lines_of(before);
    const std::vector<std::string> new_lines = lines_of(after);
    if (old_lines.size() != new_lines.size()) {
        return path + ": the tables have another shape: " + std::to_string(old_lines.size()) + " lines on disk, " + std::to_string(new_lines.size()) + " generated\n";
    }
    const bool single = after.find("constexpr float weights") != std::string::npos;
    int changed = 0;
    int other = 0;
    std::uint64_t largest = 0;
    for (std::size_t k = 0; k < old_lines.size(); ++k) {
        if (old_lines[k] == new_lines[k]) continue;
        const auto a = weights_of(old_lines[k]);
        const auto b = weights_of(new_lines[k]);
        if (a.empty() || a.size() != b.size()) {
            ++other;
            continue;
        }
        ++changed;
        for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, units_in_last_place(a[i], b[i], single));
    }
    return path + ": " + std::to_string(changed) + " rows of weights changed, by at most " + std::to_string(largest) + " units in the last place; " + std::to_string(other) + " other lines changed\n";
}

}  // namespace

std::string unified_diff(const std::string& before_name, const std::string& before, const std::string& after_name, const std::string& after) {
    if (before == after) return {};
    dtl::Diff<std::string> diff(lines_of(before), lines_of(after));
    diff.compose();
    diff.composeUnifiedHunks();
    std::ostringstream out;
    out << "--- " << before_name << "\n+++ " << after_name << "\n";
    diff.printUnifiedFormat(out);
    return out.str();
}

std::string difference(const EmittedFile& wanted, const std::optional<std::string>& present) {
    if (!present) return wanted.path + ": not there yet\n";
    if (*present == wanted.text) return {};
    if (wanted.path.ends_with("_tables.hpp")) return table_summary(wanted.path, *present, wanted.text);
    return unified_diff(wanted.path + " (on disk)", *present, wanted.path + " (generated)", wanted.text);
}

}  // namespace algest::generator
