// SPDX-License-Identifier: GPL-3.0-or-later
// How long a whole model takes, derive and generate: n = 5, M = 2000, every coefficient unknown, m = 0 and m = 5.
//
//     cmake --build build --target algest bench_generate_time && build/bench/generate_time [ALGEST]
//
// ALGEST: the tool to time as a user runs it; build/algest unless given. Below that, the same work in this process, step by step.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "generator/annihilator.hpp"
#include "generator/equation.hpp"
#include "generator/generate.hpp"
#include "generator/kernel.hpp"
#include "generator/lumping.hpp"
#include "generator/model.hpp"
#include "generator/row_choice.hpp"
#include "generator/row_functional.hpp"
#include "generator/row_weight.hpp"
#include "generator/units.hpp"
#include "generator/wide_integer.hpp"
#include "lab/write_file.hpp"

extern char** environ;

namespace {

using namespace algest;
namespace fs = std::filesystem;

constexpr int n = 5;
constexpr int intervals = 2000;
constexpr int repetitions = 15;
constexpr double bar_ms = 100;

/// Milliseconds.
struct Time {
    double median;
    double least;
    double cpu;  ///< least processor time, user and system
};

double processor_ms(int who) {
    rusage used{};
    getrusage(who, &used);
    const auto ms = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) * 1e-3;
    };
    return ms(used.ru_utime) + ms(used.ru_stime);
}

/// Does the work many times over. Where other programs share the machine the processor time tells more than the clock, but it
/// leaves out the disk. who: RUSAGE_SELF, or RUSAGE_CHILDREN for work that is a process.
Time time_of(const std::function<void()>& work, int who = RUSAGE_SELF) {
    std::vector<double> times;
    double cpu = 1e9;
    for (int k = 0; k < repetitions; ++k) {
        const double cpu_start = processor_ms(who);
        const auto start = std::chrono::steady_clock::now();
        work();
        times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        cpu = std::min(cpu, processor_ms(who) - cpu_start);
    }
    std::sort(times.begin(), times.end());
    return {times[times.size() / 2], times.front(), cpu};
}

[[noreturn]] void stop(const std::string& why) {
    std::fprintf(stderr, "generate_time: %s\n", why.c_str());
    std::exit(1);
}

void print(const char* what, Time t, const std::string& remark = {}) {
    std::printf("  %-52s %8.2f %8.2f %8.2f  %s\n", what, t.median, t.least, t.cpu, remark.c_str());
}

std::string model_text(int m) {
    std::string unknowns;
    for (int i = 0; i < n; ++i) unknowns += "\"a" + std::to_string(i) + "\", ";
    for (int i = 0; i <= m; ++i) unknowns += "\"b" + std::to_string(i) + "\", ";
    return "format = 1\nname = \"timed\"\n[sampling]\nperiod = 1e-3\nwindow = " + std::to_string(intervals / 1000) +
           "\n[signals]\n" + "y = { unit = \"rad\" }\nu = { unit = \"V\" }\n[transfer]\nn = " + std::to_string(n) +
           "\nm = " + std::to_string(m) + "\nunknowns = [" + unknowns + "]\n";
}

/// Runs a program to its end, its output thrown away.
void run(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& w : words) arguments.push_back(w.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    int status = 1;
    const bool started = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    if (!started || waitpid(child, &status, 0) != child || status != 0) stop("cannot run " + words[0] + " " + words[1]);
}

/// Numerators as long as those of a table of this kernel, and their denominator: to time the rounding by itself.
struct Numerators {
    exact::WideIntegers values;
    exact::Integer denominator;
};

Numerators numerators_of(const plan::Table& table) {
    Numerators out;
    out.denominator = 1;
    for (std::size_t k = 0; k < table.kernel.size() + 1; ++k)
        out.denominator = out.denominator * intervals * static_cast<int>(k + 1);
    out.values.words = static_cast<std::size_t>(cln::integer_length(out.denominator)) / 64 + 1;
    out.values.data.resize(out.values.words * table.weights.size());
    for (std::size_t k = 0; k < table.weights.size(); ++k) {
        exact::assign(out.values, k, cln::floor1(exact::from_double(table.weights[k]) * out.denominator));
    }
    return out;
}

