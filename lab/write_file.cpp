// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/write_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace algest::lab {

namespace {

constexpr mode_t new_file_mode = 0666;  // less the umask

/// All bytes to an open file; 0 or errno.
int write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

/// Writes and closes; 0 or errno of the first step that failed.
int write_and_close(int file, std::string_view bytes, bool synchronise) {
    int error = write_all(file, bytes);
    if (error == 0 && synchronise && ::fsync(file) != 0) error = errno;
    if (::close(file) != 0 && error == 0) error = errno;
    return error;
}

}  // namespace

StagedFile::StagedFile(const std::string& path, std::string_view bytes, Diagnostics& diagnostics)
    : path_(path), place_(path) {
    struct stat there {};
    const bool exists = ::stat(path.c_str(), &there) == 0;
    if (exists && S_ISDIR(there.st_mode)) {
        fail(EISDIR, diagnostics);
        return;
    }
    if (exists && !S_ISREG(there.st_mode)) {
        direct_ = bytes;
        good_ = true;
        return;
    }
    if (exists) {
        std::error_code no_matter;
        const std::filesystem::path real = std::filesystem::canonical(path, no_matter);
        if (!no_matter) place_ = real.string();
    }
    for (int attempt = 0; attempt < 100; ++attempt) {
        const std::string name = place_ + ".part" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
        const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, new_file_mode);
        if (file < 0 && errno == EEXIST) continue;
        if (file < 0) {
            fail(errno, diagnostics);
            return;
        }
        temporary_ = name;
        if (exists) (void)::fchmod(file, there.st_mode & 07777U);
        const int error = write_and_close(file, bytes, true);
        if (error != 0) {
            fail(error, diagnostics);
        } else {
            good_ = true;
        }
        return;
    }
    fail(EEXIST, diagnostics);
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : path_(std::move(other.path_)),
      place_(std::move(other.place_)),
      temporary_(std::exchange(other.temporary_, {})),
      direct_(std::move(other.direct_)),
      good_(std::exchange(other.good_, false)) {}

StagedFile::~StagedFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool StagedFile::fail(int error, Diagnostics& diagnostics) {
    const bool no_folder = error == ENOENT || error == ENOTDIR;
    diagnostics.error(path_, {}, std::string("cannot be written: ") + std::strerror(error),
                      no_folder ? "a path in a folder that exists" : "");
    return false;
}

bool StagedFile::put(Diagnostics& diagnostics) {
    if (temporary_.empty()) {
        const int file = ::open(place_.c_str(), O_WRONLY | O_CLOEXEC);
        const int error = file < 0 ? errno : write_and_close(file, direct_, false);
        return error == 0 || fail(error, diagnostics);
    }
    if (std::rename(temporary_.c_str(), place_.c_str()) != 0) return fail(errno, diagnostics);
    temporary_.clear();
    return true;
}

bool write_files(const std::vector<NewFile>& files, Diagnostics& diagnostics) {
    std::vector<StagedFile> staged;
    for (const NewFile& f : files) {
        staged.emplace_back(f.path, f.bytes, diagnostics);
        if (!staged.back().good()) return false;
    }
    return std::all_of(staged.begin(), staged.end(), [&](StagedFile& f) { return f.put(diagnostics); });
}

bool write_file(const std::string& path, std::string_view bytes, Diagnostics& diagnostics) {
    StagedFile file(path, bytes, diagnostics);
    return file.good() && file.put(diagnostics);
}

}  // namespace algest::lab
