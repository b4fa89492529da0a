// SPDX-License-Identifier: MIT-0
// What an estimator says of its own answer.
#pragma once
#include <cstdint>

namespace algest {

enum class Status : std::uint8_t {
    filling,   ///< a window is not yet full; the values are the last good ones, or the initial ones
    ok,        ///< the values follow from the windows as they are now
    singular,  ///< the rows cannot tell the parameters apart now; the last good values are held
    rejected   ///< the newest sample was not finite or outside its limits; the windows restart
};

/// The status in words; static text, never null.
constexpr const char* name(Status status) noexcept {
    switch (status) {
        case Status::filling: return "filling";
        case Status::ok: return "ok";
        case Status::singular: return "singular";
        case Status::rejected: return "rejected";
    }
    return "?";
}

}  // namespace algest
