// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <system_error>

#include "lab/html_text.hpp"

extern char** environ;

namespace algest::lab {

namespace {

/// A file without a name, gone when closed. Unlike a pipe it cannot fill up while the other side waits.
class Scratch {
public:
    Scratch() : file_(std::tmpfile(), &std::fclose) {
        if (!file_) throw std::system_error(errno, std::generic_category(), "no temporary file");
    }
    int descriptor() const { return ::fileno(file_.get()); }

    void write(const std::string& text) {
        if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() || std::fflush(file_.get()) != 0) {
            throw std::system_error(errno, std::generic_category(), "cannot write a temporary file");
        }
        std::rewind(file_.get());
    }

    std::string read() {
        std::string out;
        char buffer[65536];
        std::rewind(file_.get());
        for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, file_.get())) > 0;) out.append(buffer, count);
        return out;
    }

private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

void replace_all(std::string& text, std::string_view what, std::string_view by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) text.replace(at, what.size(), by);
}

}  // namespace

Drawing gnuplot(const std::string& script) try {
    Scratch in, out, complaints;
    in.write(script);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, complaints.descriptor(), STDERR_FILENO);
    char program[] = "gnuplot";
    char option[] = "-d";
    char* const arguments[] = {program, option, nullptr};
    pid_t child = 0;
    const int error = ::posix_spawnp(&child, program, &actions, nullptr, arguments, environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error == ENOENT || error == EACCES) return {Drawing::Outcome::not_installed, {}, {}};
    if (error != 0) return {Drawing::Outcome::failed, {}, std::strerror(error)};
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return {Drawing::Outcome::failed, {}, std::strerror(errno)};
    }
    std::string svg = out.read();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || svg.find("</svg>") == std::string::npos) return {Drawing::Outcome::failed, {}, complaints.read()};
    return {Drawing::Outcome::drawn, std::move(svg), {}};
} catch (const std::system_error& error) {
    return {Drawing::Outcome::failed, {}, error.what()};
}

std::string inline_svg(const std::string& svg, const std::string& prefix, const std::string& title) {
    const std::size_t begin = svg.find("<svg");
    if (begin == std::string::npos) return {};
    std::string out = svg.substr(begin);
    const std::size_t symbols = out.find("<defs>");
    const std::size_t symbols_end = out.find("</defs>");
    if (symbols != std::string::npos && symbols_end != std::string::npos) out.erase(symbols, symbols_end + 7 - symbols);
    replace_all(out, " id=\"", " id=\"" + prefix);
    const std::size_t open = out.find("<title>");
    const std::size_t close = out.find("</title>");
    if (open != std::string::npos && close != std::string::npos) out.replace(open + 7, close - open - 7, html_text(title));
    out.insert(4, " role=\"img\"");
    return out;
}

}  // namespace algest::lab
