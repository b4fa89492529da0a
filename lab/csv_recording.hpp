// SPDX-License-Identifier: GPL-3.0-or-later
// A recording in a CSV file, which may be gzipped.
#pragma once
#include <optional>
#include <string>

#include "generator/diagnostics.hpp"
#include "lab/recording.hpp"

namespace algest::lab {

/// What read_recording says of text files.
std::optional<Recording> read_csv_recording(const std::string& path, const CsvStyle& style, TimeBase time, Diagnostics& diagnostics);

}  // namespace algest::lab
