// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzz targets share: libFuzzer's entry, and the bytes as text.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace algest::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) { return size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(data), size); }

}  // namespace algest::fuzz
