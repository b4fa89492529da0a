// SPDX-License-Identifier: 0BSD
// Writes the recording of this folder to standard output: a coil of 3.01 ohm and 9 mH under a square wave of +-6 V with a
// period of 11 ms, sampled every 100 us, current rounded to 0.1 mA. The exact solution of L i' = v - R i between samples.
#include <cmath>
#include <cstdio>

int main() {
    constexpr double R = 3.01, L = 9e-3, period = 1e-4;
    const double decay = std::exp(-R / L * period);
    double i = 0;
    std::printf("t [s],v [V],i [A]\n");
    for (int k = 0; k < 1500; ++k) {
        const double v = k / 55 % 2 == 0 ? 6.0 : -6.0;
        std::printf("%.4f,%g,%.4f\n", k * period, v, i);
        i = decay * i + (1 - decay) * v / R;
    }
    return 0;
}
