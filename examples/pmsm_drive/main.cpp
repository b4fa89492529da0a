// SPDX-License-Identifier: 0BSD
// A motor under velocity control with wrong constants, until its estimator has found the right ones (Delpoux, Floquet 2015,
// section 4.1). Prints what that changes and writes the run, for figures.gnuplot.
//   pmsm_drive RUN.csv [rotor|stator]      the frame in which a command is held over its period; default rotor
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "drive.hpp"

using namespace pmsm_drive;

namespace {

/// Over [from, to): rms of the velocity error [rad/s], and of the length of the voltage [V].
struct Effort {
    double velocity_error, voltage;
};

Effort effort(const std::vector<Instant>& run, double from, double to) {
    double error = 0.0, voltage = 0.0;
    int count = 0;
    for (const Instant& i : run) {
        if (i.t < from - 0.5 * period || i.t >= to - 0.5 * period) continue;
        error += (i.wanted.omega - i.motor.omega) * (i.wanted.omega - i.motor.omega);
        voltage += i.voltage.d * i.voltage.d + i.voltage.q * i.voltage.q;
        ++count;
    }
    return {std::sqrt(error / count), std::sqrt(voltage / count)};
}

void print_effort(const char* what, double before, double after, const char* unit) {
    std::printf("%-22s  %9.4f  %9.4f  %9.3f  %s\n", what, before, after, before / after, unit);
}

void print_parameter(const char* name, double start, double estimate, double truth, const char* unit) {
    std::printf("%-22s  %9.5f  %9.5f  %9.5f  %8.2f %%  %s\n", name, start, estimate, truth, 100.0 * (estimate / truth - 1.0),
                unit);
}

/// All or nothing: under another name until it is whole.
bool write(const std::vector<Instant>& run, const std::string& path) {
    const std::string part = path + ".part";
    std::ofstream out(part);
    const Motor truth;
    out << "t [s],status,retuned,wanted omega [rad/s],omega [rad/s],v_d [V],v_q [V],i_d [A],i_q [A],R [ohm],L [H],K [N.m/A],"
           "true R [ohm],true L [H],true K [N.m/A]\n";
    for (const Instant& i : run) {
        out << i.t << ',' << (i.fed ? algest::name(i.estimate.status) : "off") << ',' << i.retuned << ',' << i.wanted.omega
            << ',' << i.motor.omega << ',' << i.voltage.d << ',' << i.voltage.q << ',' << i.motor.current.d << ','
            << i.motor.current.q << ',' << i.estimate.R << ',' << i.estimate.L << ',' << i.estimate.K << ',' << truth.R
            << ',' << truth.L << ',' << truth.K << '\n';
    }
    out.close();
    if (out && std::rename(part.c_str(), path.c_str()) == 0) return true;
    std::remove(part.c_str());
    return false;
}

}  // namespace

int main(int count, char** words) {
    const std::string hold = count == 3 ? words[2] : "rotor";
    if (count < 2 || count > 3 || (hold != "rotor" && hold != "stator")) {
        std::fprintf(stderr, "usage: pmsm_drive RUN.csv [rotor|stator]\n");
        return 2;
    }
    const std::vector<Instant> all = run(hold == "rotor" ? Hold::rotor_frame : Hold::stator_frame);
    const Instant& first = all.front();
    const Instant& last = all.back();
    double retuned_at = duration;
    for (const Instant& i : all) {
        if (i.retuned && i.t < retuned_at) retuned_at = i.t;
    }

    // Whole periods of the reference: two with the wrong constants, two after the one in which the change dies away.
    const Effort before = effort(all, fed_from, fed_from + 2.0 * reference_period);
    const Effort after = effort(all, duration - 2.0 * reference_period, duration);
    std::printf("estimator fed from %.4f s, controller retuned from %.4f s on; commands held in the %s frame\n\n", fed_from,
                retuned_at, hold.c_str());
    std::printf("%-22s  %9s  %9s  %9s  %s\n", "", "before", "after", "ratio", "unit");
    print_effort("rms velocity error", before.velocity_error, after.velocity_error, "rad/s");
    print_effort("rms voltage", before.voltage, after.voltage, "V");
    std::printf("\n%-22s  %9s  %9s  %9s  %10s  %s\n", "parameter", "start", "estimate", "truth", "error", "unit");
    const Motor truth;
    print_parameter("R", first.estimate.R, last.estimate.R, truth.R, "ohm");
    print_parameter("L", first.estimate.L, last.estimate.L, truth.L, "H");
    print_parameter("K", first.estimate.K, last.estimate.K, truth.K, "N.m/A");
    std::printf("status of the last sample: %s, condition %.1f\n", algest::name(last.estimate.status),
                last.estimate.condition);
    if (!write(all, words[1])) {
        std::fprintf(stderr, "pmsm_drive: cannot write %s\n", words[1]);
        return 2;
    }
    return last.estimate.status == algest::Status::ok ? 0 : 1;
}
