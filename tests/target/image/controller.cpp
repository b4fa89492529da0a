// SPDX-License-Identifier: MIT-0
// The smallest controller with an estimator: it calls every member. HEADER and CLASS say which estimator.
#include HEADER

using Estimator = algest::generated::CLASS;

// Read and written by hardware, as far as the compiler knows.
Estimator::Sample sensor;
decltype(Estimator().estimate()) seen;
Estimator estimator;

int main() {
    estimator.reset();
    for (;;) {
        asm volatile("" ::: "memory");
        estimator.push(sensor);
        seen = estimator.estimate();
        asm volatile("" ::: "memory");
        seen = estimator.step(sensor);
    }
}
