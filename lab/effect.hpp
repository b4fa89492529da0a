// SPDX-License-Identifier: GPL-3.0-or-later
// A physical effect, as its file says it (models/effects/*.toml; every key: docs/discover.md).
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/diagnostics.hpp"

namespace algest::lab {

/// A parameter that an effect brings; `{equation}` and `{role}` in the unit stand for the units of what they are bound to.
struct EffectParameter {
    std::string name;
    std::string unit;
    std::optional<double> min;
};

/// A number that is scanned, since the term is not linear in it.
struct EffectScan {
    std::string name;
    std::string unit;
    double from;
    double to;
    double step;
    bool spectrum;   ///< instead: the strongest lines of the residual's spectrum, in rad/s
};

struct Rival {
    std::string name;
    std::string experiment;   ///< that tells the two apart
};

struct Effect {
    std::string name;
    Position at;                                 ///< of the name
    std::vector<std::string> aliases;
    std::string summary;
    std::string shows;
    std::string reference;
    std::vector<std::string> units;              ///< of equations that it may enter
    bool together = false;                       ///< it enters all equations of that unit at once, with one value
    std::map<std::string, std::string> roles;    ///< placeholder -> kind (lab/roles.hpp)
    std::string term;                            ///< with placeholders, as it is added beside the driving terms
    std::string d_term;                          ///< in the d equation of a rotating frame, {d} {q} {angle} standing for currents and
    std::string q_term;                          ///< electrical angle; empty: as any other equation
    std::vector<EffectParameter> parameters;
    std::vector<EffectScan> scans;               ///< at most one
    std::vector<Rival> rivals;
    bool outside = false;                        ///< it hangs on nothing in the model: no rival of an effect that does
};

}  // namespace algest::lab
