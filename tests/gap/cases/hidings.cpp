// SPDX-License-Identifier: GPL-3.0-or-later
// What can be hidden in which system.
#include <algorithm>

#include "case.hpp"

namespace algest::gap {

namespace {

/// Hidden alone, never in a pair: what is over in an instant or has a memory, and what no file of the library says.
const std::vector<std::string> always_alone = {"bouc_wen_hysteresis", "cubic_damping",      "growing_resistance", "hard_stop",
                                               "position_damping",    "quadratic_leak",     "quadratic_stiffness", "radiation"};

/// Effects that only a model without that term can miss.
bool needs_wish(const std::string& name) { return name == "viscous_friction" || name == "back_emf"; }

}  // namespace

std::vector<std::string> parts(const std::string& text, char separator) {
    std::vector<std::string> out{""};
    for (const char c : text) {
        if (c == separator)
            out.emplace_back();
        else
            out.back() += c;
    }
    return out;
}

std::vector<std::string> hidings(const std::string& family, bool structural) {
    std::vector<std::string> out, singles;
    Random random(family, 0);
    const System plain = build(family, {}, random);
    if (structural) {
        for (const std::string& name : structural_effects()) {
            for (int index = 0; index < 8; ++index) {
                if (structural_effect(name, plain, index, plain.typical, random))
                    out.push_back(name + "@" + std::to_string(index));
            }
        }
        for (std::size_t q = 0; q < plain.quantities.size(); ++q) {
            if (plain.quantities[q].may_be_declared_wrong()) out.push_back("parameter_error@" + std::to_string(q));
        }
        return out;
    }
    bool mechanical = false;
    for (const Slot& s : plain.slots) mechanical = mechanical || s.kind == Kind::torque || s.kind == Kind::force;
    out.push_back("none");
    if (mechanical) out.push_back("none_process");
    out.push_back("none_coloured");
    std::vector<std::string> names = term_effects();
    names.insert(names.end(), always_alone.begin(), always_alone.end());
    for (const std::string& name : names) {
        if (needs_wish(name) && family == "mb") continue;  // its model has no such term to leave out
        const System system = build(family, {name, false}, random);
        for (int slot = 0; slot < static_cast<int>(system.slots.size()); ++slot) {
            if (effect(name, system, slot, system.typical, random)) singles.push_back(name + "@" + std::to_string(slot));
        }
    }
    out.insert(out.end(), singles.begin(), singles.end());
    // Pairs: the first with the last and so on, no two of one name, none that changes the model text.
    std::vector<std::string> plainly;
    for (const std::string& s : singles) {
        const std::string name = parts(s, '@')[0];
        if (!needs_wish(name) && name != "gravity_sin" && std::count(always_alone.begin(), always_alone.end(), name) == 0)
            plainly.push_back(s);
    }
    for (std::size_t i = 0; i + 1 < plainly.size(); i += 2) {
        const std::size_t j = plainly.size() - 1 - i / 2;
        if (j != i && parts(plainly[i], '@')[0] != parts(plainly[j], '@')[0]) out.push_back(plainly[i] + "+" + plainly[j]);
    }
    if (family == "dc" || family == "rl") out.push_back("one_speed");
    return out;
}

}  // namespace algest::gap
