// SPDX-License-Identifier: GPL-3.0-or-later
// F_{i,p}[f] of Delpoux, Floquet (000), equation (3) as errata.md corrects it, by its definition and Gauss-Legendre
// quadrature: knows nothing of the generator.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace algest::plants {

/// What a signal does between its samples.
enum class Between {
    held,    ///< keeps the value of the sample before
    linear,  ///< goes straight to the next sample
};

inline long double factorial(int n) { return n <= 1 ? 1.0L : static_cast<long double>(n) * factorial(n - 1); }

/// F_{i,p}[f](t) = sum_j c_ij integral over [0,t] of (t-tau)^gamma (-tau)^j / gamma! f(tau), with
/// c_ij = C(kappa+n, j) (kappa+i)! / (i+j-n)! and gamma = kappa+2n+p-i-j-1; samples[0] at 0, the last one at t.
/// The Gauss-Legendre rule of 5 points is exact up to degree 9 within each sample: all that occurs here.
inline long double functional(int n, int kappa, int i, int p, const std::vector<double>& samples, long double period,
                              Between between) {
    static const std::array<long double, 5> node{0.0L, -0.538469310105683091036L, 0.538469310105683091036L,
                                                 -0.906179845938663992798L, 0.906179845938663992798L};
    static const std::array<long double, 5> weight{0.568888888888888888889L, 0.478628670499366468042L,
                                                   0.478628670499366468042L, 0.236926885056189087514L,
                                                   0.236926885056189087514L};
    const std::size_t intervals = samples.size() - 1;
    const long double t = static_cast<long double>(intervals) * period;
    long double sum = 0.0L;
    for (std::size_t k = 0; k < intervals; ++k) {
        for (std::size_t g = 0; g < node.size(); ++g) {
            const long double part = 0.5L * (1.0L + node[g]);
            const long double tau = (static_cast<long double>(k) + part) * period;
            const long double f = between == Between::held ? static_cast<long double>(samples[k])
                                                           : (1.0L - part) * samples[k] + part * samples[k + 1];
            long double kernel = 0.0L;
            for (int j = n - i; j <= kappa + n; ++j) {
                const int gamma = kappa + 2 * n + p - i - j - 1;
                const long double choose = factorial(kappa + n) / factorial(j) / factorial(kappa + n - j);
                const long double c = choose * factorial(kappa + i) / factorial(i + j - n);
                kernel += c * std::pow(t - tau, static_cast<long double>(gamma)) *
                          std::pow(-tau, static_cast<long double>(j)) / factorial(gamma);
            }
            sum += 0.5L * period * weight[g] * kernel * f;
        }
    }
    return sum;
}

}  // namespace algest::plants
