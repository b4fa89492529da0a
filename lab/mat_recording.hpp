// SPDX-License-Identifier: GPL-3.0-or-later
// A recording in a MATLAB file (version 4, 5 or 7.3).
#pragma once
#include <optional>
#include <string>

#include "generator/diagnostics.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// What read_recording says of .mat files.
std::optional<Recording> read_mat_recording(const std::string& path, TimeBase time, Diagnostics& diagnostics);

}  // namespace algest::lab
