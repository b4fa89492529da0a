// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/identifiability.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace algest::cli {

namespace {

using nlohmann::ordered_json;
using structure::Judged;
using structure::Structure;
using structure::Verdict;

std::string list(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& n : names) out += (out.empty() ? "" : ", ") + n;
    return out.empty() ? "none" : out;
}

/// What stands beside the verdict.
std::string remark(const Judged& judged, const Structure& structure) {
    if (judged.verdict == Verdict::globally) return "one value fits";
    if (judged.verdict == Verdict::locally) return judged.values ? fmt::format("{} values fit", *judged.values) : "finitely many values fit; how many was not found out";
    std::vector<std::string> names;
    for (const int c : judged.seen_in) names.push_back(structure.combinations[static_cast<std::size_t>(c)].name);
    if (!judged.seen) return "the measured signals say nothing of it";
    return names.empty() ? "seen only together with others" : "seen only in " + list(names);
}

ordered_json judged_json(const Judged& judged) {
    return {{"name", judged.name}, {"verdict", structure::text(judged.verdict)}, {"values", judged.values ? ordered_json(*judged.values) : ordered_json(nullptr)}};
}

}  // namespace

std::string text(const Structure& structure) {
    std::string out = fmt::format("  measured: {}; inputs: {}; hidden: {}\n", list(structure.measured), list(structure.inputs), list(structure.hidden));
    std::size_t width = 0;
    for (const auto* names : {&structure.parameters, &structure.combinations}) for (const Judged& j : *names) width = std::max(width, j.name.size());
    for (const Judged& p : structure.parameters) out += fmt::format("  {:<{}}  {:<8}  {}\n", p.name, width, structure::text(p.verdict), remark(p, structure));
    for (const Judged& c : structure.combinations) out += fmt::format("  {:<{}}  {:<8}  {}\n", c.name, width, structure::text(c.verdict), remark(c, structure));
    return out;
}

ordered_json json(const Structure& structure) {
    ordered_json parameters = ordered_json::array();
    for (const Judged& p : structure.parameters) {
        ordered_json one = judged_json(p);
        one["seen_in"] = ordered_json::array();
        for (const int c : p.seen_in) one["seen_in"].push_back(structure.combinations[static_cast<std::size_t>(c)].name);
        parameters.push_back(std::move(one));
    }
    ordered_json combinations = ordered_json::array();
    for (const Judged& c : structure.combinations) combinations.push_back(judged_json(c));
    return {{"measured", structure.measured}, {"inputs", structure.inputs}, {"hidden", structure.hidden}, {"parameters", std::move(parameters)}, {"combinations", std::move(combinations)}};
}

}  // namespace algest::cli
