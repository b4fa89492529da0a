// SPDX-License-Identifier: MIT-0
// Upper triangles of symmetric or triangular matrices, packed row after row.
#pragma once

namespace algest {

/// Entries of the upper triangle of an n x n matrix.
constexpr int packed_size(int n) noexcept { return n * (n + 1) / 2; }

/// Index of entry (i, j), i <= j, of an n x n upper triangle packed row after row.
constexpr int packed_index(int n, int i, int j) noexcept { return i * n - i * (i - 1) / 2 + (j - i); }

}  // namespace algest
