// SPDX-License-Identifier: GPL-3.0-or-later
// Whether what is left of a gap has a shape: noise cannot be foretold, a missing effect can.
#pragma once
#include "lab/variant.hpp"

namespace algest::lab {

/// True when the residual of some equation on the training rows of a recording can be foretold from the signals and their past, on windows that the
/// rule was not fitted to, or stands in one spectral line.
bool structured(const Workbench& bench, const Variant& v);

}  // namespace algest::lab
