// SPDX-License-Identifier: GPL-3.0-or-later
// What an equation of a model moves, and which formulas may stand for the roles of an effect in it.
#pragma once
#include <string>
#include <vector>

#include "generator/model.hpp"
#include "generator/units.hpp"

namespace algest::lab {

/// The signal that an equation moves: that of its first highest derivative, with the order; -1: none.
struct Moved {
    int signal = -1;
    int order = 0;
};
Moved moved(const model::Model& model, const model::Equation& equation);

/// What an equation balances, told by what it moves, whatever it was divided by: N.m where it accelerates a rotation, N a translation (or
/// what a sensor in volts, or of no unit, shows of a motion of second order), V where it drives a current, W where it heats; empty: nothing of these.
std::string balanced(const model::Model& model, const model::Equation& equation);

/// The signal x with an equation der(x) = speed; -1: there is none.
int integral_of(const model::Model& model, int speed);

/// True when a unit is known and has the dimension of `wanted`.
bool fits(const units::Unit& unit, const std::string& wanted);

/// The column of a recording that holds its time.
constexpr const char* time_column = "t";

/// The signal that stands for time: the model's own, else a name that is free for one.
std::string time_name(const model::Model& model);

/// A kind of role, and the units that what stands for it may have; empty: any.
struct RoleKind {
    std::string name;
    std::vector<std::string> units;
};
/// All there are; docs/discover.md says what may stand for each.
const std::vector<RoleKind>& role_kinds();

/// True for a kind that stands for an axis or a quantity of a rotating frame (lab/rotating_frame.hpp).
bool is_of_a_frame(const std::string& kind);

/// A formula with its unit.
struct Filler {
    std::string formula;
    std::string unit;
};

/// Everything that may stand for a role of this kind in an equation. measured: by signal.
std::vector<Filler> fillers(const std::string& kind, const model::Model& model, std::size_t equation, const std::vector<bool>& measured);

}  // namespace algest::lab
