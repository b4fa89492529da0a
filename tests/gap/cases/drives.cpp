// SPDX-License-Identifier: GPL-3.0-or-later
// Electrical drives: brushed motor, PMSM in a speed loop, voice coil, inductive load on a bridge.
#include <algorithm>
#include <cmath>

#include "excitation.hpp"
#include "families.hpp"
#include "rounding.hpp"

namespace algest::gap {

System dc_motor(const Wish& wish, Random& random, bool angle) {
    System s;
    s.summary = "brushed DC motor, open-loop voltage";
    s.period = random.chance(0.7) ? 1e-3 : 2e-3;
    s.duration = wish.one_speed ? 5 : random.integer(6, 12);
    const double R = rounded(random.log_uniform(0.4, 4), 2);
    const double L = rounded(R * random.uniform(1.5, 4) * s.period, 2);
    const double K = rounded(random.log_uniform(0.02, 0.15), 2);
    const double J = rounded(random.log_uniform(0.03, 0.15) * K * K / R, 2);  // mechanical time constant
    const bool no_viscous = wish.effect == "viscous_friction", no_emf = wish.effect == "back_emf";
    const double b = rounded(random.log_uniform(0.03, 0.15) * K * K / R, 2);
    const double U = random.log_uniform(6, 40);
    const double current = 0.25 * U / R, speed = 0.4 * U / K;
    // Without the induced voltage the model has b alone to hold the speed: K moves the machine, and is known.
    s.quantities = {
        {"R", "ohm", R, wish.one_speed}, {"L", "H", L, true}, {"K", "N.m/A", K, true}, {"J", "kg.m^2", J, wish.one_speed}};
    if (!no_viscous) s.quantities.push_back({"b", "N.m.s/rad", b, wish.one_speed});
    s.inputs = {"u"};
    s.initial = {0, 0, 0};
    s.typical = {current, speed, speed};
    s.signals = {{"u", "V", -1, 0}, {"i", "A", 0}, {"w", "rad/s", 1}};
    s.equations = {{"voltage balance of i", "i", no_emf ? "L*der(i) = u - R*i" : "L*der(i) = u - R*i - K*w"},
                   {"torque balance of w", "w", no_viscous ? "J*der(w) = K*i" : "J*der(w) = K*i - b*w"}};
    if (angle) {
        s.signals.push_back({"th", "rad", 2, -1, false, 0.001});
        s.equations.push_back({"kinematic of th", "th", "der(th) = w"});
    } else {
        s.initial.resize(2);
        s.typical.resize(2);
    }
    s.rate = [no_viscous, no_emf, angle](const double* x, const double* u, const double* p, const double* added,
                                         double* rate) {
        rate[0] = (u[0] - p[0] * x[0] - (no_emf ? 0.0 : p[2] * x[1]) + added[0]) / p[1];
        rate[1] = (p[2] * x[0] - (no_viscous ? 0.0 : p[4] * x[1]) + added[1]) / p[3];
        if (angle) rate[2] = x[1];
    };
    Slot voltage{Kind::voltage, 0, 0.4 * U};
    voltage.current = {0, -1, "i"};
    voltage.speed = {1, -1, "w"};
    Slot torque{Kind::torque, 1, K * current};
    torque.speed = {1, -1, "w"};
    torque.viscous = b;
    if (angle) torque.angle = {2, -1, "th"};
    s.slots = {voltage, torque};
    const std::size_t n = s.samples();
    if (wish.one_speed) {
        const double level = rounded(random.uniform(0.4, 0.9) * U, 2);
        s.experiment = play({std::vector<double>(n, level)});
    } else {
        s.experiment = play({scaled(excitation(random, n, s.period, 0.15, 4), U, random.chance(0.5) ? 0 : 0.05 * U)});
    }
    return s;
}

System pmsm(const Wish& wish, Random& random) {
    System s;
    s.summary = "PMSM in the d-q frame; a speed loop with sinusoidal reference and current loops chose vd,vq (logged)";
    s.period = 5e-4;
    s.duration = random.integer(5, 8);
    const double R = rounded(random.log_uniform(0.3, 2), 2), L = rounded(R * random.uniform(3e-3, 7e-3), 2);
    const double pp = random.integer(2, 7), psi = rounded(random.log_uniform(0.015, 0.08), 2);
    const double Kt = 1.5 * pp * psi;
    const double current = random.log_uniform(1, 4), speed = random.log_uniform(15, 80);
    const double J =
        rounded(Kt * current / (speed * random.uniform(8, 20)), 2);  // reaches its speed in about a tenth of a second
    const bool no_viscous = wish.effect == "viscous_friction";
    const double b = rounded(random.uniform(0.1, 0.3) * Kt * current / speed, 2);
    s.quantities = {{"R", "ohm", R, false},
                    {"L", "H", L, false},
                    {"J", "kg.m^2", J, false},
                    {"pp", "1", pp, true},
                    {"psi", "Wb", psi, true}};
    if (!no_viscous) s.quantities.insert(s.quantities.begin() + 3, {"b", "N.m.s/rad", b, false});
    s.inputs = {"vd", "vq"};
    s.initial = {0, 0, 0, 0};
    s.typical = {current, current, speed, speed};
    s.signals = {{"vd", "V", -1, 0}, {"vq", "V", -1, 1}, {"id", "A", 0},
                 {"iq", "A", 1},     {"w", "rad/s", 2},  {"th", "rad", 3, -1, false, 0.001}};
    s.equations = {{"voltage balance of id", "id", "L*der(id) = vd - R*id + pp*w*L*iq"},
                   {"voltage balance of iq", "iq", "L*der(iq) = vq - R*iq - pp*w*L*id - pp*w*psi"},
                   {"torque balance of w", "w", no_viscous ? "J*der(w) = 1.5*pp*psi*iq" : "J*der(w) = 1.5*pp*psi*iq - b*w"},
                   {"kinematic of th", "th", "der(th) = w"}};
    s.rate = [no_viscous](const double* x, const double* u, const double* p, const double* added, double* rate) {
        const double Rs = p[0], Ls = p[1], Js = p[2], bs = no_viscous ? 0 : p[3], poles = p[no_viscous ? 3 : 4],
                     flux = p[no_viscous ? 4 : 5];
        rate[0] = (u[0] - Rs * x[0] + poles * x[2] * Ls * x[1] + added[0]) / Ls;
        rate[1] = (u[1] - Rs * x[1] - poles * x[2] * Ls * x[0] - poles * x[2] * flux + added[1]) / Ls;
        rate[2] = (1.5 * poles * flux * x[1] - bs * x[2] + added[2]) / Js;
        rate[3] = x[2];
    };
    Slot d{Kind::voltage, 0, R * current}, q{Kind::voltage, 1, R * current + pp * psi * speed},
        torque{Kind::torque, 2, Kt * current * 0.5};
    d.current = {0, -1, "id"};
    q.current = {1, -1, "iq"};
    d.angle = q.angle = torque.angle = {3, -1, "th"};
    q.speed = torque.speed = {2, -1, "w"};
    torque.viscous = b;
    s.slots = {d, q, torque};
    const std::size_t n = s.samples();
    std::vector<double> reference = sines(random, n, s.period, 2, 0.4, 3);
    const std::vector<double> level = steps(random, n, s.period, 0.6);
    const bool stepped = random.chance(0.5);
    for (std::size_t k = 0; k < n; ++k)
        reference[k] = speed * ((stepped ? 0.6 : 0.9) * reference[k] + (stepped ? 0.7 * level[k] : 0.0));
    std::vector<double> direct = sines(random, n, s.period, 2, 2, 12);
    for (double& v : direct) v = current * (-0.6 + 0.6 * v);
    const double kv = 1200 * L, step = rounded((R * current + pp * psi * speed) * 1e-3, 1), T = s.period, peak = 3 * current;
    s.experiment = [=]() -> Controller {
        double sum_w = 0, sum_d = 0, sum_q = 0;
        return [=](std::size_t k, const State& x, std::vector<double>& u) mutable {
            const double e = reference[k] - x[2];
            const double wanted = std::clamp(J / Kt * (40 * e + 150 * sum_w), -peak, peak);
            if (std::abs(wanted) < peak) sum_w += T * e;
            const double ed = direct[k] - x[0], eq = wanted - x[1];
            sum_d += T * ed;
            sum_q += T * eq;
            u[0] = step * std::round((0.3 * kv * ed + 150 * R * sum_d) / step);
            u[1] = step * std::round((0.3 * kv * eq + 150 * R * sum_q) / step);
        };
    };
    return s;
}

System voice_coil(const Wish& wish, Random& random) {
    System s;
    s.summary = "voice-coil actuator on a flexure, driven by an amplifier";
    s.period = 5e-4;
    s.duration = random.integer(4, 6);
    const double R = rounded(random.log_uniform(2, 10), 2), L = rounded(R * random.uniform(1e-3, 3e-3), 2);
    const double Kf = rounded(random.log_uniform(4, 20), 2), m = rounded(random.log_uniform(0.05, 0.4), 2);
    const double natural = 2 * M_PI * random.log_uniform(4, 12);
    const double k = rounded(m * natural * natural, 2);
    const bool no_viscous = wish.effect == "viscous_friction", no_emf = wish.effect == "back_emf";
    const double c = rounded(2 * random.uniform(0.08, 0.2) * m * natural, 2);
    const double U = random.log_uniform(5, 24), force = 0.4 * Kf * U / R;
    s.quantities = {
        {"R", "ohm", R, false}, {"L", "H", L, true}, {"Kf", "N/A", Kf, true}, {"m", "kg", m, true}, {"k", "N/m", k, false}};
    if (!no_viscous) s.quantities.push_back({"c", "N.s/m", c, false});
    s.inputs = {"u"};
    s.initial = {0, 0, 0};
    s.typical = {0.4 * U / R, force / k, force / k * natural};
    s.signals = {{"u", "V", -1, 0}, {"i", "A", 0}, {"x", "m", 1}, {"v", "m/s", 2}};
    s.equations = {{"voltage balance of i", "i", no_emf ? "L*der(i) = u - R*i" : "L*der(i) = u - R*i - Kf*v"},
                   {"kinematic of x", "x", "der(x) = v"},
                   {"force balance of v", "v", no_viscous ? "m*der(v) = Kf*i - k*x" : "m*der(v) = Kf*i - k*x - c*v"}};
    s.rate = [no_viscous, no_emf](const double* x, const double* u, const double* p, const double* added, double* rate) {
        rate[0] = (u[0] - p[0] * x[0] - (no_emf ? 0.0 : p[2] * x[2]) + added[0]) / p[1];
        rate[1] = x[2];
        rate[2] = (p[2] * x[0] - p[4] * x[1] - (no_viscous ? 0.0 : p[5] * x[2]) + added[1]) / p[3];
    };
    Slot voltage{Kind::voltage, 0, 0.5 * U}, push{Kind::force, 2, force};
    voltage.current = {0, -1, "i"};
    voltage.speed = push.speed = {2, -1, "v"};
    push.position = {1, -1, "x"};
    push.viscous = c;
    s.slots = {voltage, push};
    s.experiment = play({scaled(excitation(random, s.samples(), s.period, 0.6, 18), U)});
    return s;
}

System bridge_load(const Wish& wish, Random& random) {
    System s;
    s.summary = "inductive load on a half bridge, duty cycle logged, averaged over the switching period";
    s.period = 1e-4;
    s.duration = 1;
    const double R = rounded(random.log_uniform(0.5, 5), 2), L = rounded(R * random.uniform(3e-3, 12e-3), 2),
                 U = rounded(random.uniform(12, 60), 2);
    s.quantities = {{"R", "ohm", R, false}, {"L", "H", L, false}, {"Vin", "V", U, true}};
    s.inputs = {"d"};
    s.initial = {0};
    s.typical = {0.3 * U / R};
    s.signals = {{"d", "1", -1, 0}, {"i", "A", 0}};
    s.equations = {{"voltage balance of i", "i", "L*der(i) = d*Vin - R*i"}};
    s.rate = [](const double* x, const double* u, const double* p, const double* added, double* rate) {
        rate[0] = (u[0] * p[2] - p[0] * x[0] + added[0]) / p[1];
    };
    Slot voltage{Kind::voltage, 0, 0.4 * U};
    voltage.current = {0, -1, "i"};
    s.slots = {voltage};
    s.experiment = play(
        {scaled(excitation(random, s.samples(), s.period, 3, 60), wish.one_speed ? 0.2 : 0.6, wish.one_speed ? 0.5 : 0.0)});
    return s;
}

}  // namespace algest::gap
