// SPDX-License-Identifier: GPL-3.0-or-later
// One signal behind nine kernels of one degree, on moments: no estimator, no solve. Beside it the same functionals by their definition, weight
// by weight in long double.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "algest/moment_estimator.hpp"
#include "generator/annihilator.hpp"
#include "generator/kernel.hpp"
#include "generator/moment_rounding.hpp"
#include "generator/window_polynomial.hpp"

namespace algest::test {

/// Kernels of derivatives 0, 1, 2 in rows 1, 2, 3 of an equation of order degree/2 - 1; degree: 6, 8 or 10.
inline std::vector<kernel::Coefficients> nine_kernels(int degree) {
    std::vector<kernel::Coefficients> out;
    for (int p = 1; p <= 3; ++p) {
        for (int i = 0; i < 3; ++i) out.push_back(annihilator::kernel(i, p, {degree / 2 - 1, 0, 1}));
    }
    return out;
}

template <class A>
A accumulator(const exact::Rational& x);
template <>
inline double accumulator<double>(const exact::Rational& x) {
    return exact::nearest(x, plan::Scalar::float64);
}
template <>
inline Twofold<float> accumulator<Twofold<float>>(const exact::Rational& x) {
    const exact::TwoParts parts = exact::nearest_two(x, plan::Scalar::float32);
    return {static_cast<float>(parts.high), static_cast<float>(parts.low)};
}

struct Rule {
    plan::Hold hold;
    plan::Quadrature quadrature;
};

/// The nine functionals on moments, S the samples' scalar, A what is summed in.
template <class S, class A>
class MomentWindow {
public:
    MomentWindow(const std::vector<kernel::Coefficients>& kernels, int intervals, Rule rule) : samples_(static_cast<std::size_t>(intervals) + 1) {
        const exact::Rational step = kernel::coordinate_step(intervals);
        std::size_t count = 0;
        for (const kernel::Coefficients& k : kernels) count = std::max(count, k.size());
        for (std::size_t t = 0; t < kernels.size(); ++t) {
            kernel::WindowPolynomial p = kernel::window_polynomial(kernels[t], intervals, rule.hold, rule.quadrature, step);
            const plan::Scalar scalar = sizeof(S) == 8 ? plan::Scalar::float64 : plan::Scalar::float32;
            const exact::Rational gain = generator::rounding_gain(p, intervals, step, scalar, std::is_same_v<A, double> ? plan::Accumulators::float64 : plan::Accumulators::twofold);
            p.coefficients.resize(count, 0);
            for (const exact::Rational& c : p.coefficients) coefficients_.push_back(accumulator<A>(c));
            const auto s = [](const exact::Rational& x) { return static_cast<S>(exact::nearest(x, scalar)); };
            ends_.push_back({s(p.oldest), s(p.newest), s(kernel::integral(kernels[t], intervals, rule.hold, rule.quadrature)), s(gain), static_cast<int>(kernels[t].size()) - 1});
            const auto of = static_cast<std::uint16_t>(t);
            functionals_.push_back({of, 0, of, 1});
            terms_.push_back({static_cast<std::uint16_t>(of / row_entries_), static_cast<std::uint16_t>(of % row_entries_), S(1)});   // one entry each
        }
        degree_ = static_cast<unsigned char>(count - 1);
        set_ = {degree_, static_cast<S>(exact::nearest(step, plan::Scalar::float64)), {&degree_, 1}, {coefficients_.data(), static_cast<int>(coefficients_.size())}, {ends_.data(), static_cast<int>(ends_.size())}};
        rows_ = {intervals + 1, 1, (static_cast<int>(kernels.size()) + row_entries_ - 1) / row_entries_, row_entries_ - 1, {nullptr, 0}, {functionals_.data(), static_cast<int>(functionals_.size())}, {terms_.data(), static_cast<int>(terms_.size())}};
        accumulators_.resize(static_cast<std::size_t>(moment_accumulators<A>(1, set_.degree, false)));
        references_.resize(static_cast<std::size_t>(moment_references<A>(1)));
        sizes_.resize(references_.size());
        scratch_.resize(static_cast<std::size_t>(moment_scratch(1, set_.degree)));
        ring_.resize(samples_);
        matrix_.resize(static_cast<std::size_t>(row_entries(rows_.rows, rows_.unknowns)));
        entry_sizes_.resize(matrix_.size());
        restart();
    }
    MomentWindow(const MomentWindow&) = delete;
    MomentWindow& operator=(const MomentWindow&) = delete;

