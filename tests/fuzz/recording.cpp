// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: any bytes as a recording, plain or gzipped; the first one chooses how it is read. What is accepted is finite and of one length.
// MATLAB files are left out: libmatio allocates what a damaged file promises, so that the target would look for faults of the library.
#include "lab/recording.hpp"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "tests/fuzz/fuzz.hpp"

namespace {

using namespace algest;

/// A file of this process, written anew for each input.
std::string file_name() { return "/tmp/algest-fuzz-" + std::to_string(::getpid()) + ".csv"; }

void check(const lab::Recording& recording) {
    if (recording.samples() < 2 || !(recording.period > 0)) std::abort();
    for (const lab::Column& column : recording.columns) {
        if (column.values.size() != recording.samples()) std::abort();
        for (const double v : column.values) if (!std::isfinite(v)) std::abort();
    }
    for (std::size_t k = 1; k < recording.samples(); ++k) if (!(recording.t[k] > recording.t[k - 1])) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    constexpr std::array<lab::CsvStyle, 4> styles = {{{',', '.'}, {';', '.'}, {';', ','}, {'\t', ','}}};
    const std::string file = file_name();
    std::ofstream(file, std::ios::binary) << fuzz::text_of(data + 1, size - 1);
    Diagnostics diagnostics;
    const auto time = (data[0] & 4U) != 0 ? lab::TimeBase::increasing : lab::TimeBase::uniform;
    const auto recording = lab::read_recording(file, diagnostics, styles[data[0] & 3U], time);
    if (recording.has_value() == diagnostics.has_errors()) std::abort();
    if (recording) check(*recording);
    ::unlink(file.c_str());
    return 0;
}
