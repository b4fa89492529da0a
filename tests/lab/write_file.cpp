// SPDX-License-Identifier: GPL-3.0-or-later
// Output files: there whole, or what was there before.
#include "lab/write_file.hpp"

#include <sys/stat.h>
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/lab/temporary_file.hpp"

using namespace algest;

namespace {
std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
}  // namespace

TEST_CASE("a file is written whole, replaces what was there and keeps its permissions") {
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    const std::string path = folder.path("a.csv");
    CHECK(lab::write_file(path, "first\n", diagnostics));
    ::chmod(path.c_str(), 0640);
    CHECK(lab::write_file(path, "second\n", diagnostics));
    CHECK(text_of(path) == "second\n");
    struct stat there {};
    REQUIRE(::stat(path.c_str(), &there) == 0);
    CHECK((there.st_mode & 0777U) == 0640U);
    CHECK(folder.entries() == 1);
    CHECK(diagnostics.sorted().empty());
}

TEST_CASE("a staged file that is not put leaves nothing and changes nothing") {
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    const std::string path = folder.write("a.csv", "before\n");
    {
        const lab::StagedFile staged(path, "after\n", diagnostics);
        CHECK(staged.good());
        CHECK(folder.entries() == 2);
    }
    CHECK(folder.entries() == 1);
    CHECK(text_of(path) == "before\n");
}

TEST_CASE("a symbolic link stays one, and a device is written to, not replaced") {
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    const std::string target = folder.write("target", "before\n");
    std::filesystem::create_symlink(target, folder.path("link"));
    CHECK(lab::write_file(folder.path("link"), "after\n", diagnostics));
    CHECK(std::filesystem::is_symlink(folder.path("link")));
    CHECK(text_of(target) == "after\n");
    CHECK(lab::write_file("/dev/null", "gone\n", diagnostics));
    CHECK(std::filesystem::is_character_file("/dev/null"));
    CHECK_FALSE(diagnostics.failed());
}

TEST_CASE("what cannot be written is said, and leaves nothing") {
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    CHECK_FALSE(lab::write_file(folder.path("."), "x", diagnostics));
    CHECK_FALSE(lab::write_file(folder.path("no/such/folder.csv"), "x", diagnostics));
    CHECK_FALSE(lab::write_file("/dev/full", "x", diagnostics));
    CHECK(diagnostics.sorted().size() == 3);
    CHECK(diagnostics.has_errors());
    CHECK(folder.entries() == 0);
}
