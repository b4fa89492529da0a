// SPDX-License-Identifier: GPL-3.0-or-later
#include "effect.hpp"

#include <algorithm>
#include <cmath>

#include "rounding.hpp"

namespace algest::gap {

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

/// A term of one role, odd or not: f(role value) times the strength.
using Shape = std::function<double(double value, const double* q)>;

Effect of_role(const std::string& name, const std::vector<std::string>& names, const Role& role, const std::string& formula,
               Shape shape) {
    Effect e;
    e.name = name;
    e.accepted = {name};
    e.names = names;
    e.formula = replaced(formula, "$", role.text);
    std::string text = e.formula;
    for (const std::string& n : names) text = replaced(text, "<" + n + ">", "x_" + n);
    for (const std::string& n : names) e.formula = replaced(e.formula, "<" + n + ">", n);
    e.texts = {text};
    e.term = [role, shape](std::size_t, const double* x, const double*, double, const double*, const double* q) {
        return shape(role.of(x), q);
    };
    return e;
}

/// A term of two roles, $ and #, that no usual library holds.
Effect of_two(const std::string& name, const std::string& parameter, const Role& a, const Role& b, const std::string& formula,
              std::function<double(double, double, double)> law) {
    Effect e;
    e.name = name;
    e.accepted = {name};
    e.in_library = false;
    e.names = {parameter};
    const std::string whole = replaced(replaced(formula, "$", a.text), "#", b.text);
    e.formula = replaced(whole, "<" + parameter + ">", parameter);
    e.texts = {replaced(whole, "<" + parameter + ">", "x_" + parameter)};
    e.term = [a, b, law](std::size_t, const double* x, const double*, double, const double*, const double* q) {
        return law(a.of(x), b.of(x), q[0]);
    };
    return e;
}

double size_of(const Role& role, const State& scale) {
    const double a = scale[static_cast<std::size_t>(role.state)];
    return role.minus < 0 ? a : 0.5 * (a + scale[static_cast<std::size_t>(role.minus)]);
}

Effect constant(const std::string& name, const std::string& parameter, double sign, double value) {
    Effect e;
    e.name = name;
    e.accepted = {name};
    e.names = {parameter};
    e.values = {value};
    e.formula = (sign > 0 ? "+" : "-") + parameter;
    e.texts = {(sign > 0 ? "+x_" : "-x_") + parameter};
    e.term = [sign](std::size_t, const double*, const double*, double, const double*, const double* q) {
        return sign * q[0];
    };
    return e;
}

Effect disturbance(double size, double frequency, double phase) {
    Effect e;
    e.name = "sinusoidal_disturbance";
    e.accepted = {e.name};
    e.names = {"F0", "f", "phi"};
    e.values = {size, frequency, phase};
    e.formula = "+F0*sin(2*pi*f*t+phi)";
    e.texts = {"+x_F0*x_s"};
    e.term = [](std::size_t, const double*, const double*, double t, const double*, const double* q) {
        return q[0] * std::sin(2 * M_PI * q[1] * t + q[2]);
    };
    // The model's language knows no time: an oscillator gives it.
    char text[160];
    std::snprintf(text, sizeof text, "x_s = { unit = \"1\", initial = %.17g, scored = false }", std::sin(phase));
    e.own_signals.push_back(text);
    std::snprintf(text, sizeof text, "x_c = { unit = \"1\", initial = %.17g, scored = false }", std::cos(phase));
    e.own_signals.push_back(text);
    std::snprintf(text, sizeof text, "der(x_s) = %.17g*x_f*x_c", 2 * M_PI);
    e.own_equations.push_back(text);
    std::snprintf(text, sizeof text, "der(x_c) = -%.17g*x_f*x_s", 2 * M_PI);
    e.own_equations.push_back(text);
    return e;
}

Effect hysteresis(const Role& speed, const Role& position, double size, double width) {
    Effect e;
    e.name = "bouc_wen_hysteresis";
    e.accepted = {"bouc_wen_hysteresis", "dahl_friction", "hysteresis", "lugre_friction"};
    e.in_library = false;
    e.names = {"Fh", "Dx"};
    e.values = {size, width};
    (void)position;
    e.formula = "-Fh*h, Dx*der(h)=v-0.5|v|h-0.5 v|h|";
    e.own = {0};
    e.term = [](std::size_t, const double*, const double*, double, const double* own, const double* q) {
        return -q[0] * own[0];
    };
    e.own_rate = [speed](const double* x, const double*, const double* own, const double* q, double* rate) {
        const double v = speed.of(x);
        rate[0] = (v - 0.5 * std::abs(v) * own[0] - 0.5 * v * std::abs(own[0])) / q[1];
    };
    e.texts = {"-x_Fh*x_h"};
    e.own_signals = {"x_h = { unit = \"1\", initial = 0, scored = false }"};
    e.own_equations = {replaced("x_Dx*der(x_h) = $ - 0.5*abs($)*x_h - 0.5*$*abs(x_h)", "$", speed.text)};
    return e;
}

}  // namespace

