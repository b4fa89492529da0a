// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings: what is read, and where each refusal points.
#include "lab/recording.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include "lab/text_lines.hpp"
#include "tests/lab/temporary_file.hpp"

using namespace algest;
using namespace std::string_literals;

namespace {

const test::TemporaryFolder folder;

std::optional<lab::Recording> read(std::string_view bytes, Diagnostics& diagnostics) {
    return lab::read_recording(folder.write("r.csv", bytes), diagnostics);
}

lab::Recording must_read(std::string_view bytes) {
    Diagnostics diagnostics;
    auto recording = read(bytes, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(recording);
    REQUIRE_FALSE(diagnostics.failed());
    return *recording;
}

std::string rows(int count, double period, const char* format) {
    std::string out = "t [s],u [V]\n";
    for (int k = 0; k < count; ++k) {
        char text[64];
        std::snprintf(text, sizeof text, format, k * period);
        out += text + ",1\n"s;
    }
    return out;
}

bool reads(std::string_view bytes) {
    Diagnostics diagnostics;
    return read(bytes, diagnostics).has_value();
}

}  // namespace

TEST_CASE("a recording is read with names, units, values and period") {
    const auto r = must_read("t [s],position [m], flag ,duty [-]\n0,1.5,0,-3e-4\n0.25,2.5,1,0\n0.5,4.5,1,1e-310\n");
    REQUIRE(r.columns.size() == 4);
    CHECK(r.columns[1].name == "position");
    CHECK(r.columns[1].unit == "m");
    CHECK(r.columns[1].place == 7);
    CHECK(r.columns[2].name == "flag");
    CHECK_FALSE(r.columns[2].unit);
    CHECK(r.columns[3].unit == "-");
    CHECK(r.columns[3].values == std::vector<double>{-3e-4, 0.0, 1e-310});
    CHECK(r.t == std::vector<double>{0.0, 0.25, 0.5});
    CHECK(r.period == 0.25);
}

TEST_CASE("line ends, byte-order mark, quotes, blanks and the place of t do not matter") {
    for (const std::string& text :
         {"u [V],t [s]\n1,0\n2,1\n"s, "u [V],t [s]\r\n1,0\r\n2,1\r\n"s, "\xEF\xBB\xBFu [V],t [s]\n1,0\n2,1"s,
          "\"u [V]\", \"t [s]\" \n \"1\" ,\t0 \n2,1\n\n  \n"s}) {
        const auto r = must_read(text);
        CHECK(r.column("u")->values == std::vector<double>{1.0, 2.0});
        CHECK(r.t == std::vector<double>{0.0, 1.0});
    }
    const auto r = must_read("t [s],\"a, \"\"b\"\" [counts; 8192 per rev]\"\n0,1\n1,2\n");
    CHECK(r.columns[1].name == "a, \"b\"");
    CHECK(r.columns[1].unit == "counts; 8192 per rev");
}

TEST_CASE("time in another unit becomes seconds") {
    const auto r = must_read("t [ms],u\n0,1\n2,2\n4,3\n");
    CHECK(r.t == std::vector<double>{0.0, 0.002, 0.004});
    CHECK(r.period == Approx(0.002).epsilon(1e-15));
}

TEST_CASE("a uniform clock is uniform however it was rounded, and nothing else is") {
    CHECK(reads(rows(2000, 1e-3, "%.3f")));
    CHECK(reads(rows(2000, 1e-3, "%.17g")));
    CHECK(reads(rows(20000, 1e-3, "%g")));          // six significant digits, as C++ streams write
    CHECK(reads(rows(1000, 1.0 / 300.0, "%.4f")));  // steps of 0.0033 and 0.0034
    CHECK(reads(rows(20000, 1.0 / 300.0, "%g")));
    CHECK(reads(rows(200, 86400.0, "%.0f")));
    CHECK_FALSE(reads(rows(1000, 1.0 / 300.0, "%.3f")));  // a digit as coarse as a third of a step hides what it is

    const auto with_third_row = [](const char* t) { return "t [s],u\n0,1\n0.01,1\n"s + t + ",1\n0.03,1\n0.04,1\n0.05,1\n"; };
    CHECK(reads(with_third_row("0.02")));
    CHECK(reads(with_third_row("0.020005")));  // 0.05 percent of a step
    CHECK_FALSE(reads(with_third_row("0.02005")));
    CHECK_FALSE(reads(with_third_row("0.021")));  // off by one unit of the last digit: no rounding does that
    CHECK_FALSE(reads(with_third_row("0.01")));
}

TEST_CASE("the period is the mean step, known to the digits of t") {
    const auto r = must_read(rows(1001, 1.0 / 300.0, "%.4f"));
    CHECK(r.period == Approx(1.0 / 300.0).margin(r.period_uncertainty));
    CHECK(r.period_uncertainty == Approx(1e-4 / 1000));
}

TEST_CASE("what is wrong with a recording is told with line and column") {
    struct Case {
        std::string bytes;
        int line, column;
        std::string what;
    };
    const std::string head = "t [s],u [V],y\n0,1,2\n1,1,2\n2,1,2\n3,1,2\n";
    const auto case_ = GENERATE_COPY(values<Case>({
        {"", 1, 1, "empty"},
        {"\n\n", 1, 1, "empty"},
        {"\xEF\xBB\xBF", 1, 1, "empty"},
        {"t [s],u [V]\n", 1, 1, "no rows"},
        {"t [s],u [V]\n0,1\n", 2, 1, "only one row"},
        {head + "4,abc,2\n", 6, 3, "'abc' is not a number in column 'u'"},
        {head + "4,1.5x,2\n", 6, 3, "'1.5x'"},
        {head + "4,1,nan\n", 6, 5, "'nan' is not finite"},
        {head + "4,-inf,2\n", 6, 3, "'-inf' is not finite"},
        {head + "4,1e999,2\n", 6, 3, "beyond the range"},
        {head + "4,+1,2\n", 6, 3, "'+1' is not a number"},
        {head + "4,0x10,2\n", 6, 3, "'0x10' is not a number"},
        {head + "4,,2\n", 6, 3, "a value is missing"},
        {head + "4, ,2\n", 6, 4, "a value is missing"},
        {head + "4,   \xC3\xA9,2\n", 6, 6, "is not a number"},
        {head + "4,\x89,2\n", 6, 3, "no UTF-8"},
        {head + "4,1\n", 6, 4, "the row has 2 fields"},
        {head + "4,1,2,\n", 6, 7, "the row has 4 fields"},
        {head + "4;1;2\n", 6, 6, "the row has 1 fields"},
        {head + "\n4,1,2\n", 6, 1, "blank"},
        {head + "5,1,2\n", 6, 1, "not uniform: a step of 2 s here, 1 s elsewhere"},
        {head + "3,1,2\n", 6, 1, "stands still"},
        {head + "2,1,2\n", 6, 1, "goes back"},
        {head + "4,\"1,2\n", 6, 3, "quotes"},
        {head + "4,1\"2,2\n", 6, 4, "quotes"},
        {head + "4,1\0,2\n"s, 6, 4, "NUL"},
        {"t [s],u\r\n0,1\r\n1,1\n", 3, 4, "this line ends with LF"},
        {"t [s],u\n0,1\r\n1,1\r\n", 2, 4, "this line ends with CRLF"},
        {"t [s],u\r0,1\r1,1\r", 1, 8, "carriage return"},
        {"\xFF\xFEt\0 \0"s, 1, 1, "UTF-16"},
        {"t\0 \0["s, 1, 2, "NUL"},
        {"time [s],u\n0,1\n1,1\n", 1, 1, "no column `t`"},
        {"t [s];u [V]\n0;1\n1;1\n", 1, 6, "one column, with a semicolon"},
        {"t [s]\tu [V]\n0\t1\n1\t1\n", 1, 6, "one column, with a tab"},
        {"t,u\n0,1\n1,1\n", 1, 1, "no unit"},
        {"u,t [V]\n0,1\n1,1\n", 1, 3, "not one of time"},
        {"u,t [blinks]\n0,1\n1,1\n", 1, 3, "not one of time"},
        {"t [s],u,u\n0,1,1\n1,1,1\n", 1, 9, "second column 'u'; the first is at column 7"},
        {"t [s],\xC3\xA9,u [V],u [mV]\n0,1,1,1\n1,1,1,1\n", 1, 15, "second column 'u'; the first is at column 9"},
        {"t [s],\n0,1\n1,1\n", 1, 7, "no name"},
        {"t [s],[V]\n0,1\n1,1\n", 1, 7, "no name"},
        {"t [s],u [V\n0,1\n1,1\n", 1, 7, "bracket"},
        {"0,1\n1,1\n", 1, 1, "number where the header should be"},
    }));
    INFO(case_.bytes);
    Diagnostics diagnostics;
    CHECK_FALSE(read(case_.bytes, diagnostics));
    const auto all = diagnostics.sorted();
    for (const Diagnostic& d : all) UNSCOPED_INFO(d.text());
    CHECK(std::any_of(all.begin(), all.end(), [&](const Diagnostic& d) {
        return d.severity == Severity::error && d.at.line == case_.line && d.at.column == case_.column && !d.right.empty() &&
               d.what.find(case_.what) != std::string::npos;
    }));
}

TEST_CASE("the first uneven step is the one that is shown, with the number of them") {
    std::string text = "t [s],u\n";
    for (int k = 0; k < 50; ++k) text += std::to_string(k < 20 ? k : k < 40 ? k + 3 : k + 5) + ",1\n";
    Diagnostics diagnostics;
    CHECK_FALSE(read(text, diagnostics));
    REQUIRE(diagnostics.sorted().size() == 1);
    CHECK(diagnostics.sorted()[0].at.line == 22);  // row 20, after the header on line 1
    CHECK(diagnostics.sorted()[0].what == "`t` is not uniform: a step of 4 s here, 1 s elsewhere (2 such steps)");
}

TEST_CASE("several complaints come at once, up to a limit") {
    std::string text = "t [s],u\n";
    for (int k = 0; k < 3; ++k) text += std::to_string(k) + ",x\n";
    Diagnostics three;
    CHECK_FALSE(read(text, three));
    CHECK(three.sorted().size() == 3);
    for (int k = 3; k < 1000; ++k) text += std::to_string(k) + ",x\n";
    Diagnostics many;
    CHECK_FALSE(read(text, many));
    CHECK(many.sorted().size() == lab::most_complaints + 1);  // and a note that there may be more
}

TEST_CASE("a folder, a missing file and a line without end are answered at once") {
    Diagnostics diagnostics;
    CHECK_FALSE(lab::read_recording(folder.path("."), diagnostics));
    CHECK_FALSE(lab::read_recording(folder.path("nothing.csv"), diagnostics));
    REQUIRE(diagnostics.sorted().size() == 2);
    CHECK(diagnostics.sorted()[0].what == "is a directory");
    CHECK(diagnostics.sorted()[1].what == "cannot be read: No such file or directory");

    const std::string path = folder.write("long.csv", "t [s],u\n0,1\n" + std::string(100'000'000, '1'));
    Diagnostics long_line;
    CHECK_FALSE(lab::read_recording(path, long_line));
    REQUIRE(long_line.sorted().size() == 1);
    CHECK(long_line.sorted()[0].at.line == 3);
    CHECK(long_line.sorted()[0].what == "the line is longer than 1 MiB");

    Diagnostics endless;   // a file without end is answered only by who does not read it whole
    CHECK_FALSE(lab::read_recording("/dev/zero", endless));
    CHECK(endless.sorted()[0].what.find("a NUL byte") == 0);

    const std::string just_fits = "t [s],u\n0,1\n1," + std::string(lab::longest_line - 3, ' ') + "1\n";
    CHECK(reads(just_fits));
}

TEST_CASE("signals come in the model's unit") {
    const auto r = must_read("t [s],x [mm],T [degC],n [counts; 8192 per rev],plain,duty [-]\n0,1,0,1,1,1\n1,2,100,1,2,1\n");
    const auto get = [&](const char* column, const char* unit, Diagnostics& d) {
        return lab::signal_values(r, {"signal", column, unit}, d);
    };
    Diagnostics none;
    CHECK(get("x", "mm", none) == std::vector<double>{1.0, 2.0});
    CHECK(get("x", "", none) == std::vector<double>{1.0, 2.0});
    CHECK(get("x", "m", none)->at(1) == Approx(0.002).epsilon(1e-15));
    CHECK(get("T", "K", none)->at(1) == Approx(373.15).epsilon(1e-15));
    CHECK(get("duty", "1", none) == std::vector<double>{1.0, 1.0});
    CHECK(get("n", "", none));
    CHECK(get("n", "counts; 8192 per rev", none));
    CHECK(none.sorted().empty());

    Diagnostics warned;
    CHECK(get("plain", "V", warned) == std::vector<double>{1.0, 2.0});
    CHECK(warned.has_warnings());
    CHECK_FALSE(warned.failed());

    const auto refusal = [&](const char* column, const char* unit) {
        Diagnostics d;
        CHECK_FALSE(get(column, unit, d));
        REQUIRE(d.sorted().size() == 1);
        return d.sorted()[0];
    };
    CHECK(refusal("x", "V").at.column == 7);
    CHECK(refusal("x", "V").what == "'mm' of column 'x' does not convert to 'V' of the signal `signal`");
    CHECK(refusal("n", "rad").at.column == 23);
    CHECK(refusal("n", "rad").what.find("is not known") != std::string::npos);
    CHECK(refusal("w", "V").what == "there is no column 'w' for the signal `signal` of the model");
    CHECK(refusal("w", "V").right.find("'t', 'x', 'T', 'n', 'plain', 'duty'") != std::string::npos);
}
