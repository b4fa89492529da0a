// SPDX-License-Identifier: MIT-0
// A pointer with a length: static arrays in generated code, vectors on the host.
#pragma once

namespace algest {

template <class T>
struct View {
    const T* data;
    int size;
    constexpr const T& operator[](int i) const noexcept { return data[i]; }
    constexpr const T* begin() const noexcept { return data; }
    constexpr const T* end() const noexcept { return data + size; }
};

}  // namespace algest
