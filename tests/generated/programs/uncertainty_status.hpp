// SPDX-License-Identifier: GPL-3.0-or-later
// uncertainty() of a class that has it: of a model that declares noise.
#pragma once

namespace generated_test {

template <class C>
auto status(C& c, int) -> decltype(c.uncertainty().status) {
    return c.uncertainty().status;
}
template <class C>
auto status(C& c, long) -> decltype(c.estimate().status) {
    return c.estimate().status;
}

/// Status of uncertainty(), or of estimate() where the class has no such member.
template <class C>
auto uncertainty_status(C& c) {
    return status(c, 0);
}

}  // namespace generated_test
