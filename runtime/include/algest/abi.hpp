// SPDX-License-Identifier: MIT-0
// The runtime's ABI number, and the compiler flags under which its promises hold.
#pragma once

/// Raised when a generated header and the runtime no longer fit together. Generated code asserts it.
#define ALGEST_RUNTIME_ABI 2

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "algest: compile without -ffast-math and -ffinite-math-only: they delete the tests for NaN and infinity"
#endif