std::string Effect::equations(const System& system) const {
    std::string out = where;
    for (const int slot : where.empty() ? slots : std::vector<int>{}) {
        const Slot& s = system.slots[static_cast<std::size_t>(slot)];
        for (const int e : {s.equation, s.opposite}) {
            if (e >= 0) out += (out.empty() ? "" : ",") + system.equations[static_cast<std::size_t>(e)].signal;
        }
    }
    return out;
}

const std::vector<std::string>& term_effects() {
    static const std::vector<std::string> names = {
        "coulomb_friction", "viscous_friction",       "quadratic_drag",  "constant_load",   "gravity_sin",
        "cogging_torque",   "sinusoidal_disturbance", "cubic_stiffness", "voltage_offset",  "inverter_dead_time",
        "back_emf",         "orifice_leak",           "laminar_leak",    "quadratic_input", "ambient_offset"};
    return names;
}

std::optional<Effect> effect(const std::string& name, const System& system, int slot, const State& scale, Random& random) {
    if (slot >= static_cast<int>(system.slots.size())) return std::nullopt;
    const Slot& s = system.slots[static_cast<std::size_t>(slot)];
    if (s.excluded.count(name)) return std::nullopt;
    const bool mechanical = s.kind == Kind::torque || s.kind == Kind::force;
    const double start = 0.1 * s.size, T = system.duration;
    std::optional<Effect> e;
    const auto eps = [&](const Role& role) { return smoothing * size_of(role, scale); };
    if (mechanical && s.speed.given()) {
        const double width = eps(s.speed), v = size_of(s.speed, scale);
        if (name == "coulomb_friction") {
            e = of_role(name, {"Tc"}, s.speed, "-<Tc>*sgn($)",
                        [width](double x, const double* q) { return -q[0] * std::tanh(x / width); });
            e->values = {start};
        } else if (name == "viscous_friction") {
            e = of_role(name, {"b"}, s.speed, "-<b>*$", [](double x, const double* q) { return -q[0] * x; });
            e->values = {s.viscous > 0 ? s.viscous : start / v};
            e->tuned = s.viscous <= 0;  // an oscillator with next to no damping is no model that a person would start from
        } else if (name == "quadratic_drag") {
            e = of_role(name, {"kq"}, s.speed, "-<kq>*$*abs($)",
                        [](double x, const double* q) { return -q[0] * x * std::abs(x); });
            e->values = {start / (v * v)};
        } else if (name == "cubic_damping") {
            e = of_role(name, {"c3"}, s.speed, "-<c3>*$^3", [](double x, const double* q) { return -q[0] * x * x * x; });
            e->values = {start / (v * v * v)};
            e->in_library = false;
        } else if (name == "position_damping" && s.position.given()) {
            e = of_two(name, "c2", s.position, s.speed, "-<c2>*$^2*#", [](double x, double v, double q) { return -q * x * x * v; });
            e->values = {start / (std::pow(size_of(s.position, scale), 2) * v)};
        } else if (name == "bouc_wen_hysteresis" && s.position.given()) {
            e = hysteresis(s.speed, s.position, start, rounded(random.uniform(0.2, 0.6) * size_of(s.position, scale), 2));
        }
    }
    if (mechanical && name == "constant_load") {
        e = constant(name, "T0", -1, start);
        e->strength_sign = random.sign();
    }
    if (mechanical && name == "sinusoidal_disturbance")
        e = disturbance(start, rounded(random.log_uniform(8 / T, 60 / T), 3), rounded(random.uniform(-3, 3), 2));
    if (mechanical && s.position.given()) {
        const double x = size_of(s.position, scale);
        if (name == "cubic_stiffness") {
            e = of_role(name, {"k3"}, s.position, "-<k3>*$^3", [](double v, const double* q) { return -q[0] * v * v * v; });
            e->values = {start / (x * x * x)};
            e->strength_sign = random.chance(0.7) ? 1 : -1;
        } else if (name == "quadratic_stiffness") {
            e = of_role(name, {"k2"}, s.position, "-<k2>*$^2", [](double v, const double* q) { return -q[0] * v * v; });
            e->values = {start / (x * x)};
            e->strength_sign = random.sign();
            e->in_library = false;
        } else if (name == "hard_stop") {
            e = of_role(
                name, {"kw", "xw"}, s.position, "-<kw>*max($-<xw>,0)-<kw>*min($+<xw>,0)",
                [](double v, const double* q) { return -q[0] * (std::max(v - q[1], 0.0) + std::min(v + q[1], 0.0)); });
            e->values = {10 * start / x, rounded(random.uniform(1.0, 1.5) * x, 2)};
            e->in_library = false;
        }
    }
    if (s.kind == Kind::torque && s.angle.given()) {
        if (name == "gravity_sin") {
            e = of_role(name, {"G"}, s.angle, "-<G>*sin($)", [](double x, const double* q) { return -q[0] * std::sin(x); });
            e->values = {start};
        } else if (name == "cogging_torque") {
            e = of_role(name, {"Tcog", "N", "phi"}, s.angle, "-<Tcog>*sin(<N>*$+<phi>)",
                        [](double x, const double* q) { return -q[0] * std::sin(q[1] * x + q[2]); });
            // As fast a wave as the sampling can follow at most speeds.
            const double highest = 0.25 * 2 * M_PI / (system.period * scale[static_cast<std::size_t>(s.speed.state)]);
            e->values = {start, static_cast<double>(random.integer(4, std::clamp(static_cast<int>(highest), 6, 48))),
                         rounded(random.uniform(-3, 3), 2)};
        }
    }
    if (s.kind == Kind::voltage) {
        if (name == "voltage_offset") {
            e = constant(name, "V0", 1, start);
            e->strength_sign = random.sign();
        } else if (name == "inverter_dead_time" && s.current.given() && !s.angle.given()) {
            const double width = eps(s.current);
            e = of_role(name, {"Vd"}, s.current, "-<Vd>*sgn($)",
                        [width](double x, const double* q) { return -q[0] * std::tanh(x / width); });
            e->values = {start};
        } else if (name == "inverter_dead_time" && slot == 0) {
            return three_phase_dead_time(system, scale);
        } else if (name == "growing_resistance" && s.current.given() && !s.angle.given()) {
            e = of_role(name, {"R2"}, s.current, "-<R2>*$*abs($)", [](double x, const double* q) { return -q[0] * x * std::abs(x); });
            e->values = {start / std::pow(size_of(s.current, scale), 2)};
            e->in_library = false;
        } else if (name == "back_emf" && s.speed.given() && !s.angle.given()) {
            e = of_role(name, {"Ke"}, s.speed, "-<Ke>*$", [](double x, const double* q) { return -q[0] * x; });
            e->values = {start / size_of(s.speed, scale)};
        }
    }
    if (s.kind == Kind::flow && s.level.given()) {
        const double level = size_of(s.level, scale);
        if (name == "orifice_leak") {
            e = of_role(name, {"kl"}, s.level, "-<kl>*sqrt($)",
                        [](double x, const double* q) { return -q[0] * std::sqrt(std::max(x, 0.0)); });
            e->values = {start / std::sqrt(level)};
        } else if (name == "laminar_leak") {
            e = of_role(name, {"kl"}, s.level, "-<kl>*$", [](double x, const double* q) { return -q[0] * x; });
            e->values = {start / level};
        } else if (name == "quadratic_leak") {
            e = of_role(name, {"kl"}, s.level, "-<kl>*$^2", [](double x, const double* q) { return -q[0] * x * x; });
            e->values = {start / (level * level)};
            e->in_library = false;
        }
    }
    if (s.kind == Kind::heat) {
        if (name == "ambient_offset") {
            e = constant(name, "c0", 1, start);
            e->strength_sign = random.sign();
        } else if (name == "quadratic_input" && s.input >= 0) {
            const int input = s.input;
            e = constant(name, "k2", 1, start);
            e->formula = "+k2*" + system.inputs[static_cast<std::size_t>(input)] + "^2";
            e->texts = {"+x_k2*" + system.inputs[static_cast<std::size_t>(input)] + "^2"};
            e->term = [input](std::size_t, const double*, const double* u, double, const double*, const double* q) {
                return q[0] * u[input] * u[input];
            };
            e->values = {start / 100};
        } else if (name == "radiation" && s.position.given()) {
            e = of_role(name, {"sigma", "zero"}, s.position, "-<sigma>*($-<zero>)^4+<sigma>*295^4",
                        [](double x, const double* q) { return -q[0] * (std::pow(x - q[1], 4) - std::pow(295.0, 4)); });
            e->values = {start / 4e9, -273.15};
            e->in_library = false;
        }
    }
    if (e) e->slots = {slot};
    return e;
}

