// SPDX-License-Identifier: GPL-3.0-or-later
// The same work on many things, several at once: each in a process of its own, so that libraries with state of their own (units, HDF5) need
// no locks, and memory is given back.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace algest::cli {

/// Runs work(k), k = 0 .. count - 1, at most `jobs` at once, and gives what each returned, in their order; nullopt for one whose process ended
/// otherwise. `done` is told how many are, after each. Standard output and standard error of the work are those of this process.
/// Throws std::system_error where no process can be started.
std::vector<std::optional<std::string>> run_jobs(std::size_t count, std::size_t jobs, const std::function<std::string(std::size_t)>& work,
                                                 const std::function<void(std::size_t)>& done);

/// How many processors there are, at least 1.
std::size_t processors();

}  // namespace algest::cli
