// SPDX-License-Identifier: GPL-3.0-or-later
// What one sample costs: nine kernels of degree 6 on one signal, by tables of weights and by moments, beside what peers do with the same tables; and
// recursive least squares beside the PMSM estimator, in cost and in accuracy.
//
//     cmake --build build --target bench_engines && build/bench/engines
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <liquid/liquid.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "bench/recursive_least_squares.hpp"
#include "generator/generate.hpp"
#include "lab/host_estimator.hpp"
#include "tests/runtime/moment_window.hpp"

namespace {

using namespace algest;

constexpr int degree = 6;
constexpr test::Rule linear{plan::Hold::linear, plan::Quadrature::exact};

const std::vector<kernel::Coefficients>& kernels() {
    static const auto all = test::nine_kernels(degree);
    return all;
}

/// Tables of the nine kernels, one after the other.
template <class S>
std::vector<S> tables(int intervals) {
    std::vector<S> out;
    for (const kernel::Coefficients& k : kernels()) {
        for (const double w : kernel::weights(k, intervals, linear.hold, linear.quadrature, plan::Scalar::float64)) out.push_back(static_cast<S>(w));
    }
    return out;
}

/// The newest samples of one signal, contiguous: the runtime's mirrored ring.
template <class S>
class Ring {
public:
    explicit Ring(int intervals) : samples_(intervals + 1), ring_(static_cast<std::size_t>(ring_scalars(1, samples_))) {}
    const S* push() {
        const S x = static_cast<S>(((k_ += 40503U) >> 8U) % 2001U) / S(1000);
        write_sample(ring_.data(), 1, samples_, head_, &x);
        head_ = head_ + 1 == samples_ ? 0 : head_ + 1;
        return window(ring_.data(), 0, newest(samples_, samples_, head_));
    }

private:
    int samples_;
    int head_ = 0;
    unsigned k_ = 0;
    std::vector<S> ring_;
};

template <class S>
void fir(benchmark::State& state) {
    const int intervals = static_cast<int>(state.range(0));
    const std::vector<S> weights = tables<S>(intervals);
    std::vector<Functional> functionals;
    std::vector<Term<S>> terms;
    for (std::uint16_t t = 0; t < kernels().size(); ++t) {
        functionals.push_back({t, 0, t, 1});
        terms.push_back({static_cast<std::uint16_t>(t / 3), static_cast<std::uint16_t>(t % 3), S(1)});   // three rows of two unknowns
    }
    const RowSet<S> rows = {intervals + 1, 1, 3, 2, {weights.data(), static_cast<int>(weights.size())}, {functionals.data(), 9}, {terms.data(), 9}};
    Ring<S> ring(intervals);
    std::vector<S> matrix(9), scratch(9);
    for (auto _ : state) {
        const S* at = ring.push();
        evaluate_rows(rows, at, WindowPosition{intervals + 1, 0}, matrix.data(), scratch.data());
        benchmark::DoNotOptimize(matrix.data());
        benchmark::ClobberMemory();
    }
}

template <class S, int order>
void eigen(benchmark::State& state) {
    const int intervals = static_cast<int>(state.range(0));
    const std::vector<S> weights = tables<S>(intervals);
    const Eigen::Matrix<S, 9, Eigen::Dynamic, order> matrix = Eigen::Map<const Eigen::Matrix<S, 9, Eigen::Dynamic, Eigen::RowMajor>>(weights.data(), 9, intervals + 1);
    Ring<S> ring(intervals);
    Eigen::Matrix<S, 9, 1> values;
    for (auto _ : state) {
        values.noalias() = matrix * Eigen::Map<const Eigen::Matrix<S, Eigen::Dynamic, 1>>(ring.push(), intervals + 1);
        benchmark::DoNotOptimize(values.data());
        benchmark::ClobberMemory();
    }
}

/// Single precision: liquid-dsp has no other real dot product.
void liquid_dotprod(benchmark::State& state) {
    const int intervals = static_cast<int>(state.range(0));
    std::vector<float> weights = tables<float>(intervals);
    std::vector<dotprod_rrrf> dots;
    for (std::size_t t = 0; t < 9; ++t) dots.push_back(dotprod_rrrf_create(weights.data() + t * (static_cast<std::size_t>(intervals) + 1), static_cast<unsigned>(intervals) + 1));
    Ring<float> ring(intervals);
    float values[9];
    for (auto _ : state) {
        float* at = const_cast<float*>(ring.push());
        for (std::size_t t = 0; t < 9; ++t) dotprod_rrrf_execute(dots[t], at, values + t);
        benchmark::DoNotOptimize(values);
        benchmark::ClobberMemory();
    }
    for (dotprod_rrrf d : dots) dotprod_rrrf_destroy(d);
}

void liquid_firfilt(benchmark::State& state) {
    const int intervals = static_cast<int>(state.range(0));
    std::vector<float> weights = tables<float>(intervals);
    std::vector<firfilt_rrrf> filters;
    for (std::size_t t = 0; t < 9; ++t) filters.push_back(firfilt_rrrf_create(weights.data() + t * (static_cast<std::size_t>(intervals) + 1), static_cast<unsigned>(intervals) + 1));
    float values[9];
    unsigned k = 0;
    for (auto _ : state) {
        const float x = static_cast<float>(((k += 40503U) >> 8U) % 2001U) / 1000.0F;
        for (std::size_t t = 0; t < 9; ++t) {
            firfilt_rrrf_push(filters[t], x);
            firfilt_rrrf_execute(filters[t], values + t);
        }
        benchmark::DoNotOptimize(values);
        benchmark::ClobberMemory();
    }
    for (firfilt_rrrf f : filters) firfilt_rrrf_destroy(f);
}

template <class S, class A>
void moments(benchmark::State& state) {
    const int intervals = static_cast<int>(state.range(0));
    test::MomentWindow<S, A> window(kernels(), intervals, linear);
    unsigned k = 0;
    for (auto _ : state) {
        window.push(static_cast<S>(((k += 40503U) >> 8U) % 2001U) / S(1000));
        benchmark::DoNotOptimize(window.evaluate());
        benchmark::ClobberMemory();
    }
}

const std::vector<plants::PmsmSample>& noisy_motor() {
    static const auto all = [] {
        plants::Pmsm motor;
        motor.current_noise = 0.03;
        return plants::simulate(motor, 8000);
    }();
    return all;
}

/// The PMSM estimator over a window of 2000 periods, S(t) over as many: push and estimate.
void pmsm_estimator(benchmark::State& state, const plan::Plan& plan) {
    lab::HostEstimator<double> estimator(plan);
    std::size_t k = 0;
    const auto step = [&] {
        const plants::PmsmSample& s = noisy_motor()[k];
        const double inputs[] = {s.v_d, s.v_q, s.i_d, s.i_q, s.omega};
        k = k + 1 == noisy_motor().size() ? 0 : k + 1;
        benchmark::DoNotOptimize(estimator.step(inputs));
    };
    for (int warm = 0; warm < 4100; ++warm) step();
    for (auto _ : state) step();
}

void recursive_least_squares(benchmark::State& state) {
    bench::RecursiveLeastSquares estimator(1e-4, 50.0, 2000.0);
    std::size_t k = 0;
    for (auto _ : state) {
        estimator.push(noisy_motor()[k]);
        k = k + 1 == noisy_motor().size() ? 0 : k + 1;
        benchmark::DoNotOptimize(estimator.R());
    }
}

/// Keeps the least time of every benchmark, for the table.
class Times : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            const auto [at, fresh] = ns_.try_emplace(run.run_name.function_name + "/" + run.run_name.args, run.GetAdjustedCPUTime());
            if (!fresh) at->second = std::min(at->second, run.GetAdjustedCPUTime());
        }
    }
    double ns(const std::string& name, int intervals) const { return ns_.at(name + "/" + std::to_string(intervals)); }
    double ns(const std::string& name) const { return ns_.at(name + "/"); }
    void print() const {
        for (const auto& [name, ns] : ns_) fmt::print("{} {:.1f} ns\n", name, ns);
    }

