// SPDX-License-Identifier: MIT-0
// What the emulator does for the program on the board: files, text, the exit code (Arm semihosting, specification 2.0).
#pragma once
#include <cstdint>

namespace board {

inline int call(int operation, const void* arguments) {
    register int r0 asm("r0") = operation;
    register const void* r1 asm("r1") = arguments;
    asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

/// mode: 1 reads, 5 writes, both binary. Negative: there is no such file.
template <std::uint32_t size>
int open(const char (&path)[size], int mode) {
    const std::uint32_t arguments[] = {reinterpret_cast<std::uint32_t>(path), static_cast<std::uint32_t>(mode), size - 1};
    return call(0x01, arguments);
}
/// Bytes that could not be transferred.
inline int write(int file, const void* from, std::uint32_t bytes) {
    const std::uint32_t arguments[] = {static_cast<std::uint32_t>(file), reinterpret_cast<std::uint32_t>(from), bytes};
    return call(0x05, arguments);
}
inline int read(int file, void* to, std::uint32_t bytes) {
    const std::uint32_t arguments[] = {static_cast<std::uint32_t>(file), reinterpret_cast<std::uint32_t>(to), bytes};
    return call(0x06, arguments);
}
inline void close(int file) {
    const std::uint32_t arguments[] = {static_cast<std::uint32_t>(file)};
    (void)call(0x02, arguments);
}
[[noreturn]] inline void exit(int code) {
    const std::uint32_t arguments[] = {0x20026, static_cast<std::uint32_t>(code)};   // ADP_Stopped_ApplicationExit
    (void)call(0x20, arguments);
    for (;;) {
    }
}

}  // namespace board
