// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: any bytes as a model file. Either it is refused with an error, or it is sound: then the system that simulates it is built too.
#include <cstdlib>

#include "generator/model.hpp"
#include "lab/ode_system.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace algest;
    Diagnostics diagnostics;
    const auto model = model::read_from_text(fuzz::text_of(data, size), "fuzz.toml", false, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) (void)d.text();
    if (model.has_value() == diagnostics.has_errors()) std::abort();
    if (model) (void)lab::ode_system(*model, diagnostics);
    return 0;
}
