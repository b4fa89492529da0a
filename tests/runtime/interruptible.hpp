// SPDX-License-Identifier: GPL-3.0-or-later
// A scalar that calls back at a chosen operation: what an interrupt may do between any two of them, without threads.
#pragma once
#include <functional>
#include <limits>
#include <utility>

namespace algest::test {

class Interruptible {
public:
    /// At the operation of this number (multiplications and assignments count, from 0) `handler` is called once.
    static void arm(long at, std::function<void()> handler) {
        count() = 0;
        due() = at;
        handler_() = std::move(handler);
    }
    /// Operations since arm(), without those of the handler.
    static long operations() { return count(); }
    static void disarm() { due() = -1; }

    Interruptible() = default;
    Interruptible(double v) : v_(v) {}
    Interruptible(const Interruptible&) = default;
    Interruptible& operator=(const Interruptible& other) {
        tick();
        v_ = other.v_;
        return *this;
    }
    operator double() const { return v_; }

    Interruptible& operator+=(const Interruptible& o) { return v_ += o.v_, *this; }
    Interruptible& operator-=(const Interruptible& o) { return v_ -= o.v_, *this; }
    Interruptible& operator*=(const Interruptible& o) { return tick(), v_ *= o.v_, *this; }
    Interruptible& operator/=(const Interruptible& o) { return v_ /= o.v_, *this; }
    friend Interruptible operator-(const Interruptible& a) { return -a.v_; }

#define ALGEST_TEST_OPERATOR(op, before)                                                                 \
    friend Interruptible operator op(const Interruptible& a, const Interruptible& b) {                   \
        before;                                                                                          \
        return a.v_ op b.v_;                                                                             \
    }                                                                                                    \
    friend Interruptible operator op(const Interruptible& a, double b) { return a op Interruptible(b); } \
    friend Interruptible operator op(double a, const Interruptible& b) { return Interruptible(a) op b; }
    ALGEST_TEST_OPERATOR(+, )
    ALGEST_TEST_OPERATOR(-, )
    ALGEST_TEST_OPERATOR(*, tick())
    ALGEST_TEST_OPERATOR(/, )
#undef ALGEST_TEST_OPERATOR

private:
    static long& count() {
        static long value = 0;
        return value;
    }
    static long& due() {
        static long value = -1;
        return value;
    }
    static std::function<void()>& handler_() {
        static std::function<void()> value;
        return value;
    }
    static void tick() {
        const long now = count();
        ++count();
        if (now != due()) return;
        due() = -1;
        handler_()();
        count() = now + 1;
    }

    double v_;
};

}  // namespace algest::test

template <>
class std::numeric_limits<algest::test::Interruptible> : public std::numeric_limits<double> {};
