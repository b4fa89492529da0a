// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/perturbation.hpp"

#include <algorithm>

#include "generator/annihilator.hpp"
#include "generator/kernel.hpp"

namespace algest::perturbation {

namespace {

using exact::Rational;

/// Row i (from 1) of the inverse of A, A(p, i) = integral of the kernel of row p, derivative 0, times sigma^(i-1)/(i-1)!. By elimination on
/// [A' | e_i]: the solution x has x' A = e_i'. A is regular: its rows are moments of distinct powers of 1-sigma under one weight.
std::vector<Rational> combination(int i, int n, int kappa) {
    const std::size_t size = static_cast<std::size_t>(kappa);
    std::vector<std::vector<Rational>> rows(size, std::vector<Rational>(size + 1, 0));
    for (int p = 1; p <= kappa; ++p) {
        const std::vector<Rational> row = annihilator::kernel(0, p, {n, 0});
        Rational factorial = 1;
        for (int c = 0; c < kappa; ++c) {
            if (c > 0) factorial = factorial * c;
            rows[static_cast<std::size_t>(c)][static_cast<std::size_t>(p - 1)] = kernel::moment(row, c) / factorial;
        }
    }
    rows[static_cast<std::size_t>(i - 1)][size] = 1;
    for (std::size_t k = 0; k < size; ++k) {
        std::size_t pivot = k;
        while (cln::zerop(rows[pivot][k])) ++pivot;
        std::swap(rows[k], rows[pivot]);
        for (std::size_t r = 0; r < size; ++r) {
            if (r == k || cln::zerop(rows[r][k])) continue;
            const Rational factor = rows[r][k] / rows[k][k];
            for (std::size_t c = k; c <= size; ++c) rows[r][c] = rows[r][c] - factor * rows[k][c];
        }
    }
    std::vector<Rational> out;
    for (std::size_t k = 0; k < size; ++k) out.push_back(rows[k][size] / rows[k][k]);
    return out;
}

}  // namespace

std::vector<Rational> kernel(int i, int l, int n, int kappa) {
    const std::vector<Rational> weight = combination(i, n, kappa);
    std::vector<Rational> out;
    for (int p = 1; p <= kappa; ++p) {
        const std::vector<Rational> row = annihilator::kernel(l, p, {n, 0});
        out.resize(std::max(out.size(), row.size()), 0);
        for (std::size_t k = 0; k < row.size(); ++k) out[k] = out[k] + weight[static_cast<std::size_t>(p - 1)] * row[k];
    }
    while (!out.empty() && cln::zerop(out.back())) out.pop_back();
    return out;
}

}  // namespace algest::perturbation
