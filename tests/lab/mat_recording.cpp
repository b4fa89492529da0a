// SPDX-License-Identifier: GPL-3.0-or-later
// MATLAB files of every version and number type, as matio writes them, are read to the same numbers.
#include <catch2/catch.hpp>
#include <matio.h>

#include "lab/recording.hpp"
#include "tests/lab/temporary_file.hpp"

using namespace algest;

namespace {

template <class Number>
void write(mat_t* file, const char* name, matio_classes kind, matio_types type, std::vector<Number> values) {
    std::size_t dims[2] = {1, values.size()};
    matvar_t* const v = Mat_VarCreate(name, kind, type, 2, dims, values.data(), 0);
    CHECK(Mat_VarWrite(file, v, MAT_COMPRESSION_NONE) == 0);
    Mat_VarFree(v);
}

}  // namespace

TEST_CASE("MATLAB files of versions 4, 5 and 7.3 hold the same recording") {
    const test::TemporaryFolder folder;
    for (const mat_ft version : {MAT_FT_MAT4, MAT_FT_MAT5, MAT_FT_MAT73}) {
        INFO("version " << version);
        const std::string path = folder.path("run.mat");
        mat_t* const file = Mat_CreateVer(path.c_str(), nullptr, version);
        REQUIRE(file != nullptr);
        write<double>(file, "t", MAT_C_DOUBLE, MAT_T_DOUBLE, {0, 0.5, 1});
        if (version == MAT_FT_MAT4) {
            write<double>(file, "x", MAT_C_DOUBLE, MAT_T_DOUBLE, {1, -2, 4});
        } else {
            write<float>(file, "x", MAT_C_SINGLE, MAT_T_SINGLE, {1, -2, 4});
            write<mat_int16_t>(file, "n", MAT_C_INT16, MAT_T_INT16, {-7, 0, 300});
            write<mat_uint8_t>(file, "flag", MAT_C_UINT8, MAT_T_UINT8, {0, 1, 255});
        }
        Mat_Close(file);
        Diagnostics diagnostics;
        const auto r = lab::read_recording(path, diagnostics);
        for (const Diagnostic& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
        REQUIRE(r);
        CHECK(r->t == std::vector<double>{0, 0.5, 1});
        CHECK(r->period == 0.5);
        CHECK(r->column("x")->values == std::vector<double>{1, -2, 4});
        if (version == MAT_FT_MAT4) continue;
        CHECK(r->column("n")->values == std::vector<double>{-7, 0, 300});
        CHECK(r->column("flag")->values == std::vector<double>{0, 1, 255});
    }
}
