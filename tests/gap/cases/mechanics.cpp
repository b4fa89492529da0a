// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanics: magnetic bearing, two-mass drive, mass and spring, arm, servo axis, quarter car.
#include <algorithm>
#include <cmath>
#include <string>

#include "excitation.hpp"
#include "families.hpp"
#include "rounding.hpp"

namespace algest::gap {

System magnetic_bearing(const Wish&, Random& random) {
    System s;
    s.summary = "one-axis magnetic bearing, linearised force, stabilised by a known controller";
    s.period = 2e-4;
    s.duration = random.integer(3, 4);
    const double m = rounded(random.log_uniform(0.8, 5), 2), ki = rounded(random.log_uniform(30, 200), 2);
    const double stiffness = random.uniform(150, 300);  // rad/s in closed loop
    const double ks = rounded(m * stiffness * stiffness * random.uniform(0.3, 0.8), 2);
    const double Kp = rounded((ks + m * stiffness * stiffness) / ki, 2),
                 Kd = rounded(2 * random.uniform(0.35, 0.6) * m * stiffness / ki, 2);
    const double gap = random.log_uniform(4e-5, 2e-4);
    s.quantities = {{"ki", "N/A", ki, false},
                    {"ks", "N/m", ks, false},
                    {"m", "kg", m, true},
                    {"Kp", "", Kp, true},
                    {"Kd", "", Kd, true}};
    s.inputs = {"ic", "r", "exc"};
    s.initial = {0, 0};
    s.typical = {gap, gap * stiffness};
    s.signals = {{"ic", "A", -1, 0}, {"r", "m", -1, 1}, {"exc", "A", -1, 2}, {"x", "m", 0}};
    s.equations = {{"force balance of x", "x", "m*der(x,2) = ki*ic + ks*x"}};
    s.rate = [](const double* x, const double* u, const double* p, const double* added, double* rate) {
        rate[0] = x[1];
        rate[1] = (p[0] * u[0] + p[1] * x[0] + added[0]) / p[2];
    };
    s.feedback = Feedback{0, "Kp*(r-x)-Kd*der(x)+exc", [](const double* x, const double* u, const double* p) {
                              return p[3] * (u[1] - x[0]) - p[4] * x[1] + u[2];
                          }};
    Slot force{Kind::force, 0, m * stiffness * stiffness * gap * 0.6};
    force.speed = {1, -1, "der(x)"};
    force.position = {0, -1, "x"};
    force.excluded = {
        "viscous_friction"};  // der(x) is Kd's; ki and ks cannot take it up, but neither is it the bearing's usual sin
    s.slots = {force};
    const std::size_t n = s.samples();
    std::vector<double> r = sines(random, n, s.period, 4, 0.8, 12), exc = sines(random, n, s.period, 7, 5, 90);
    s.experiment =
        play({std::vector<double>(n, 0.0), scaled(r, 0.5 * gap), scaled(exc, 0.5 * gap * m * stiffness * stiffness / ki)});
    return s;
}

System two_mass(const Wish& wish, Random& random) {
    System s;
    s.summary = "motor and load inertia joined by a shaft";
    s.period = 1e-3;
    s.duration = random.integer(8, 10);
    const double J1 = rounded(random.log_uniform(5e-4, 5e-3), 2), J2 = rounded(J1 * random.uniform(1.2, 4), 2);
    const double resonance = 2 * M_PI * random.uniform(15, 45), joint = J1 * J2 / (J1 + J2);
    const double k = rounded(joint * resonance * resonance, 2),
                 c = rounded(2 * random.uniform(0.02, 0.2) * joint * resonance, 2);
    const double all = (J1 + J2) / random.uniform(0.3, 1);
    const bool no_viscous = wish.effect == "viscous_friction";
    const double b1 = rounded(0.35 * all, 2), b2 = rounded(0.65 * all, 2);
    const double torque = random.uniform(10, 40) * all, speed = 0.6 * torque / all;
    s.quantities = {{"J1", "kg.m^2", J1, false},
                    {"J2", "kg.m^2", J2, false},
                    {"b2", "N.m.s/rad", b2, false},
                    {"k", "N.m/rad", k, false},
                    {"c", "N.m.s/rad", c, false}};
    if (!no_viscous) s.quantities.push_back({"b1", "N.m.s/rad", b1, false});
    s.inputs = {"Tm"};
    s.initial = {0, 0, 0, 0};
    s.typical = {speed, speed, speed, speed};
    s.signals = {{"Tm", "N.m", -1, 0},
                 {"w1", "rad/s", 0},
                 {"w2", "rad/s", 1},
                 {"th1", "rad", 2, -1, false, 0.0003},
                 {"th2", "rad", 3, -1, false, 0.0003}};
    s.equations = {{"torque balance of w1", "w1",
                    std::string("J1*der(w1) = Tm - k*(th1-th2) - c*(w1-w2)") + (no_viscous ? "" : " - b1*w1")},
                   {"torque balance of w2", "w2", "J2*der(w2) = k*(th1-th2) + c*(w1-w2) - b2*w2"},
                   {"kinematic of th1", "th1", "der(th1) = w1"},
                   {"kinematic of th2", "th2", "der(th2) = w2"}};
    s.rate = [no_viscous](const double* x, const double* u, const double* p, const double* added, double* rate) {
        const double shaft = p[3] * (x[2] - x[3]) + p[4] * (x[0] - x[1]);
        rate[0] = (u[0] - shaft - (no_viscous ? 0.0 : p[5] * x[0]) + added[0]) / p[0];
        rate[1] = (shaft - p[2] * x[1] + added[1]) / p[1];
        rate[2] = x[0];
        rate[3] = x[1];
    };
    Slot motor{Kind::torque, 0, 0.5 * torque}, load{Kind::torque, 1, 0.5 * torque};
    motor.speed = {0, -1, "w1"};
    motor.angle = {2, -1, "th1"};
    motor.viscous = b1;
    load.speed = {1, -1, "w2"};
    load.angle = {3, -1, "th2"};
    load.excluded = {"viscous_friction"};
    if (!no_viscous) motor.excluded = {"viscous_friction"};
    s.slots = {motor, load};
    s.experiment = play({scaled(excitation(random, s.samples(), s.period, 0.15, 12), torque)});
    return s;
}

System mass_spring(const Wish& wish, Random& random, bool speed) {
    System s;
    s.summary = "mass-spring-damper on a force actuator";
    s.period = speed ? 2e-3 : 5e-3;
    s.duration = random.integer(14, 20);
    const double m = rounded(random.log_uniform(0.3, 5), 2), natural = 2 * M_PI * random.uniform(1.8, 4.5);
    const double k = rounded(m * natural * natural, 2);
    const bool no_viscous = wish.effect == "viscous_friction";
    const double c = rounded(2 * random.uniform(0.04, 0.15) * m * natural, 2);
    const double size = random.log_uniform(0.01, 0.1), F = 0.6 * k * size;
    s.quantities = {{"k", "N/m", k, false}, {"m", "kg", m, true}};
    if (!no_viscous) s.quantities.insert(s.quantities.begin() + 1, {"c", "N.s/m", c, false});
    s.inputs = {"F"};
    s.initial = {0, 0};
    s.typical = {size, size * natural};
    s.signals = {{"F", "N", -1, 0}, {"x", "m", 0}};
    if (speed) {
        s.signals.push_back({"v", "m/s", 1});
        s.equations = {{"kinematic of x", "x", "der(x) = v"},
                       {"force balance of v", "v", no_viscous ? "m*der(v) = F - k*x" : "m*der(v) = F - k*x - c*v"}};
    } else {
        s.equations = {{"force balance of x", "x", no_viscous ? "m*der(x,2) = F - k*x" : "m*der(x,2) = F - k*x - c*der(x)"}};
    }
    s.rate = [no_viscous](const double* x, const double* u, const double* p, const double* added, double* rate) {
        const double mass = p[no_viscous ? 1 : 2];
        rate[0] = x[1];
        rate[1] = (u[0] - p[0] * x[0] - (no_viscous ? 0.0 : p[1] * x[1]) + added[0]) / mass;
    };
    Slot force{Kind::force, speed ? 1 : 0, F};
    force.speed = {1, -1, speed ? "v" : "der(x)"};
    force.viscous = c;
    force.position = {0, -1, "x"};
    s.slots = {force};
    s.experiment =
        play({scaled(excitation(random, s.samples(), s.period, 0.2, 7), 1.4 * F, random.chance(0.4) ? 0.2 * F : 0)});
    return s;
}

System arm(const Wish& wish, Random& random) {
    System s;
    s.summary = "single-link arm, motor torque logged while a position loop moved it";
    s.period = 2e-3;
    s.duration = random.integer(12, 18);
    const double J = rounded(random.log_uniform(0.01, 0.3), 2), natural = random.uniform(4, 8);
    const bool no_viscous = wish.effect == "viscous_friction";
    const bool no_gravity = wish.effect == "gravity_sin" || random.chance(0.3);
    const double b = rounded(random.uniform(0.5, 2) * J, 2), G = no_gravity ? 0 : rounded(J * natural * natural, 2);
    s.quantities = {{"J", "kg.m^2", J, false}};
    if (!no_viscous) s.quantities.push_back({"b", "N.m.s/rad", b, false});
    if (!no_gravity) s.quantities.push_back({"G", "N.m", G, false});
    s.inputs = {"tau"};
    s.initial = {0, 0};
    s.typical = {1.5, 5};
    s.signals = {{"tau", "N.m", -1, 0}, {"th", "rad", 0}, {"w", "rad/s", 1}};
    s.equations = {{"kinematic of th", "th", "der(th) = w"},
                   {"torque balance of w", "w",
                    std::string("J*der(w) = tau") + (no_viscous ? "" : " - b*w") + (no_gravity ? "" : " - G*sin(th)")}};
    s.rate = [no_viscous, no_gravity](const double* x, const double* u, const double* p, const double* added, double* rate) {
        const double drag = no_viscous ? 0.0 : p[1] * x[1];
        const double weight = no_gravity ? 0.0 : p[no_viscous ? 1 : 2] * std::sin(x[0]);
        rate[0] = x[1];
        rate[1] = (u[0] - drag - weight + added[0]) / p[0];
    };
    Slot torque{Kind::torque, 1, 15 * J};
    torque.speed = {1, -1, "w"};
    torque.viscous = b;
    torque.angle = torque.position = {0, -1, "th"};
    if (!no_gravity) torque.excluded = {"gravity_sin"};
    s.slots = {torque};
    const std::size_t n = s.samples();
    std::vector<double> target = steps(random, n, s.period, 1.2);
    const std::vector<double> shake = sines(random, n, s.period, 4, 0.3, 4);
    for (std::size_t k = 0; k < n; ++k)
        target[k] =
            (no_gravity ? 2.2 : 1.1) * target[k] + 0.2 * shake[k];  // above the pivot the replayed torque would not hold it
    // A slow loop: the arm must pass every speed, and gravity may sag it.
    s.experiment = [=]() -> Controller {
        return [=](std::size_t k, const State& x, std::vector<double>& u) {
            u[0] = J * (45 * (target[k] - x[0]) - 6 * x[1]) + J * 6 * shake[k];
        };
    };
    return s;
}

System servo_axis(const Wish& wish, Random& random) {
    System s;
    s.summary = "linear servo axis, position measured, force logged while a position loop moved it";
    s.period = 2e-3;
    s.duration = random.integer(8, 14);
    const double m = rounded(random.log_uniform(2, 40), 2);
    const bool no_viscous = wish.effect == "viscous_friction";
    const double b = rounded(random.uniform(2, 6) * m, 2), travel = random.log_uniform(0.02, 0.3);
    s.quantities = {{"m", "kg", m, false}};
    if (!no_viscous) s.quantities.push_back({"b", "N.s/m", b, false});
    s.inputs = {"F"};
    s.initial = {0, 0};
    s.typical = {travel, 5 * travel};
    s.signals = {{"F", "N", -1, 0}, {"x", "m", 0}};
    s.equations = {{"force balance of x", "x", no_viscous ? "m*der(x,2) = F" : "m*der(x,2) = F - b*der(x)"}};
    s.rate = [no_viscous](const double* x, const double* u, const double* p, const double* added, double* rate) {
        rate[0] = x[1];
        rate[1] = (u[0] - (no_viscous ? 0.0 : p[1] * x[1]) + added[0]) / p[0];
    };
    Slot force{Kind::force, 0, 25 * m * travel};
    force.speed = {1, -1, "der(x)"};
    force.position = {0, -1, "x"};
    force.viscous = b;
    s.slots = {force};
    const std::size_t n = s.samples();
    std::vector<double> target = steps(random, n, s.period, 0.8);
    const std::vector<double> shake = sines(random, n, s.period, 4, 0.5, 5);
    for (std::size_t k = 0; k < n; ++k) target[k] = travel * (1.2 * target[k] + 0.3 * shake[k]);
    s.experiment = [=]() -> Controller {
        return
            [=](std::size_t k, const State& x, std::vector<double>& u) { u[0] = m * (90 * (target[k] - x[0]) - 10 * x[1]); };
    };
    return s;
}

System quarter_car(const Wish& wish, Random& random) {
    System s;
    s.summary = "quarter-car suspension on a shaker, with an active strut";
    s.period = 2e-3;
    s.duration = random.integer(10, 14);
    const double ms = rounded(random.uniform(200, 400), 2), mu = rounded(random.uniform(25, 60), 2);
    const double body = 2 * M_PI * random.uniform(1.0, 1.8), wheel = 2 * M_PI * random.uniform(8, 12);
    const double ks = rounded(ms * body * body, 2), kt = rounded(mu * wheel * wheel, 2);
    const bool no_viscous = wish.effect == "viscous_friction";
    const double cs = rounded(2 * random.uniform(0.15, 0.35) * ms * body, 2);
    const double road = random.uniform(0.01, 0.03);
    s.quantities = {{"ks", "N/m", ks, false}, {"kt", "N/m", kt, false}, {"ms", "kg", ms, true}, {"mu", "kg", mu, true}};
    if (!no_viscous) s.quantities.insert(s.quantities.begin() + 2, {"cs", "N.s/m", cs, false});
    s.inputs = {"r", "F"};
    s.initial = {0, 0, 0, 0};
    s.typical = {road, road * 8, road, road * 20};
    s.signals = {{"r", "m", -1, 0}, {"F", "N", -1, 1}, {"xs", "m", 0}, {"xu", "m", 2}};
    const std::string damper = no_viscous ? "" : "cs*(der(xs)-der(xu))";
    s.equations = {{"force balance of xs", "xs", "ms*der(xs,2) = F - ks*(xs-xu)" + (no_viscous ? "" : " - " + damper)},
                   {"force balance of xu", "xu",
                    "mu*der(xu,2) = ks*(xs-xu)" + (no_viscous ? "" : " + " + damper) + " - kt*(xu-r) - F"}};
    s.rate = [no_viscous](const double* x, const double* u, const double* p, const double* added, double* rate) {
        const double damping = no_viscous ? 0.0 : p[2] * (x[1] - x[3]), sprung = p[no_viscous ? 2 : 3],
                     unsprung = p[no_viscous ? 3 : 4];
        const double strut = p[0] * (x[0] - x[2]) + damping - added[1];
        rate[0] = x[1];
        rate[1] = (u[1] - strut + added[0]) / sprung;
        rate[2] = x[3];
        rate[3] = (strut - p[1] * (x[2] - u[0]) - u[1]) / unsprung;
    };
    Slot lone{Kind::force, 0, 0.3 * ks * road}, strut{Kind::force, 0, 0.3 * ks * road};
    lone.excluded = {"coulomb_friction", "quadratic_drag", "viscous_friction",
                     "cubic_stiffness",  "hard_stop",      "cubic_damping"};  // nothing holds the body but its strut
    strut.opposite = 1;
    strut.viscous = cs;
    strut.speed = {1, 3, "(der(xs)-der(xu))"};
    strut.position = {0, 2, "(xs-xu)"};
    strut.excluded = {"constant_load", "sinusoidal_disturbance"};
    s.slots = {lone, strut};
    const std::size_t n = s.samples();
    s.experiment = play({scaled(excitation(random, n, s.period, 0.3, 12), 2 * road),
                         scaled(sines(random, n, s.period, 5, 0.3, 10), 0.3 * ks * road)});
    return s;
}

}  // namespace algest::gap
