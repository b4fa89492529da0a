// SPDX-License-Identifier: GPL-3.0-or-later
// Fluids and heat: a motor with a hydraulic pump, a heated plate, two tanks.
#include <algorithm>
#include <cmath>

#include "excitation.hpp"
#include "families.hpp"
#include "rounding.hpp"

namespace algest::gap {

namespace {

std::vector<double> above(std::vector<double> values, double least) {
    for (double& v : values) v = std::max(v, least);
    return values;
}

}  // namespace

System pump(const Wish& wish, Random& random) {
    System s;
    s.summary = "DC motor driving a fixed-displacement hydraulic pump against a controlled valve";
    s.period = 1e-3;
    s.duration = random.integer(8, 12);
    const double R = rounded(random.uniform(0.5, 1.2), 2), L = rounded(R * random.uniform(2.5e-3, 5e-3), 2),
                 K = rounded(random.uniform(0.2, 0.4), 2);
    const double J = rounded(random.uniform(0.015, 0.03) * K * K / R, 2),
                 b = rounded(random.uniform(0.015, 0.03) * K * K / R, 2);
    const double D = rounded(random.uniform(0.3, 0.8), 2), C = rounded(random.uniform(3, 8), 2);
    const double speed = random.uniform(80, 150), pressure = random.uniform(0.6, 1.5);
    const double kv = rounded(D * speed / std::sqrt(pressure), 2), current = D * pressure / K;
    const double U = K * speed + R * current;
    s.quantities = {{"R", "ohm", R, false},      {"L", "H", L, true},          {"K", "N.m/A", K, true},
                    {"J", "kg.m^2", J, false},   {"b", "N.m.s/rad", b, false}, {"D", "cm^3/rad", D, true},
                    {"C", "cm^3/MPa", C, false}, {"kv", "", kv, false}};
    (void)wish;
    s.inputs = {"u", "s"};
    s.initial = {0, 0, 1e-4};
    s.typical = {current, speed, pressure};
    s.signals = {{"u", "V", -1, 0}, {"s", "1", -1, 1}, {"i", "A", 0}, {"w", "rad/s", 1}, {"P", "MPa", 2}};
    s.equations = {{"voltage balance of i", "i", "L*der(i) = u - R*i - K*w"},
                   {"torque balance of w", "w", "J*der(w) = K*i - b*w - D*P"},
                   {"flow balance of P", "P", "C*der(P) = D*w - kv*s*sqrt(P)"}};
    s.rate = [](const double* x, const double* u, const double* p, const double* added, double* rate) {
        rate[0] = (u[0] - p[0] * x[0] - p[2] * x[1] + added[0]) / p[1];
        rate[1] = (p[2] * x[0] - p[4] * x[1] - p[5] * x[2] + added[1]) / p[3];
        rate[2] = (p[5] * x[1] - p[7] * u[1] * std::sqrt(std::max(x[2], 0.0)) + added[2]) / p[6];
    };
    Slot voltage{Kind::voltage, 0, 0.3 * U}, torque{Kind::torque, 1, D * pressure}, flow{Kind::flow, 2, D * speed};
    voltage.current = {0, -1, "i"};
    voltage.speed = torque.speed = {1, -1, "w"};
    voltage.excluded = {"back_emf"};
    torque.excluded = {"viscous_friction"};
    flow.level = {2, -1, "P"};
    s.slots = {voltage, torque, flow};
    const std::size_t n = s.samples();
    s.experiment = play({above(scaled(excitation(random, n, s.period, 0.2, 3), 0.45 * U, U), 0.5 * U),
                         above(scaled(excitation(random, n, s.period, 0.2, 2), 0.4, 0.9), 0.4)});
    return s;
}

System thermal(const Wish& wish, Random& random, int masses) {
    System s;
    s.summary = masses == 1 ? "heated plate" : "heater and plate, two thermal masses";
    s.period = random.chance(0.5) ? 0.5 : 1;
    const double tau = random.uniform(80, 250);
    s.duration = std::round(tau * random.uniform(12, 20));
    const double loss = rounded(random.log_uniform(0.3, 3), 2), C1 = rounded(loss * tau * (masses == 1 ? 1 : 0.3), 2);
    const double C2 = rounded(loss * tau * 0.7, 2), link = rounded(loss * random.uniform(2, 5), 2);
    const double rise = random.uniform(25, 60), U = random.uniform(8, 24), gain = rounded(loss * rise / (0.5 * U), 2);
    const double ambient = random.integer(18, 26);
    s.inputs = {"u"};
    s.quantities = {
        {"C1", "J/K", C1, false}, {"h", "W/K", loss, false}, {"kh", "W/V", gain, false}, {"Ta", "degC", ambient, true}};
    s.signals = {{"u", "V", -1, 0}, {"T1", "degC", 0}};
    Slot heat{Kind::heat, 0, loss * rise};
    heat.input = 0;
    if (masses == 1) {
        s.initial = {ambient};
        s.typical = {rise};
        s.equations = {{"heat balance of T1", "T1", "C1*der(T1) = kh*u - h*(T1-Ta)"}};
        s.rate = [](const double* x, const double* u, const double* p, const double* added, double* rate) {
            rate[0] = (p[2] * u[0] - p[1] * (x[0] - p[3]) + added[0]) / p[0];
        };
        // What a single mass cannot tell from the power of its heater scale: kh is then read from its rating plate.
        s.quantities[2].known = random.chance(0.5);
        heat.position = {0, -1, "T1"};
        s.slots = {heat};
    } else {
        s.quantities.insert(s.quantities.end(), {{"C2", "J/K", C2, false}, {"g", "W/K", link, false}});
        s.quantities[2].known = true;
        s.initial = {ambient, ambient};
        s.typical = {rise, rise};
        s.signals.push_back({"T2", "degC", 1});
        s.equations = {{"heat balance of T1", "T1", "C1*der(T1) = kh*u - g*(T1-T2)"},
                       {"heat balance of T2", "T2", "C2*der(T2) = g*(T1-T2) - h*(T2-Ta)"}};
        s.rate = [](const double* x, const double* u, const double* p, const double* added, double* rate) {
            const double through = p[5] * (x[0] - x[1]);
            rate[0] = (p[2] * u[0] - through + added[0]) / p[0];
            rate[1] = (through - p[1] * (x[1] - p[3]) + added[1]) / p[4];
        };
        Slot plate{Kind::heat, 1, loss * rise};
        plate.position = {1, -1, "T2"};
        s.slots = {heat, plate};
    }
    (void)wish;
    const std::size_t n = s.samples();
    s.experiment = play({above(scaled(excitation(random, n, s.period, 0.15 / tau, 3 / tau), 0.5 * U, 0.5 * U), 0)});
    return s;
}

System tanks(const Wish& wish, Random& random) {
    System s;
    s.summary = "two tanks in a row, a pump fills the upper one";
    s.period = random.chance(0.5) ? 0.1 : 0.2;
    const double A1 = rounded(random.log_uniform(0.005, 0.05), 2), A2 = rounded(A1 * random.uniform(0.7, 1.5), 2);
    const double level = random.uniform(0.15, 0.5), tau = random.uniform(8, 25);
    s.duration = std::round(tau * random.uniform(12, 22));
    const double flow = A1 * level / tau, a1 = rounded(flow / std::sqrt(level), 2),
                 a2 = rounded(a1 * random.uniform(0.8, 1.2), 2);
    const double U = random.uniform(4, 10), kp = rounded(flow / U, 2);
    const double h1 = rounded(level * random.uniform(0.6, 1.2), 2), h2 = rounded(level * random.uniform(0.6, 1.2), 2);
    s.quantities = {{"a1", "", a1, false},
                    {"a2", "", a2, false},
                    {"kp", "m^3/s/V", kp, false},
                    {"S1", "m^2", A1, true},
                    {"S2", "m^2", A2, true}};
    (void)wish;
    s.inputs = {"u"};
    s.initial = {h1, h2};
    s.typical = {level, level};
    s.signals = {{"u", "V", -1, 0}, {"h1", "m", 0}, {"h2", "m", 1}};
    s.equations = {{"flow balance of h1", "h1", "S1*der(h1) = kp*u - a1*sqrt(h1)"},
                   {"flow balance of h2", "h2", "S2*der(h2) = a1*sqrt(h1) - a2*sqrt(h2)"}};
    s.rate = [](const double* x, const double* u, const double* p, const double* added, double* rate) {
        const double over = p[0] * std::sqrt(std::max(x[0], 0.0));
        rate[0] = (p[2] * u[0] - over + added[0]) / p[3];
        rate[1] = (over - p[1] * std::sqrt(std::max(x[1], 0.0)) + added[1]) / p[4];
    };
    Slot upper{Kind::flow, 0, flow}, lower{Kind::flow, 1, flow};
    upper.level = {0, -1, "h1"};
    lower.level = {1, -1, "h2"};
    lower.excluded = {"orifice_leak"};  // the same term as the outlet
    s.slots = {upper, lower};
    s.experiment =
        play({above(scaled(excitation(random, s.samples(), s.period, 0.15 / tau, 3 / tau), 0.45 * U, 1.1 * U), 0.3 * U)});
    return s;
}

}  // namespace algest::gap