void time_model(int m, const std::string& algest, const fs::path& folder) {
    const std::string path = (folder / "timed.toml").string();
    std::ofstream(path) << model_text(m);
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(path, {}, diagnostics);
    if (!plan) stop("the model is refused: " + diagnostics.sorted().front().text());
    const auto files = generator::emit(*plan);
    std::size_t bytes = 0;
    for (const auto& f : files) bytes += f.text.size();
    std::printf("\nn = %d, m = %d, M = %d: %zu unknowns, %zu rows, %zu tables, %zu weights, %.2f MB emitted\n", n, m,
                intervals, plan->lumped.size(), plan->rows.size(), plan->tables.size(),
                plan->tables.size() * static_cast<std::size_t>(plan->samples()), static_cast<double>(bytes) / 1e6);
    std::printf("  %-52s %8s %8s %8s\n", "milliseconds", "median", "least", "cpu");

    const Time derive = time_of([&] { run({algest, "derive", path}); }, RUSAGE_CHILDREN);
    const Time generate = time_of(
        [&] {
            run({algest, "generate", path, "-o", (folder / "out").string()});
        },
        RUSAGE_CHILDREN);
    const Time help = time_of([&] { run({algest, "--help"}); }, RUSAGE_CHILDREN);
    print("algest derive, as a process", derive);
    print("algest generate, as a process", generate);
    const Time both{derive.median + generate.median, derive.least + generate.least, derive.cpu + generate.cpu};
    print("both: the bar is 100", both,
          both.least < bar_ms ? "reached"
          : both.cpu < bar_ms ? "reached by the processor, not by the clock: the machine is busy"
                              : "MISSED");
    print("  of each, starting the process (algest --help)", help);
    print("algest derive --format json --weights, as a process",
          time_of(
              [&] {
                  run({algest, "derive", path, "--format", "json", "--weights"});
              },
              RUSAGE_CHILDREN));

    std::printf("  in this process:\n");
    const Time whole = time_of([&] {
        Diagnostics d;
        (void)generator::plan_from_model(path, {}, d);
    });
    print("model file to plan", whole, "of which");
    const auto model = model::read(path, false, diagnostics);
    print("  reading and checking the model file", time_of([&] {
              Diagnostics d;
              (void)model::read(path, false, d);
          }));
    std::vector<equation::OperatorForm> forms = {*equation::operator_form(*model, model->equations[0], diagnostics)};
    const auto lumping = lumping::lump(*model, forms, diagnostics);
    const auto rows = generator::choose_rows(*model, *lumping, diagnostics);
    print("  operator form, lumping, rows", time_of([&] {
              Diagnostics d;
              const std::vector<equation::OperatorForm> f = {*equation::operator_form(*model, model->equations[0], d)};
              const auto l = lumping::lump(*model, f, d);
              const auto r = generator::choose_rows(*model, *l, d);
              const auto functional = generator::row_functional(*model, f, plan::Scalar::float64);
              (void)generator::row_weights(*model, f, *l, *r, *functional, d);
          }));
    std::vector<kernel::Coefficients> kernels;
    for (const plan::Table& t : plan->tables) kernels.push_back(annihilator::kernel(t.derivative, t.p, {t.n, t.kappa, t.form}));
    print("  kernels by Pi, Leibniz and division, once a table", time_of([&] {
              for (const plan::Table& t : plan->tables) (void)annihilator::kernel(t.derivative, t.p, {t.n, t.kappa, t.form});
          }));
    print("  weights: exact integrals, rounded", time_of([&] {
              for (std::size_t k = 0; k < kernels.size(); ++k)
                  (void)kernel::weights(kernels[k], intervals, plan->tables[k].hold, plan->quadrature, plan->scalar);
          }));
    std::vector<Numerators> numerators;
    for (const plan::Table& t : plan->tables) numerators.push_back(numerators_of(t));
    double sink = 0;
    print("    of which rounding (numerators of that length)", time_of([&] {
              for (const Numerators& table : numerators) {
                  const exact::QuotientRounder nearest(table.denominator, plan->scalar);
                  for (int k = 0; k <= intervals; ++k)
                      sink += nearest(table.values.at(static_cast<std::size_t>(k)), table.values.words);
              }
          }));
    print("derivation as text", time_of([&] { (void)generator::derivation_text(*plan); }));
    print("plan to files", time_of([&] { (void)generator::emit(*plan); }), "of which");
    std::size_t length = 0;
    print("  numbers as hexadecimal text", time_of([&] {
              for (const plan::Table& t : plan->tables)
                  for (const double w : t.weights) length += exact::hexadecimal(w).size();
          }));
    print("  derivation as text", time_of([&] { (void)generator::derivation_text(*plan); }));
    fs::create_directories(folder / plan->name);
    print("writing and synchronising the files", time_of([&] {
              for (const auto& f : files)
                  if (!lab::write_file((folder / f.path).string(), f.text, diagnostics)) stop("cannot write " + f.path);
          }));
    if (sink == 1e300 || length == 0) stop("nothing was computed");
}

}  // namespace

int main(int argc, char** argv) {
    const std::string algest =
        argc > 1 ? argv[1] : (fs::canonical("/proc/self/exe").parent_path().parent_path() / "algest").string();
    if (!fs::exists(algest)) stop("there is no " + algest);
    std::string folder = (fs::temp_directory_path() / "algest-bench-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) stop("no temporary folder");
    const auto start = std::chrono::steady_clock::now();
    (void)units::Unit::parse("rad");
    const double units_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    std::printf("%s, %d runs of each\nonce a process, in derive and in generate: UDUNITS reads its database, %.2f ms\n",
                algest.c_str(), repetitions, units_ms);
    for (const int m : {0, n}) time_model(m, algest, folder);
    fs::remove_all(folder);
    return 0;
}