Effect three_phase_dead_time(const System& system, const State& scale) {
    Effect e;
    e.name = "inverter_dead_time";
    e.accepted = {e.name};
    e.names = {"Vd"};
    e.values = {0.05 * system.slots[1].size};
    e.formula = "-Vd*sgn(i_abc) transformed to dq";
    e.slots = {0, 1};
    const double eps = smoothing * 0.5 * (scale[0] + scale[1]);
    int poles = 0;
    for (const Quantity& q : system.quantities) poles += q.name == "pp" ? static_cast<int>(q.value) : 0;
    e.term = [eps, poles](std::size_t which, const double* x, const double*, double, const double*, const double* q) {
        double out = 0;
        for (int phase = 0; phase < 3; ++phase) {
            const double angle = poles * x[3] - 2 * M_PI / 3 * phase;
            const double current = std::cos(angle) * x[0] - std::sin(angle) * x[1];
            out += 2.0 / 3 * (which == 0 ? std::cos(angle) : -std::sin(angle)) * std::tanh(current / eps);
        }
        return -q[0] * out;
    };
    e.texts = {"", ""};
    for (int phase = 0; phase < 3; ++phase) {
        char angle[64];
        std::snprintf(angle, sizeof angle, phase ? "pp*th-%.17g" : "pp*th", 2 * M_PI / 3 * phase);
        const std::string c = std::string("cos(") + angle + ")", n = std::string("sin(") + angle + ")";
        const std::string side = "sgn(" + c + "*id-" + n + "*iq)";
        e.texts[0] += " - 0.66666666666666667*x_Vd*" + c + "*" + side;
        e.texts[1] += " + 0.66666666666666667*x_Vd*" + n + "*" + side;
    }
    return e;
}

}  // namespace algest::gap
