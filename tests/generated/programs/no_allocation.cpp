// SPDX-License-Identifier: GPL-3.0-or-later
// Feeds one generated class all kinds of samples, with every way to get memory replaced by one that ends the program with
// exit code 1 while the class is at work. With an argument it allocates on purpose, to show that it would be seen.
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <limits>
#include <new>

#include HEADER

#if HELD > 1
#include "../../../examples/sensorless_motor/equilibrium.hpp"
#endif
#include "uncertainty_status.hpp"

using Class = algest::generated::MODEL;
using Scalar = Class::Scalar;

namespace {

volatile bool forbidden = false;

void used(const char* what) {
    if (!forbidden) return;
    forbidden = false;
    ssize_t ignored = write(2, what, strlen(what));
    ignored = write(2, " was called\n", 12);
    static_cast<void>(ignored);
    _exit(1);
}

}  // namespace

// The C library calls these, too: a static pool serves whatever else the program needs.
alignas(64) static unsigned char pool[1 << 20];
static size_t taken = 0;

static void* from_pool(size_t alignment, size_t size) {
    taken = (taken + alignment - 1) / alignment * alignment;
    if (size > sizeof pool - taken) return nullptr;
    void* out = pool + taken;
    taken += size;
    return out;
}

extern "C" {
void* malloc(size_t size) noexcept { return used("malloc"), from_pool(16, size); }
void* calloc(size_t n, size_t size) noexcept { return used("calloc"), from_pool(16, n * size); }   // the pool is zero
void* realloc(void* old, size_t size) noexcept {
    used("realloc");
    void* out = from_pool(16, size);
    if (old != nullptr && out != nullptr) memmove(out, old, size);
    return out;
}
void free(void*) noexcept { used("free"); }
void* aligned_alloc(size_t alignment, size_t size) noexcept { return used("aligned_alloc"), from_pool(alignment, size); }
void* memalign(size_t alignment, size_t size) noexcept { return used("memalign"), from_pool(alignment, size); }
int posix_memalign(void** out, size_t alignment, size_t size) noexcept {
    used("posix_memalign");
    *out = from_pool(alignment, size);
    return *out != nullptr ? 0 : ENOMEM;
}
}

void* operator new(size_t size) { return used("operator new"), from_pool(16, size); }
void* operator new[](size_t size) { return used("operator new[]"), from_pool(16, size); }
void* operator new(size_t size, std::align_val_t a) { return used("operator new"), from_pool(static_cast<size_t>(a), size); }
void* operator new[](size_t size, std::align_val_t a) { return used("operator new[]"), from_pool(static_cast<size_t>(a), size); }
void operator delete(void*) noexcept { used("operator delete"); }
void operator delete[](void*) noexcept { used("operator delete[]"); }
void operator delete(void*, size_t) noexcept { used("operator delete"); }
void operator delete[](void*, size_t) noexcept { used("operator delete[]"); }
void operator delete(void*, std::align_val_t) noexcept { used("operator delete"); }
void operator delete[](void*, std::align_val_t) noexcept { used("operator delete[]"); }
void operator delete(void*, size_t, std::align_val_t) noexcept { used("operator delete"); }
void operator delete[](void*, size_t, std::align_val_t) noexcept { used("operator delete[]"); }

namespace {

Class estimator;

constexpr int inputs = sizeof(Class::Sample) / sizeof(Scalar);
int seen[4];
unsigned state = 1;

/// A number without order in [0, 1).
Scalar rough() {
    state = state * 1664525U + 1013904223U;
    return static_cast<Scalar>(state >> 8U) / static_cast<Scalar>(1U << 24U);
}

#if HELD > 1
/// Operating points of the motor: of others, residuals are larger than tolerances explain, and no estimate is ok.
void operating_point(int n, Scalar* values) {
    const sensorless_motor::OperatingPoint p = sensorless_motor::controlled({}, n % 2 == 0 ? 2 + n * 3 % 11 : 40 - n * 5 % 11, 1.5 + 0.5 * (n % 4), 0);
    const double at_angle_zero[inputs] = {p.v_f, p.v_g, p.i_f, p.i_g, 0, p.omega};
    for (int i = 0; i < inputs; ++i) values[i] = static_cast<Scalar>(at_angle_zero[i]);
}
#endif

Class::Sample sample(int k, int kind) {
    Class::Sample out;
    Scalar values[inputs];
    for (int i = 0; i < inputs; ++i) {
        const Scalar phase = (Scalar(0.011) + Scalar(0.0073) * static_cast<Scalar>(i)) * static_cast<Scalar>(k / HELD * HELD);
        values[i] = Scalar(MIDDLE) + Scalar(SIZE) * (std::sin(phase) + Scalar(0.3) * std::cos(Scalar(2.9) * phase) + (HELD > 1 ? Scalar(0) : Scalar(0.05) * rough()));
        if (kind == 1) values[i] = Scalar(0);
        if (kind == 2) values[i] = rough() < Scalar(0.5) ? std::numeric_limits<Scalar>::max() : std::numeric_limits<Scalar>::denorm_min();
        if (kind == 3 && rough() < Scalar(0.1)) values[i] = std::numeric_limits<Scalar>::quiet_NaN();
    }
#if HELD > 1
    if (kind == 0) operating_point(k / HELD, values);
#endif
    memcpy(&out, values, sizeof out);
    return out;
}

}  // namespace

int main(int argc, char**) {
    const int rounds = 8000;   // the longest window is 3001 samples
    for (int kind = 0; kind < 4; ++kind) {
        forbidden = true;
        estimator.reset();
        forbidden = false;
        for (int k = 0; k < rounds; ++k) {
            const Class::Sample s = sample(k, kind);
            forbidden = true;
            Class::Estimate e{};
            if (k % 5 == 0) {
                e = estimator.step(s);
            } else {
                estimator.push(s);
                if (k % 5 == 1) e = estimator.estimate();
                if (k % 500 == 2) e.status = generated_test::uncertainty_status(estimator);
            }
            forbidden = false;
            ++seen[static_cast<int>(e.status)];
        }
        if (argc > 1) {
            forbidden = true;
            void* volatile memory = argc == 2 ? malloc(10) : ::operator new(10);
            forbidden = false;
            printf("%p was given\n", memory);
        }
    }
    printf("filling %d, ok %d, singular %d, rejected %d\n", seen[0], seen[1], seen[2], seen[3]);
    return seen[0] > 0 && seen[1] > 0 && seen[2] > 0 && seen[3] > 0 ? 0 : 2;
}
