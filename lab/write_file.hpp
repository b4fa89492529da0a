// SPDX-License-Identifier: GPL-3.0-or-later
// Output files that are there whole or not at all: written beside their place, synchronised, then renamed.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "generator/diagnostics.hpp"

namespace algest::lab {

/// A file that is written but not yet in its place. Its temporary is removed unless put() was called.
class StagedFile {
public:
    /// Writes the bytes to a temporary in the folder of `path`. A symbolic link is followed; what is there and is no
    /// regular file (a device, a pipe) is written directly by put(). An error goes to `diagnostics`.
    StagedFile(const std::string& path, std::string_view bytes, Diagnostics& diagnostics);
    ~StagedFile();
    StagedFile(StagedFile&& other) noexcept;
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;
    StagedFile& operator=(StagedFile&&) = delete;

    bool good() const { return good_; }
    /// Moves the file to its place; false and an error in `diagnostics` if that fails. Call once, if good().
    bool put(Diagnostics& diagnostics);

private:
    bool fail(int error, Diagnostics& diagnostics);

    std::string path_;       ///< as the user wrote it
    std::string place_;      ///< links followed
    std::string temporary_;  ///< empty: nothing to remove
    std::string direct_;     ///< bytes for a device or pipe
    bool good_ = false;
};

struct NewFile {
    std::string path;
    std::string bytes;
};

/// Writes several files: none of them is touched before all are on the disk. False, and an error in `diagnostics`, if one could not be.
bool write_files(const std::vector<NewFile>& files, Diagnostics& diagnostics);

/// Writes one file whole. False, and an error in `diagnostics`, if it could not be: what was there before is then untouched.
bool write_file(const std::string& path, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace algest::lab
