// SPDX-License-Identifier: MIT-0
// On the board: reads the samples in input.bin, feeds them to the estimator, writes the answers to output.bin and the instructions of each call
// to counts.bin. Exits with 0, or with the number of what went wrong.
#include "instructions.hpp"
#include "semihosting.hpp"
#include "steps.hpp"

namespace {

constexpr unsigned most_samples = 12000;
Estimator::Sample samples[most_samples];
Answer answers[most_samples];
Estimator estimator;

/// Instructions of the calls of one sample.
struct Count {
    std::uint32_t push;
    std::uint32_t estimate;
};
Count counts[most_samples];

/// A loop of known length, 2 n instructions and a few more: the counter is what it says it is.
bool counter_is_right(const board::Instructions& instructions) {
    constexpr std::uint32_t rounds = 5000;
    const std::uint32_t start = instructions.ticks();
    std::uint32_t k = rounds;
    asm volatile("1: subs %0, #1\n bne 1b" : "+l"(k) : : "cc");
    const std::uint32_t counted = instructions.since(start);
    return counted >= 2 * rounds && counted < 2 * rounds + 20;
}

__attribute__((noinline)) void push(const Estimator::Sample& sample) { estimator.push(sample); }
__attribute__((noinline)) Estimator::Estimate estimate() { return estimator.estimate(); }

/// `file` as board::open gives it.
bool write_and_close(int file, const void* from, std::uint32_t bytes) {
    const bool written = file >= 0 && board::write(file, from, bytes) == 0;
    board::close(file);
    return written;
}

}  // namespace

int main() {
    const int input = board::open("input.bin", 1);
    if (input < 0) board::exit(2);
    const std::uint32_t left = static_cast<std::uint32_t>(board::read(input, samples, sizeof samples));
    const unsigned count = (sizeof samples - left) / sizeof samples[0];
    if (count == 0 || left == 0) board::exit(3);
    const board::Instructions instructions;
    if (!counter_is_right(instructions)) board::exit(4);
    for (unsigned k = 0; k < count; ++k) {
        std::uint32_t start = instructions.ticks();
        push(samples[k]);
        counts[k].push = instructions.since(start);
        start = instructions.ticks();
        const Estimator::Estimate found = estimate();
        counts[k].estimate = instructions.since(start);
        answers[k] = answer(found);
    }
    if (!write_and_close(board::open("output.bin", 5), answers, count * sizeof answers[0])) board::exit(5);
    if (!write_and_close(board::open("counts.bin", 5), counts, count * sizeof counts[0])) board::exit(6);
    board::exit(0);
}
