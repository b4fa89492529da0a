// SPDX-License-Identifier: MIT-0
// On the host: the answers to the samples in a file, as main.cpp gives them on the board.
#include <cstdio>

#include "steps.hpp"

int main(int, char** files) {
    static Estimator estimator;
    Estimator::Sample sample;
    std::FILE* in = std::fopen(files[1], "rb");
    std::FILE* out = std::fopen(files[2], "wb");
    while (std::fread(&sample, sizeof sample, 1, in) == 1) {
        const Answer a = answer(estimator.step(sample));
        std::fwrite(&a, sizeof a, 1, out);
    }
    return std::fclose(out);
}
