// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/progress.hpp"

#include <cstdio>
#include <utility>

#include "cli/messages.hpp"

namespace algest::cli {

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)), on_terminal_(is_terminal(stderr)), next_(Clock::now() + std::chrono::seconds(1)) {}

ProgressLine::~ProgressLine() {
    if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(double share) {
    if (!on_terminal_ || Clock::now() < next_) return;
    next_ = Clock::now() + std::chrono::milliseconds(100);
    std::fprintf(stderr, "\r%s: %.0f %%", what_.c_str(), 100.0 * share);
    std::fflush(stderr);
    shown_ = true;
}

}  // namespace algest::cli
