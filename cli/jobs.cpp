// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <map>
#include <memory>
#include <system_error>
#include <thread>

namespace algest::cli {

namespace {

struct Job {
    std::size_t number;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> answer;   ///< a file without a name: unlike a pipe it cannot fill up
};

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// In the child: work, answer, end without what the parent does at its end.
[[noreturn]] void work_and_end(const Job& job, const std::function<std::string(std::size_t)>& work) {
    int code = 1;
    try {
        const std::string answer = work(job.number);
        const bool written = std::fwrite(answer.data(), 1, answer.size(), job.answer.get()) == answer.size() && std::fflush(job.answer.get()) == 0;
        code = written ? 0 : 1;
    } catch (...) {
        code = 1;   // the parent tells
    }
    ::_exit(code);
}

std::string read_whole(std::FILE* file) {
    std::string out;
    char buffer[65536];
    std::rewind(file);
    for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, file)) > 0;) out.append(buffer, count);
    return out;
}

}  // namespace

std::vector<std::optional<std::string>> run_jobs(std::size_t count, std::size_t jobs, const std::function<std::string(std::size_t)>& work,
                                                 const std::function<void(std::size_t)>& done) {
    std::vector<std::optional<std::string>> answers(count);
    std::map<pid_t, Job> running;
    std::size_t next = 0;
    std::size_t ended = 0;
    std::fflush(nullptr);   // else every child would print what waits to be printed
    while (ended < count) {
        while (next < count && running.size() < std::max<std::size_t>(jobs, 1)) {
            Job job{next++, {std::tmpfile(), &std::fclose}};
            if (!job.answer) fail("no temporary file");
            const pid_t child = ::fork();
            if (child < 0) fail("no further process");
            if (child == 0) work_and_end(job, work);
            running.emplace(child, std::move(job));
        }
        int status = 0;
        const pid_t child = ::waitpid(-1, &status, 0);
        if (child < 0 && errno == EINTR) continue;
        if (child < 0) fail("lost a process");
        const auto found = running.find(child);
        if (found == running.end()) continue;
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) answers[found->second.number] = read_whole(found->second.answer.get());
        running.erase(found);
        done(++ended);
    }
    return answers;
}

std::size_t processors() { return std::max(1U, std::thread::hardware_concurrency()); }

}  // namespace algest::cli
