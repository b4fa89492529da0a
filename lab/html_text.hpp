// SPDX-License-Identifier: GPL-3.0-or-later
// Any text as text of an HTML page.
#pragma once
#include <string>
#include <string_view>

namespace algest::lab {

/// & < > " ' escaped; fit for an element and for a quoted attribute.
std::string html_text(std::string_view text);

}  // namespace algest::lab
