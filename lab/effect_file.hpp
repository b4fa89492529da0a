// SPDX-License-Identifier: GPL-3.0-or-later
// One effect file, read and checked. An effect that is unsound would never fit any equation, and nobody would learn why.
#pragma once
#include <optional>
#include <string>

#include "generator/diagnostics.hpp"
#include "lab/effect.hpp"

namespace algest::lab {

/// The effect of a file. Every complaint, with its place, goes to `diagnostics`; nullopt after one.
std::optional<Effect> read_effect(const std::string& path, Diagnostics& diagnostics);

}  // namespace algest::lab
