// SPDX-License-Identifier: GPL-3.0-or-later
// What is left beside a named effect: a law that the library does not hold bends what is named into its own shape, and leaves the rest.
#pragma once
#include <optional>
#include <string>

#include "lab/variant.hpp"

namespace algest::lab {

struct Remainder {
    std::string equation;
    std::string term;   ///< with its sign, as one would write it beside what is named
};

/// The plain law of a signal (power, sign, way, time) that the free run still misses beside what v holds, on every stretch alike: an effect that is
/// right leaves noise, and noise of the process itself takes another way on each stretch. Nullopt: there is none, or the effort did not last.
/// Cost: a weak form for each law, equation and window length; a run for each law and equation.
std::optional<Remainder> remainder(Workbench& bench, const Variant& v);

/// A plain law with one parameter that explains the validation rows as well as the several effects of `named`, or surely better than its one effect: the
/// machine has that law, and they imitate it. Nullopt: there is none. Cost: as above, and six fits.
std::optional<Remainder> plainer_law(Workbench& bench, const Variant& nominal, const Variant& named);

}  // namespace algest::lab
