// SPDX-License-Identifier: GPL-3.0-or-later
// An estimator of the bare runtime, made by hand: two unknowns, two rows, three signals, no generator.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "algest/estimator.hpp"

namespace algest::test {

constexpr int small_signals = 3;
constexpr int small_rows = 2;
constexpr int small_unknowns = 2;

/// theta_0 a_r[x0] + theta_1 b_r[x1] = c_r[x2], r = 0, 1, over `samples` samples. Weights without a meaning, none of them alike.
template <class S>
struct SmallData {
    std::vector<S> tables;
    std::vector<Functional> functionals;
    std::vector<Term<S>> terms;
    std::vector<NoiseChannel<S>> noise;   ///< of one raw signal, which enters the first two; what it does to the second moves with the third
    Blueprint<S> blueprint;

    SmallData(Solve solve, int samples, int instants, S keep = S(1), double factor = 1.0, bool noisy = false) {
        if (noisy) noise = {{0, 0, no_partial, 0, S(0.01)}, {0, 1, 2, 0, S(0.02)}};
        for (int t = 0; t < 2 * small_signals; ++t) {
            for (int k = 0; k < samples; ++k) tables.push_back(S(((k * 37 + t * 101 + 11) % 64 - 30.5) / 64.0));
        }
        for (int r = 0; r < small_rows; ++r) {
            for (int s = 0; s < small_signals; ++s) {
                const int f = r * small_signals + s;
                functionals.push_back(
                    {static_cast<std::uint16_t>(f), static_cast<std::uint16_t>(s), static_cast<std::uint16_t>(f), 1});
                terms.push_back(
                    {static_cast<std::uint16_t>(r), static_cast<std::uint16_t>(s), S(factor * (1.0 + 0.25 * f))});
            }
        }
        blueprint = {{samples,
                      small_signals,
                      small_rows,
                      small_unknowns,
                      {tables.data(), static_cast<int>(tables.size())},
                      {functionals.data(), static_cast<int>(functionals.size())},
                      {terms.data(), static_cast<int>(terms.size())}},
                     solve,
                     instants,
                     keep,
                     S(1e12),
                     kept_samples(solve, instants, noisy, false),
                     {noisy ? 1 : 0, {noise.data(), static_cast<int>(noise.size())}},
                     S(0),
                     {},
                     {},
                     {}};
    }
    SmallData(const SmallData&) = delete;
    SmallData& operator=(const SmallData&) = delete;
};

/// One instance; copies are independent.
template <class S>
class SmallEstimator {
public:
    explicit SmallEstimator(const SmallData<S>& data) : blueprint_(&data.blueprint) {
        const Blueprint<S>& b = *blueprint_;
        const auto sized = [](int n) { return std::vector<S>(static_cast<std::size_t>(n), S(0)); };
        rings_ = sized(ring_scalars(small_signals, ring_length(b.rows.samples, b.kept)));
        sums_ = sized(sum_scalars(b.solve, small_unknowns, b.solve_instants));
        published_ = sized(published_scalars(b.solve, small_unknowns));
        reset();
    }
    void reset() { algest::reset(*blueprint_, memory()); }
    /// nullptr: a sample that is refused.
    void push(const S* sample) {
        std::array<S, push_scratch(small_rows, small_unknowns)> scratch{};
        algest::push(*blueprint_, memory(), sample, scratch.data());
    }
    void prime() { algest::prime(memory()); }
    Latest<S> estimate(std::array<S, small_unknowns>& lumped) {
        std::array<S, estimate_scratch(small_rows, small_unknowns)> scratch{};
        return algest::estimate(*blueprint_, memory(), scratch.data(), lumped.data());
    }
    /// Covariance (packed) and bias; instants: of S(t).
    Latest<S> uncertainty(std::array<S, packed_size(small_unknowns)>& covariance, std::array<S, small_unknowns>& bias) {
        std::vector<S> scratch(static_cast<std::size_t>(uncertainty_scratch(small_rows, small_unknowns, blueprint_->solve_instants)));
        std::array<S, small_unknowns> lumped{};
        return algest::uncertainty(*blueprint_, memory(), scratch.data(), lumped.data(), covariance.data(), bias.data());
    }

private:
    Memory<S> memory() { return {rings_.data(), sums_.data(), published_.data(), &progress_}; }

    const Blueprint<S>* blueprint_;
    std::vector<S> rings_, sums_, published_;
    Progress progress_{};
};

/// Samples without an end, none of them alike.
inline std::array<double, small_signals> small_sample(unsigned k) {
    const auto value = [k](unsigned signal) {
        unsigned x = k * 2654435761U + signal * 40503U + 12345U;
        x ^= x >> 15U;
        x *= 2246822519U;
        x ^= x >> 13U;
        return static_cast<double>(x % 20011U) / 10000.0 - 1.0;
    };
    return {value(0), value(1), value(2)};
}

}  // namespace algest::test
