// SPDX-License-Identifier: MIT-0
// Instructions between two readings of the board's first timer. Under `-icount shift=10` one instruction takes 1024 ns of the emulated clock, and
// the timer counts down at 25 MHz: 25.6 ticks. These are instructions under emulation, not cycles.
#pragma once
#include <cstdint>

namespace board {

class Instructions {
public:
    /// Finds what a reading itself costs.
    Instructions() {
        reload() = 0xFFFFFFFF;
        value() = 0xFFFFFFFF;
        control() = 1;
        std::uint32_t least = 0xFFFFFFFF;
        for (int k = 0; k < 16; ++k) {
            const std::uint32_t start = ticks();
            const std::uint32_t taken = start - ticks();
            if (taken < least) least = taken;
        }
        overhead_ = least;
    }
    static std::uint32_t ticks() {
        asm volatile("" ::: "memory");
        const std::uint32_t now = value();
        asm volatile("" ::: "memory");
        return now;
    }
    /// From `start`, a former ticks(), to now.
    std::uint32_t since(std::uint32_t start) const {
        const std::uint32_t taken = start - ticks();
        return ((taken - overhead_) * 5 + 64) / 128;
    }

private:
    static volatile std::uint32_t& control() { return *reinterpret_cast<volatile std::uint32_t*>(0x40000000); }
    static volatile std::uint32_t& value() { return *reinterpret_cast<volatile std::uint32_t*>(0x40000004); }
    static volatile std::uint32_t& reload() { return *reinterpret_cast<volatile std::uint32_t*>(0x40000008); }

    std::uint32_t overhead_;
};

}  // namespace board