private:
    std::map<std::string, double> ns_;
};

const std::vector<int> windows = {20, 50, 100, 200, 500, 2000, 20000};

/// The window from which on moments cost less than tables, straight between two that were measured.
std::string crossover(const Times& times) {
    const auto lead = [&](int m) { return times.ns("fir double", m) - times.ns("moments double", m); };
    if (lead(windows.front()) > 0) return fmt::format("below {}", windows.front());
    for (std::size_t k = 1; k < windows.size(); ++k) {
        const double before = lead(windows[k - 1]), after = lead(windows[k]);
        if (after > 0) return fmt::format("{:.0f}", windows[k - 1] + (windows[k] - windows[k - 1]) * before / (before - after));
    }
    return fmt::format("above {}", windows.back());
}

void print_windows(const Times& times) {
    const std::vector<std::string> names = {"fir double", "eigen rows double", "eigen columns double", "moments double", "fir float", "eigen rows float", "liquid dotprod float", "liquid firfilt float", "moments two floats"};
    fmt::print("Nine kernels of degree {} on one signal, ns a sample (least of the repetitions, processor time)\n\n| M |", degree);
    for (const std::string& name : names) fmt::print(" {} |", name);
    fmt::print("\n|{}\n", [&] { std::string out; for (std::size_t k = 0; k <= names.size(); ++k) out += " --- |"; return out; }());
    for (const int m : windows) {
        fmt::print("| {} |", m);
        for (const std::string& name : names) fmt::print(" {:.0f} |", times.ns(name, m));
        fmt::print("\n");
    }
    fmt::print("\n| M | fir / best peer, double | fir / best peer, float | fir / moments, double |\n| --- | --- | --- | --- |\n");
    for (const int m : windows) {
        const double eigen_double = std::min(times.ns("eigen rows double", m), times.ns("eigen columns double", m));
        const double peer_float = std::min({times.ns("eigen rows float", m), times.ns("liquid dotprod float", m), times.ns("liquid firfilt float", m)});
        fmt::print("| {} | {:.2f} | {:.2f} | {:.1f} |\n", m, times.ns("fir double", m) / eigen_double, times.ns("fir float", m) / peer_float, times.ns("fir double", m) / times.ns("moments double", m));
    }
    fmt::print("\nMoments cost less than tables where M is above: {}. From 200 to 20000 their cost changes by {:.0f} percent.\n", crossover(times),
               100.0 * (times.ns("moments double", 20000) / times.ns("moments double", 200) - 1.0));
}

