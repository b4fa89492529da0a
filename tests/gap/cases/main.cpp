// SPDX-License-Identifier: GPL-3.0-or-later
// gap_cases: writes a case, or says which there are.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "case.hpp"

int main(int argc, char** argv) {
    using namespace algest::gap;
    try {
        if (argc == 2 && (std::string(argv[1]) == "--terms" || std::string(argv[1]) == "--structural")) {
            for (const std::string& family : families()) {
                for (const std::string& hidden : hidings(family, std::string(argv[1]) == "--structural"))
                    std::printf("%s %s\n", family.c_str(), hidden.c_str());
            }
            return 0;
        }
        if (argc == 5) {
            write_case(make_case(argv[1], argv[2], std::strtoull(argv[3], nullptr, 10)), argv[4]);
            return 0;
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "gap_cases: %s\n", e.what());
        return 1;
    }
    std::fprintf(stderr, "usage: gap_cases --terms | gap_cases --structural | gap_cases FAMILY HIDDEN SEED FOLDER\n");
    return 2;
}
