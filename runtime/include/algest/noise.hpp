// SPDX-License-Identifier: MIT-0
// How the noise of the sensors enters the rows: through the partial derivatives of the window signals, then through the known weights.
#pragma once
#include <cstdint>

#include "algest/rows.hpp"
#include "algest/view.hpp"
#include "algest/window.hpp"

namespace algest {

/// One way of a raw signal's noise into a window signal: its standard deviation times the partial derivative, which is constant and in
/// the factor, or what ring `partial` holds. Raw sample k enters the window signal's sample k + lag.
template <class S>
struct NoiseChannel {
    std::uint16_t input;     ///< which noisy raw signal
    std::uint16_t signal;    ///< window signal
    std::uint16_t partial;   ///< ring of the partial derivative; no_partial: constant
    std::uint16_t lag;       ///< 0; 1 in a model one sample late; more where the signal is delayed or filtered
    S factor;
};
constexpr std::uint16_t no_partial = 0xFFFF;

/// The declared noise: white, independent between signals and samples. inputs == 0: none is declared.
template <class S>
struct Noise {
    int inputs;
    View<NoiseChannel<S>> channels;
};

/// The largest lag of all channels, 1 at least: so many raw samples before a window may enter it.
template <class S>
inline int largest_lag(const Noise<S>& noise) noexcept {
    int out = 1;
    for (const NoiseChannel<S>& channel : noise.channels) {
        if (channel.lag > out) out = channel.lag;
    }
    return out;
}

/// Writes the change of the rows [P|Q] (matrix, as evaluate_rows) when raw sample `sample` of the window at `at` is one standard deviation
/// of `input` too large; sample may be as low as -largest_lag for what enters late. Cost: channels of the input x functionals.
template <class S>
inline void noise_in_rows(const RowSet<S>& set, const Noise<S>& noise, const S* rings, WindowPosition at, int input, int sample, S* matrix) noexcept {
    clear_rows(set, matrix);
    for (const NoiseChannel<S>& channel : noise.channels) {
        const int k = sample + channel.lag;
        if (channel.input != input || k < 0 || k >= set.samples) continue;
        const S size = channel.partial == no_partial ? channel.factor : channel.factor * window(rings, channel.partial, at)[k];
        for (const Functional& f : set.functionals) {
            if (f.table == no_table || f.signal != channel.signal) continue;
            add_functional(set, f, set.tables[static_cast<int>(f.table) * set.samples + k] * size, matrix);
        }
    }
}

/// What row r of [P|Q] says at theta: its residual P theta - Q.
template <class S>
inline S residual(const S* row, const S* theta, int unknowns) noexcept {
    S sum = -row[unknowns];
    for (int c = 0; c < unknowns; ++c) sum += row[c] * theta[c];
    return sum;
}

}  // namespace algest
