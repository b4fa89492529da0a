// SPDX-License-Identifier: 0BSD
// A drive train is identified in 1.35 s, then a loop-shaping controller is built from its poles (Fliess, Fuchshumer, Schlacher, Sira-Ramirez
// 2006, section VI). Prints what was found and what the loop does, and writes all of it, for figures.gnuplot.
//   drive_train RUN.txt
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <string>

#include "closed_loop.hpp"

using namespace drive_train;

namespace {

using Complex = std::complex<double>;

/// The drive train itself behind a hold, at the frequency that Omega stands for; what lies above half the sampling rate is left out.
Complex true_response(double Omega) {
    const Constants c;
    const double w = 2.0 / period * std::atan(0.5 * Omega * period);
    const Complex s(0.0, w);
    const auto pair = [&](double omega, double xi) { return 1.0 + 2.0 * xi * s / omega + s * s / (omega * omega); };
    const Complex hold = (1.0 - std::exp(-s * period)) / (s * period);
    return c.V / ((1.0 + s / c.corner) * pair(c.omega_1, c.xi_1) * pair(c.omega_2, c.xi_2)) * hold;
}

std::vector<Complex> true_poles() {
    const Constants c;
    const auto q_of = [](Complex s) { return omega0(period) * std::tanh(s / omega0(period)); };
    std::vector<Complex> out = {q_of(-c.corner)};
    for (const Pair& p : {Pair{c.omega_1, c.xi_1}, Pair{c.omega_2, c.xi_2}}) {
        const Complex s = p.omega * Complex(-p.xi, std::sqrt(1.0 - p.xi * p.xi));
        out.push_back(q_of(s));
        out.push_back(std::conj(out.back()));
    }
    return out;
}

/// Real pole, then frequency and damping of the slow and the fast pair; what is not there is NaN.
std::vector<double> described(const std::vector<Complex>& poles) {
    std::vector<Pair> pairs;
    double real = std::nan("");
    for (const Complex q : poles) {
        if (q.imag() > 1e-9 * std::abs(q)) pairs.push_back({std::abs(q), -q.real() / std::abs(q)});
        else if (std::abs(q.imag()) <= 1e-9 * std::abs(q)) real = -q.real();
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.omega < b.omega; });
    pairs.resize(2, {std::nan(""), std::nan("")});
    return {real, pairs[0].omega, pairs[0].xi, pairs[1].omega, pairs[1].xi};
}

void print_poles(const Identification& found) {
    const std::vector<double> truth = described(true_poles());
    const std::vector<double> preset = described(roots(transfer_of(found.preset).denominator));
    const std::vector<double> all = described(roots(transfer_of(found.all).denominator));
    std::printf("\n%-24s  %12s  %12s  %12s  %s\n", "poles of q", "preset zeros", "all zeros", "truth", "unit");
    const char* const names[] = {"real pole", "slow pair", "damping of the slow", "fast pair", "damping of the fast"};
    for (std::size_t k = 0; k < truth.size(); ++k) std::printf("%-24s  %12.4f  %12.4f  %12.4f  %s\n", names[k], preset[k], all[k], truth[k], k % 2 == 0 && k > 0 ? "1" : "rad/s");
}

void print_loop(const std::vector<Instant>& with, const std::vector<Instant>& without) {
    std::printf("\n%-24s  %12s  %12s  %s\n", "closed loop", "notches", "PI alone", "unit");
    const auto print = [](const char* name, double a, double b, const char* unit) { std::printf("%-24s  %12.4g  %12.4g  %s\n", name, a, b, unit); };
    print("overshoot", 100.0 * overshoot(with), 100.0 * overshoot(without), "%");
    print("steady-state error", 100.0 * steady_state(with), 100.0 * steady_state(without), "%");
    const Constants c;
    print("energy around 12.4", energy_around(c.omega_1, with), energy_around(c.omega_1, without), "rad^2/s");
    print("energy around 27.7", energy_around(c.omega_2, with), energy_around(c.omega_2, without), "rad^2/s");
}

void write_roots(std::ofstream& out, const char* what, const std::vector<Complex>& of) {
    for (const Complex q : of) out << what << ' ' << q.real() << ' ' << q.imag() << '\n';
}

/// Four blocks, as gnuplot's `index` counts them; under another name until the file is whole.
bool write(const Identification& found, const Design& design, const std::vector<Instant>& with, const std::vector<Instant>& without, const std::string& path) {
    const std::string part = path + ".part";
    std::ofstream out(part);
    const Transfer all = transfer_of(found.all);
    const Transfer preset = transfer_of(found.preset);
    out << "# t [s], u [V], measured speed, speed of the model with all zeros, with preset zeros [rad/s]\n";
    Filter model_all(all, period);
    Filter model_preset(preset, period);
    for (std::size_t k = 0; k < found.u.size(); ++k) {
        out << static_cast<double>(k) * period << ' ' << found.u[k] << ' ' << found.measured[k] << ' ' << model_all.step(found.u[k]) << ' ' << model_preset.step(found.u[k]) << '\n';
    }
    out << "\n\n# roots of q [rad/s]: what, real part, imaginary part\n";
    write_roots(out, "true_pole", true_poles());
    write_roots(out, "all_pole", roots(all.denominator));
    write_roots(out, "all_zero", roots(all.numerator));
    write_roots(out, "preset_pole", roots(preset.denominator));
    out << "\n\n# frequency [rad/s]; magnitude [dB] and phase [deg] of the truth, of the model with all zeros, with preset zeros, of N1, N2, and of the open loop\n";
    for (double w = 1.0; w < 100.0; w *= 1.01) {
        const Complex open = response(preset, w, period) * response(design.pi, w, period) * response(design.notches[0], w, period) * response(design.notches[1], w, period);
        out << w;
        for (const Complex g : {true_response(w), response(all, w, period), response(preset, w, period), response(design.notches[0], w, period), response(design.notches[1], w, period), open}) {
            out << ' ' << 20.0 * std::log10(std::abs(g)) << ' ' << std::arg(g) * 180.0 / std::acos(-1.0);
        }
        out << '\n';
    }
    out << "\n\n# t [s], wanted speed, speed, speed without notches [rad/s], u, u without notches [V]\n";
    for (std::size_t k = 0; k < with.size(); ++k) {
        out << with[k].t << ' ' << with[k].wanted << ' ' << with[k].omega << ' ' << without[k].omega << ' ' << with[k].u << ' ' << without[k].u << '\n';
    }
    out.close();
    if (out && std::rename(part.c_str(), path.c_str()) == 0) return true;
    std::remove(part.c_str());
    return false;
}

}  // namespace

int main(int count, char** words) {
    if (count != 2) {
        std::fprintf(stderr, "usage: drive_train RUN.txt\n");
        return 2;
    }
    const Identification found = identify();
    std::printf("identified in %.2f s at %.0f ms: %s, condition %.1e with preset zeros, %.1e with all four\n", identification_time, 1e3 * period,
                algest::name(found.preset.status), found.preset.condition, found.all.condition);
    if (found.preset.status != algest::Status::ok) return 1;
    print_poles(found);
    const auto designed = design(transfer_of(found.preset));
    if (!designed) {
        std::printf("no controller: it needs two pairs of stable poles\n");
        return 1;
    }
    const std::vector<Instant> with = run(*designed, true);
    const std::vector<Instant> without = run(*designed, false);
    print_loop(with, without);
    if (!write(found, *designed, with, without, words[1])) {
        std::fprintf(stderr, "drive_train: cannot write %s\n", words[1]);
        return 2;
    }
    return 0;
}
