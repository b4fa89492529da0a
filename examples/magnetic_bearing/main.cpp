// SPDX-License-Identifier: 0BSD
// A shaft on an ellipse in a magnetic bearing: the controller's force constants are wrong until its estimator has found the right
// ones (Delpoux, Floquet 2015, section 4.2). Prints what that changes and writes the run, for figures.gnuplot.
//   magnetic_bearing RUN.csv
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "levitation.hpp"

using namespace magnetic_bearing;

namespace {

/// What stands out of five turns: half the distance between largest and smallest, mean, and rms.
struct Swing {
    double amplitude, mean, rms;
};

/// quantity(instant) over [from, from + 5 turns).
template <class Quantity>
Swing swing(const std::vector<Instant>& run, double from, Quantity quantity) {
    const std::size_t first = static_cast<std::size_t>(from / period + 0.5);
    const std::size_t count = static_cast<std::size_t>(5.0 * turn / period + 0.5);
    double smallest = quantity(run[first]), largest = smallest, sum = 0.0, squares = 0.0;
    for (std::size_t k = first; k < first + count; ++k) {
        const double x = quantity(run[k]);
        smallest = std::min(smallest, x);
        largest = std::max(largest, x);
        sum += x;
        squares += x * x;
    }
    const double n = static_cast<double>(count);
    return {0.5 * (largest - smallest), sum / n, std::sqrt(squares / n)};
}

void print_change(const char* what, double before, double after, const char* unit) {
    std::printf("%-26s  %9.3f  %9.3f  %9.3f  %s\n", what, before, after, before / after, unit);
}

/// All or nothing: under another name until it is whole.
bool write(const std::vector<Instant>& run, const std::string& path) {
    const std::string part = path + ".part";
    std::ofstream out(part);
    const PerMagnet truth = Bearing().lambda;
    out << "t [s],status,retuned,wanted y [m],y [m],wanted z [m],z [m],perturbation y [N],perturbation z [N],i1 [A],i2 "
           "[A],i3 [A],"
           "lambda1 [N.m^2/A^2],lambda2 [N.m^2/A^2],lambda3 [N.m^2/A^2],"
           "true lambda1 [N.m^2/A^2],true lambda2 [N.m^2/A^2],true lambda3 [N.m^2/A^2]\n";
    for (const Instant& i : run) {
        out << i.t << ',' << (i.fed ? algest::name(i.estimate.status) : "off") << ',' << i.retuned << ','
            << i.wanted.position.y << ',' << i.shaft.position.y << ',' << i.wanted.position.z << ',' << i.shaft.position.z
            << ',' << i.perturbation.y << ',' << i.perturbation.z;
        for (const double current : i.current) out << ',' << current;
        for (const double l : lambda(i.estimate)) out << ',' << l;
        for (const double l : truth) out << ',' << l;
        out << '\n';
    }
    out.close();
    if (out && std::rename(part.c_str(), path.c_str()) == 0) return true;
    std::remove(part.c_str());
    return false;
}

}  // namespace

int main(int count, char** words) {
    if (count != 2) {
        std::fprintf(stderr, "usage: magnetic_bearing RUN.csv\n");
        return 2;
    }
    const std::vector<Instant> all = run();
    double retuned_at = duration;
    for (const Instant& i : all) {
        if (i.retuned && i.t < retuned_at) retuned_at = i.t;
    }

    // Five turns each, those of the paper's figure 11: with the wrong constants, and after the change has died away.
    const auto change = [&](const char* what, auto quantity, double Swing::*of, double scale, const char* unit) {
        print_change(what, scale * (swing(all, 0.2, quantity).*of), scale * (swing(all, 0.6, quantity).*of), unit);
    };
    std::printf("estimator fed from %.4f s, controller retuned from %.4f s on\n\n", fed_from, retuned_at);
    std::printf("%-26s  %9s  %9s  %9s  %s\n", "", "before", "after", "ratio", "unit");
    change(
        "perturbation y, amplitude", [](const Instant& i) { return i.perturbation.y; }, &Swing::amplitude, 1.0, "N");
    change(
        "perturbation z, amplitude", [](const Instant& i) { return i.perturbation.z; }, &Swing::amplitude, 1.0, "N");
    change(
        "perturbation y, mean", [](const Instant& i) { return i.perturbation.y; }, &Swing::mean, 1.0, "N");
    change(
        "perturbation z, mean", [](const Instant& i) { return i.perturbation.z; }, &Swing::mean, 1.0, "N");
    change(
        "rms tracking error y", [](const Instant& i) { return i.wanted.position.y - i.shaft.position.y; }, &Swing::rms, 1e6,
        "um");
    change(
        "rms tracking error z", [](const Instant& i) { return i.wanted.position.z - i.shaft.position.z; }, &Swing::rms, 1e6,
        "um");
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string what = "rms current " + std::to_string(k + 1);
        change(
            what.c_str(), [k](const Instant& i) { return i.current[k]; }, &Swing::rms, 1.0, "A");
    }

    std::printf("\n%-10s  %10s  %10s  %10s  %10s  %s\n", "parameter", "start", "estimate", "truth", "error", "unit");
    const PerMagnet start = lambda(all.front().estimate), estimate = lambda(all.back().estimate), truth = Bearing().lambda;
    for (std::size_t k = 0; k < 3; ++k) {
        std::printf("lambda%zu     %10.3e  %10.3e  %10.3e  %8.2f %%  N.m^2/A^2\n", k + 1, start[k], estimate[k], truth[k],
                    100.0 * (estimate[k] / truth[k] - 1.0));
    }
    const auto& last = all.back().estimate;
    std::printf("status of the last sample: %s, condition %.1f\n", algest::name(last.status), last.condition);
    if (!write(all, words[1])) {
        std::fprintf(stderr, "magnetic_bearing: cannot write %s\n", words[1]);
        return 2;
    }
    return last.status == algest::Status::ok ? 0 : 1;
}