    void restart() { restart_moments(progress_); }
    void push(S x) {
        add_sample(set_, static_cast<int>(samples_) - 1, memory(), &x, &ring_[head_], scratch_.data());
        ring_[head_] = x;
        head_ = head_ + 1 == samples_ ? 0 : head_ + 1;
    }
    /// Of a full window, kernel by kernel.
    const S* evaluate() {
        evaluate_moment_rows(set_, rows_, memory(), &ring_[head_], &ring_[head_ == 0 ? samples_ - 1 : head_ - 1], scratch_.data(), RowSums<S>{matrix_.data(), entry_sizes_.data()});
        return matrix_.data();
    }
    /// Of a full window, by kernel.
    std::vector<S> values() {
        const S* matrix = evaluate();
        return {matrix, matrix + functionals_.size()};
    }
    /// Sample m of the window, 0 the oldest.
    S sample(std::size_t m) const { return ring_[(head_ + m) % samples_]; }

private:
    MomentMemory<S, A> memory() { return {accumulators_.data(), references_.data(), sizes_.data(), &progress_}; }

    static constexpr int row_entries_ = 3;   ///< rows of two unknowns

    std::size_t samples_;
    std::size_t head_ = 0;
    unsigned char degree_ = 0;
    MomentSet<S, A> set_{};
    RowSet<S> rows_{};
    MomentProgress progress_{};
    std::vector<A> coefficients_, accumulators_, scratch_;
    std::vector<WindowEnds<S>> ends_;
    std::vector<Functional> functionals_;
    std::vector<Term<S>> terms_;
    std::vector<S> references_, sizes_, ring_, matrix_, entry_sizes_;
};

/// Largest error of the moments against sums in long double, over the largest of those sums; both are kept by functional.
template <class S>
class Comparison {
public:
    Comparison(const std::vector<kernel::Coefficients>& kernels, int intervals, Rule rule) : error_(kernels.size()), largest_(kernels.size()) {
        for (const kernel::Coefficients& k : kernels) weights_.push_back(kernel::weights(k, intervals, rule.hold, rule.quadrature, plan::Scalar::float64));
    }
    template <class Window>
    void look(Window& window) {
        const std::vector<S> found = window.values();
        for (std::size_t t = 0; t < weights_.size(); ++t) {
            long double sum = 0.0L;
            for (std::size_t m = 0; m < weights_[t].size(); ++m) sum += static_cast<long double>(weights_[t][m]) * static_cast<long double>(window.sample(m));
            error_[t] = std::max(error_[t], std::abs(static_cast<long double>(found[t]) - sum));
            largest_[t] = std::max(largest_[t], std::abs(sum));
        }
    }
    double worst() const {
        long double out = 0.0L;
        for (std::size_t t = 0; t < error_.size(); ++t) out = std::max(out, error_[t] / largest_[t]);
        return static_cast<double>(out);
    }

private:
    std::vector<std::vector<double>> weights_;
    std::vector<long double> error_, largest_;
};

/// A signal without an end: two tones, a square wave and noise, of size 1.
inline double moment_signal(long k) {
    const double t = static_cast<double>(k);
    unsigned long x = static_cast<unsigned long>(k) * 6364136223846793005UL + 1442695040888963407UL;
    x ^= x >> 29U;
    x *= 0xBF58476D1CE4E5B9UL;
    x ^= x >> 32U;
    return 0.5 * std::sin(0.0031 * t) + 0.3 * std::cos(0.00047 * t) + (k / 700 % 2 == 0 ? 0.1 : -0.1) + 0.1 * (static_cast<double>(x % 20001UL) / 10000.0 - 1.0);
}

}  // namespace algest::test