void print_motor(const Times& times, const plan::Plan& plan) {
    fmt::print("\nNoisy PMSM, 10 kHz, window and S(t) of 2000 periods; errors: largest over 0.4 to 0.8 s\n\n| estimator | ns a sample | R | L | K |\n| --- | --- | --- | --- | --- |\n");
    const plants::Pmsm motor;
    lab::HostEstimator<double> estimator(plan);
    bench::RecursiveLeastSquares recursive(motor.period, motor.n_p, 2000.0);
    double ours[3] = {}, theirs[3] = {};
    for (std::size_t k = 0; k < noisy_motor().size(); ++k) {
        const plants::PmsmSample& s = noisy_motor()[k];
        const double inputs[] = {s.v_d, s.v_q, s.i_d, s.i_q, s.omega};
        estimator.step(inputs);
        recursive.push(s);
        if (k < 4001) continue;
        const double truth[3] = {motor.R, motor.L, motor.K}, found[3] = {recursive.R(), recursive.L(), recursive.K()};
        for (std::size_t p = 0; p < 3; ++p) {
            ours[p] = std::max(ours[p], std::abs(estimator.parameters()[p] / truth[p] - 1.0));
            theirs[p] = std::max(theirs[p], std::abs(found[p] / truth[p] - 1.0));
        }
    }
    const auto line = [&](const char* name, const double* e) { fmt::print("| {} | {:.0f} | {:.2g} | {:.2g} | {:.2g} |\n", name, times.ns(name), e[0], e[1], e[2]); };
    line("robust, moments", ours);
    line("recursive least squares", theirs);
}

}  // namespace

int main(int argc, char** argv) {
    Diagnostics diagnostics;
    auto plan = generator::plan_from_model(ALGEST_SOURCE "/bench/pmsm_full_window.toml", {plan::Scalar::float64, "moments"}, diagnostics);
    if (!plan) {
        for (const Diagnostic& d : diagnostics.sorted()) fmt::print(stderr, "{}\n", d.text());
        return 1;
    }
    const auto at_windows = [](benchmark::internal::Benchmark* b) { for (const int m : windows) b->Arg(m); };
    at_windows(benchmark::RegisterBenchmark("fir double", fir<double>));
    at_windows(benchmark::RegisterBenchmark("eigen rows double", eigen<double, Eigen::RowMajor>));
    at_windows(benchmark::RegisterBenchmark("eigen columns double", eigen<double, Eigen::ColMajor>));
    at_windows(benchmark::RegisterBenchmark("moments double", moments<double, double>));
    at_windows(benchmark::RegisterBenchmark("fir float", fir<float>));
    at_windows(benchmark::RegisterBenchmark("eigen rows float", eigen<float, Eigen::RowMajor>));
    at_windows(benchmark::RegisterBenchmark("liquid dotprod float", liquid_dotprod));
    at_windows(benchmark::RegisterBenchmark("liquid firfilt float", liquid_firfilt));
    at_windows(benchmark::RegisterBenchmark("moments two floats", moments<float, Twofold<float>>));
    benchmark::RegisterBenchmark("robust, moments", [&](benchmark::State& state) { pmsm_estimator(state, *plan); });
    benchmark::RegisterBenchmark("recursive least squares", recursive_least_squares);
    benchmark::Initialize(&argc, argv);
    Times times;
    benchmark::RunSpecifiedBenchmarks(&times);
    const std::string filter = benchmark::GetBenchmarkFilter();
    if (!filter.empty() && filter != "all") {   // ratios need all of them
        times.print();
        return 0;
    }
    print_windows(times);
    print_motor(times, *plan);
}
