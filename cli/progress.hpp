// SPDX-License-Identifier: GPL-3.0-or-later
// A line on the terminal that says how far a long command is; nothing for the first second, nothing where no person reads.
#pragma once
#include <chrono>
#include <string>

namespace algest::cli {

class ProgressLine {
public:
    explicit ProgressLine(std::string what);
    ~ProgressLine();  ///< wipes the line
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `share` is done, 0 to 1. Cost: a clock reading; a write at most ten times a second.
    void show(double share);

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    bool on_terminal_;
    bool shown_ = false;
    Clock::time_point next_;
};

}  // namespace algest::cli
