// SPDX-License-Identifier: 0BSD
// A transfer function of q: its value on the imaginary axis, its poles and zeros, and its run sample by sample.
#pragma once
#include <algest/transfer_function.hpp>

#include <complex>
#include <vector>

namespace drive_train {

/// (1 - q/Omega0)^hidden numerator(q) / denominator(q), lowest powers first.
struct Transfer {
    std::vector<double> numerator;
    std::vector<double> denominator;
    int hidden;
};

inline double omega0(double period) { return 2.0 / period; }

inline std::complex<double> value(const std::vector<double>& polynomial, std::complex<double> q) {
    std::complex<double> out = 0.0;
    for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) out = out * q + *c;
    return out;
}

/// At q = i Omega, Omega in rad/s.
inline std::complex<double> response(const Transfer& of, double Omega, double period) {
    const std::complex<double> q(0.0, Omega);
    return std::pow(1.0 - q / omega0(period), of.hidden) * value(of.numerator, q) / value(of.denominator, q);
}

inline std::vector<std::complex<double>> roots(const std::vector<double>& polynomial) {
    std::vector<std::complex<double>> out(polynomial.size() - 1);
    if (!out.empty()) algest::polynomial_roots(polynomial.data(), static_cast<int>(out.size()), out.data());
    return out;
}

/// A transfer function, run once a period from rest: q = Omega0 (z-1)/(z+1) makes it a difference equation, without approximation.
class Filter {
public:
    Filter(const Transfer& of, double period) : degree_(static_cast<int>(of.denominator.size()) - 1) {
        std::vector<double> above = of.numerator;
        for (int k = 0; k < of.hidden; ++k) above = times(above, {1.0, -1.0 / omega0(period)});
        above.resize(of.denominator.size(), 0.0);
        numerator_ = in_z(above, period);
        denominator_ = in_z(of.denominator, period);
        state_.assign(of.denominator.size(), 0.0);
    }

    double step(double x) {
        const std::size_t n = static_cast<std::size_t>(degree_);
        const double y = (state_[0] + numerator_[n] * x) / denominator_[n];
        for (std::size_t k = 0; k < n; ++k) state_[k] = state_[k + 1] + numerator_[n - 1 - k] * x - denominator_[n - 1 - k] * y;
        return y;
    }

private:
    static std::vector<double> times(const std::vector<double>& a, const std::vector<double>& b) {
        std::vector<double> out(a.size() + b.size() - 1, 0.0);
        for (std::size_t i = 0; i < a.size(); ++i) for (std::size_t j = 0; j < b.size(); ++j) out[i + j] += a[i] * b[j];
        return out;
    }

    std::vector<double> in_z(std::vector<double> in_q, double period) const {
        double power = 1.0;
        for (double& c : in_q) {
            c *= power;
            power *= omega0(period);
        }
        std::vector<double> out(in_q.size());
        algest::substitute_bilinear(in_q.data(), degree_, -1.0, 1.0, out.data());
        return out;
    }

    int degree_;
    std::vector<double> numerator_, denominator_;   // in z, lowest power first
    std::vector<double> state_;                     // direct form II, transposed; the last entry stays 0
};

}  // namespace drive_train
