// SPDX-License-Identifier: GPL-3.0-or-later
// The templates, embedded in the program when it is built.
#pragma once
#include <string_view>

namespace algest::generator {

/// Text of a file under templates/, e.g. "cpp/estimator.hpp.mustache"; data() is null if there is none.
std::string_view template_text(std::string_view path);

}  // namespace algest::generator
