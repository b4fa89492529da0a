// SPDX-License-Identifier: GPL-3.0-or-later
// A unit that was put together from others, spelled as a person would.
#pragma once
#include <string>

namespace algest::units {

/// Products of powers with one stroke: N.m/((rad)/s)^2 becomes N.m.s^2/rad^2, and what cancels is left out. As it is where the text is no
/// product of names and whole powers, or where UDUNITS does not read the two alike. Cost: a few conversions of UDUNITS.
std::string tidy(const std::string& unit);

}  // namespace algest::units
