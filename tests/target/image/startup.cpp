// SPDX-License-Identifier: MIT-0
// What a bare-metal image needs besides the estimator: vectors, the start (memory, constructors), and the memory functions
// that a compiler may call even in freestanding code. There is no C library behind it; libm asks for __errno.
#include <cstddef>
#include <cstdint>

extern "C" {
extern std::uint32_t data_start[], data_end[], data_load[], bss_start[], bss_end[], stack_top[];
extern void (*const init_start[])();
extern void (*const init_end[])();
int main();

void* memcpy(void* to, const void* from, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) static_cast<char*>(to)[k] = static_cast<const char*>(from)[k];
    return to;
}
void* memset(void* to, int value, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) static_cast<char*>(to)[k] = static_cast<char>(value);
    return to;
}
void* memmove(void* to, const void* from, std::size_t size) {
    if (to < from) return memcpy(to, from, size);
    for (std::size_t k = size; k > 0; --k) static_cast<char*>(to)[k - 1] = static_cast<const char*>(from)[k - 1];
    return to;
}
int* __errno() {
    static int error;
    return &error;
}

[[noreturn]] void reset_handler() {
    *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88) |= 0xFU << 20;  // switch the floating-point unit on
    asm volatile("dsb\n isb" ::: "memory");
    std::uint32_t* from = data_load;
    for (std::uint32_t* to = data_start; to != data_end; ++to) *to = *from++;
    for (std::uint32_t* to = bss_start; to != bss_end; ++to) *to = 0;
    for (auto construct = init_start; construct != init_end; ++construct) (*construct)();
    main();
    for (;;) {
    }
}

__attribute__((section(".vectors"), used)) const void* const vectors[] = {stack_top, reinterpret_cast<void*>(reset_handler)};
}
