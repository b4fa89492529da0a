// SPDX-License-Identifier: GPL-3.0-or-later
// Where the declared noise of the sensors enters the windows, and whether that suffices for what the model asks of it.
#pragma once
#include <string>
#include <vector>

#include "generator/tape_builder.hpp"

namespace algest::generator {

/// A channel per noisy input, window signal that it enters and sample of delay (24 of them by the parabola filter): the partial derivative is in the factor where it is constant, else a ring of its
/// own beside the windows.
struct NoiseChannels {
    struct Partial {
        int operation;   ///< of the tape
        int signal;      ///< window signal and input that it was first needed for
        int input;
    };
    std::vector<plan::NoiseChannel> channels;   ///< sorted by input
    std::vector<Partial> partials;
    std::string through_a_filter;               ///< a noisy signal whose derivative by the parabola filter decimated windows hold: then no channels; else empty
};

/// input_of_signal: by the model's signals, -1: no input; inputs stand in the order of the signals, `past` behind them. window_operations: of the
/// tape, by window signal. In a decimated plan a lag counts whole means.
NoiseChannels noise_channels(const model::Model& model, const std::vector<int>& input_of_signal, const std::vector<plan::PastInput>& past,
                             const std::vector<int>& window_operations, plan::Scalar scalar, TapeBuilder& tape);

/// Completes the plan: drops what changes nothing, with a note. Complains and answers false where whitening, a deviation limit or uncertainty() was
/// asked for and cannot be had.
bool noise_suffices(const model::Model& model, const std::string& through_a_filter, plan::Plan& plan, Diagnostics& diagnostics);

}  // namespace algest::generator
