// SPDX-License-Identifier: GPL-3.0-or-later
// Effects that are more than a term: on inputs, sensors, couplings, windings.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "effect.hpp"
#include "rounding.hpp"

namespace algest::gap {

namespace {

int quantity(const System& system, const std::string& name) {
    for (std::size_t q = 0; q < system.quantities.size(); ++q) {
        if (system.quantities[q].name == name) return static_cast<int>(q);
    }
    return -1;
}

double value(const System& system, const std::string& name) {
    const int q = quantity(system, name);
    return q < 0 ? 0.0 : system.quantities[static_cast<std::size_t>(q)].value;
}

/// Signals of the equations in which a word stands.
std::string equations_with(const System& system, const std::string& word) {
    std::string out;
    const auto part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (const Equation& e : system.equations) {
        for (std::size_t at = e.ode.find(word); at != std::string::npos; at = e.ode.find(word, at + 1)) {
            if ((at > 0 && part(e.ode[at - 1])) || (at + word.size() < e.ode.size() && part(e.ode[at + word.size()])))
                continue;
            out += (out.empty() ? "" : ",") + e.signal;
            break;
        }
    }
    return out;
}

Effect named(const std::string& name, std::vector<std::string> names, std::vector<double> values,
             std::vector<int> slots = {}) {
    Effect e;
    e.name = name;
    e.accepted = {name};
    e.names = std::move(names);
    e.values = std::move(values);
    e.slots = std::move(slots);
    return e;
}

std::optional<Effect> on_input(const std::string& name, const System& system, int input, Random& random) {
    if (input >= static_cast<int>(system.inputs.size()) || (system.feedback && system.feedback->input == input))
        return std::nullopt;
    std::vector<int> inputs = {input};
    if (quantity(system, "psi") >= 0) {  // both voltages come through one inverter
        if (input > 0) return std::nullopt;
        inputs = {0, 1};
    }
    const double T = system.period;
    Effect e;
    if (name == "input_delay") {
        e = named(name, {"delay_s"}, {T * random.integer(2, 8)});
        e.formula = "u(t-n*dt)";
        e.tuned = false;  // whole samples
        // A plant that runs had the first command before the recording began; one at rest had none.
        const bool running =
            std::any_of(system.slots.begin(), system.slots.end(), [](const Slot& s) { return s.kind == Kind::flow; });
        e.arrives = [inputs, T, running](std::size_t which, const auto& commanded, std::size_t k, const double*,
                                         const double* q) {
            const auto i = static_cast<std::size_t>(inputs[which]);
            // Between whole samples (only a fit goes there) a blend, which has the same slope.
            const double samples = q[0] / T, whole = std::floor(samples + 1e-9), rest = std::max(0.0, samples - whole);
            const auto n = static_cast<std::size_t>(whole);
            const double before = running ? commanded[0][i] : 0.0;
            const double late = k >= n ? commanded[k - n][i] : before, later = k >= n + 1 ? commanded[k - n - 1][i] : before;
            return (1 - rest) * late + rest * later;
        };
    } else if (name == "actuator_lag") {
        e = named(name, {"tau"}, {3 * T});
        e.formula = "tau*der(ua)=u-ua";
        e.own.assign(inputs.size(), 0.0);
        e.arrives = [](std::size_t which, const auto&, std::size_t, const double* own, const double*) { return own[which]; };
        e.own_rate = [inputs](const double*, const double* u, const double* own, const double* q, double* rate) {
            for (std::size_t w = 0; w < inputs.size(); ++w) rate[w] = (u[inputs[w]] - own[w]) / q[0];
        };
        for (const int i : inputs) {
            const std::string& name_of_input = system.inputs[static_cast<std::size_t>(i)];
            e.input_texts.push_back("x_" + name_of_input);
            e.own_signals.push_back("x_" + name_of_input + " = { initial = 0, scored = false }");
            e.own_equations.push_back("x_tau*der(x_" + name_of_input + ") = " + name_of_input + " - x_" + name_of_input);
        }
    } else {
        return std::nullopt;
    }
    e.inputs = inputs;
    for (const int i : inputs)
        e.where += (e.where.empty() ? "" : ",") + equations_with(system, system.inputs[static_cast<std::size_t>(i)]);
    return e;
}

std::optional<Effect> on_sensor(const std::string& name, const System& system, int signal, const State& scale,
                                Random& random) {
    if (signal >= static_cast<int>(system.signals.size())) return std::nullopt;
    const Signal& s = system.signals[static_cast<std::size_t>(signal)];
    if (s.state < 0 || !s.scored) return std::nullopt;
    if (system.feedback) return std::nullopt;  // a controller that the model closes sees its own sensor, not the truth as here
    Effect e;
    if (name == "sensor_gain") {
        e = named(name, {"g"}, {0.05});
        e.formula = "y=g*x";
        e.most = 0.12;
        e.shows = [](double v, const double* q) { return v * (1 + q[0]); };
        e.stated = [](const std::vector<double>& v) { return std::vector<std::pair<std::string, double>>{{"g", 1 + v[0]}}; };
    } else if (name == "sensor_bias") {
        e = named(name, {"b"}, {0.05 * scale[static_cast<std::size_t>(s.state)]});
        e.formula = "y=x+b";
        e.most = 0.3 * scale[static_cast<std::size_t>(s.state)];
        e.shows = [](double v, const double* q) { return v + q[0]; };
    } else {
        return std::nullopt;
    }
    e.strength_sign = random.sign();
    e.signal = signal;
    e.where = s.name;
    return e;
}

/// Within the play nothing pulls, neither the spring nor the damper.
Effect backlash(const System& system, double size) {
    const double k = value(system, "k"), c = value(system, "c");
    Effect e = named("backlash", {"delta"}, {0.02 * size}, {0, 1});
    e.formula = "k*dz(th1-th2,delta)";
    e.term = [k, c](std::size_t which, const double* x, const double*, double, const double*, const double* q) {
        const double twist = x[2] - x[3], damper = std::abs(twist) < q[0] ? c * (x[0] - x[1]) : 0;
        return (which == 0 ? 1 : -1) * (k * std::clamp(twist, -q[0], q[0]) + damper);
    };
    const std::string inside = "(1-min(max(abs(th1-th2)-x_delta,0)/x_delta*1000,1))";
    const std::string missing = "k*max(min(th1-th2,x_delta),-x_delta) + c*(w1-w2)*" + inside;
    e.texts = {" + (" + missing + ")", " - (" + missing + ")"};
    return e;
}

/// Ld = L (1-s), Lq = L (1+s).
Effect saliency(const System& system) {
    const double R = value(system, "R"), L = value(system, "L"), pp = value(system, "pp"), psi = value(system, "psi");
    Effect e = named("saliency", {"spread"}, {0.2}, {0, 1, 2});
    e.formula = "Lq != Ld";
    e.term = [=](std::size_t which, const double* x, const double* u, double, const double*, const double* q) {
        const double Ld = L * (1 - q[0]), Lq = L * (1 + q[0]), turn = pp * x[2];
        if (which == 0) return (u[0] - R * x[0] + turn * Lq * x[1]) * L / Ld - (u[0] - R * x[0] + turn * L * x[1]);
        if (which == 1)
            return (u[1] - R * x[1] - turn * (Ld * x[0] + psi)) * L / Lq - (u[1] - R * x[1] - turn * (L * x[0] + psi));
        return 1.5 * pp * (Ld - Lq) * x[0] * x[1];
    };
    e.texts = {" + (vd - R*id + pp*w*L*(1+x_spread)*iq)/(1-x_spread) - (vd - R*id + pp*w*L*iq)",
               " + (vq - R*iq - pp*w*(L*(1-x_spread)*id + psi))/(1+x_spread) - (vq - R*iq - pp*w*(L*id + psi))",
               " - 3*pp*L*x_spread*id*iq"};
    e.stated = [L](const std::vector<double>& v) {
        return std::vector<std::pair<std::string, double>>{{"Ld", rounded(L * (1 - v[0]), 6)},
                                                           {"Lq", rounded(L * (1 + v[0]), 6)}};
    };
    return e;
}

/// The driving voltage of a winding's equation, without what is hidden: L di/dt; as code and as text.
struct Winding {
    std::function<double(const double* x, const double* u)> drop;
    std::string text;
};

std::optional<Winding> winding(const System& system) {
    const double R = value(system, "R"), K = value(system, "K"), Kf = value(system, "Kf"), Vin = value(system, "Vin");
    if (system.equations[0].signal != "i") return std::nullopt;
    const std::string& ode = system.equations[0].ode;
    const std::string right = ode.substr(ode.find('=') + 2);
    if (Vin > 0) return Winding{[=](const double* x, const double* u) { return u[0] * Vin - R * x[0]; }, right};
    if (Kf > 0) return Winding{[=](const double* x, const double* u) { return u[0] - R * x[0] - Kf * x[2]; }, right};
    return Winding{[=](const double* x, const double* u) { return u[0] - R * x[0] - K * x[1]; }, right};
}

/// J splits into J1 (driven) and J2 behind a spring of stiffness k = 1/compliance.
std::optional<Effect> flexible_coupling(const System& system, int slot, Random& random) {
    const Slot& s = system.slots[static_cast<std::size_t>(slot)];
    const int q = quantity(system, "J");
    if (s.kind != Kind::torque || q < 0 || system.inputs.size() != 1) return std::nullopt;
    const std::string& ode = system.equations[static_cast<std::size_t>(s.equation)].ode;
    const std::string right = ode.substr(ode.find('=') + 2);
    if (right != "K*i - b*w") return std::nullopt;
    const double J = value(system, "J"), K = value(system, "K"), b = value(system, "b"), part = random.uniform(0.35, 0.65);
    const double J1 = rounded(J * part, 3), J2 = J - J1, joint = J1 * J2 / J;
    // Some resonance that the experiment can reach, with a damping of 3 percent.
    const double resonance = 2 * M_PI * random.uniform(8, 20);
    Effect e = named("flexible_coupling", {"compliance", "J1", "J2"}, {1 / (joint * resonance * resonance), J1, J2}, {slot});
    e.formula = "two inertias and a spring in place of one rigid inertia";
    e.own = {0, 0};
    const double damping = 0.06;
    const auto shaft = [joint, damping](const double* x, const double* own, const double* v) {
        return own[0] / v[0] + damping * std::sqrt(joint / v[0]) * (x[1] - own[1]);
    };
    e.term = [=](std::size_t, const double* x, const double*, double, const double* own, const double* v) {
        return (K * x[0] - b * x[1]) * (J / J1 - 1) - J / J1 * shaft(x, own, v);
    };
    e.own_rate = [=](const double* x, const double*, const double* own, const double* v, double* rate) {
        rate[0] = x[1] - own[1];
        rate[1] = shaft(x, own, v) / J2;
    };
    char text[200];
    std::snprintf(text, sizeof text, "(x_a/x_compliance + %.17g/sqrt(x_compliance)*(w - x_w2))", damping * std::sqrt(joint));
    const std::string torque = text;
    e.texts = {" + (" + right + ")*x_J2/x_J1 - (x_J1+x_J2)/x_J1*" + torque};
    e.own_signals = {"x_a = { initial = 0, scored = false }", "x_w2 = { initial = 0, scored = false }"};
    e.own_equations = {"der(x_a) = w - x_w2", "x_J2*der(x_w2) = " + torque};
    e.stated = [J1, J2](const std::vector<double>& v) {
        return std::vector<std::pair<std::string, double>>{{"J1", J1}, {"J2", J2}, {"k", rounded(1 / v[0], 4)}};
    };
    return e;
}

}  // namespace

const std::vector<std::string>& structural_effects() {
    static const std::vector<std::string> names = {
        "stribeck_friction",      "backlash",    "flexible_coupling", "saliency",    "magnetic_saturation",
        "resistance_temperature", "input_delay", "actuator_lag",      "sensor_gain", "sensor_bias"};
    return names;
}

std::optional<Effect> structural_effect(const std::string& name, const System& system, int index, const State& scale,
                                        Random& random) {
    if (name.rfind("sensor_", 0) == 0) return on_sensor(name, system, index, scale, random);
    if (name == "input_delay" || name == "actuator_lag") return on_input(name, system, index, random);
    if (index >= static_cast<int>(system.slots.size())) return std::nullopt;
    const Slot& s = system.slots[static_cast<std::size_t>(index)];
    if (name == "stribeck_friction") {
        if (!effect("coulomb_friction", system, index, scale, random)) return std::nullopt;
        const Role speed = s.speed;
        const double v = scale[static_cast<std::size_t>(speed.state)], width = smoothing * v;
        Effect e =
            named(name, {"Tc", "ratio", "ws"},
                  {0.1 * s.size, rounded(random.uniform(1.6, 2.5), 2), rounded(random.uniform(0.05, 0.15) * v, 2)}, {index});
        e.formula = "-(Tc+(Ts-Tc)*exp(-(" + speed.text + "/ws)^2))*sgn(" + speed.text + ")";
        e.term = [speed, width](std::size_t, const double* x, const double*, double, const double*, const double* q) {
            const double w = speed.of(x);
            return -q[0] * (1 + (q[1] - 1) * std::exp(-w * w / (q[2] * q[2]))) * std::tanh(w / width);
        };
        e.texts = {" - x_Tc*(1+(x_ratio-1)*exp(-(" + speed.text + "/x_ws)^2))*sgn(" + speed.text + ")"};
        e.stated = [](const std::vector<double>& q) {
            return std::vector<std::pair<std::string, double>>{{"Tc", q[0]}, {"Ts", rounded(q[0] * q[1], 6)}, {"ws", q[2]}};
        };
        return e;
    }
    if (name == "backlash" && index == 0 && quantity(system, "J2") >= 0)
        return backlash(system, s.size / value(system, "k"));
    if (name == "saliency" && index == 0 && quantity(system, "psi") >= 0) return saliency(system);
    if (name == "flexible_coupling") return flexible_coupling(system, index, random);
    if (index == 0 && (name == "magnetic_saturation" || name == "resistance_temperature")) {
        const auto coil = winding(system);
        if (!coil) return std::nullopt;
        const double i = scale[0], R = value(system, "R");
        if (name == "magnetic_saturation") {
            // L(i) = L/(1+(i/isat)^2); the strength is 1/isat^2.
            Effect e = named(name, {"isat"}, {0.1 / (i * i)}, {0});
            e.formula = "L/(1+(i/isat)^2)";
            e.term = [coil](std::size_t, const double* x, const double* u, double, const double*, const double* q) {
                return coil->drop(x, u) * q[0] * x[0] * x[0];
            };
            e.texts = {" + (" + coil->text + ")*x_isat*i^2"};
            e.stated = [](const std::vector<double>& v) {
                return std::vector<std::pair<std::string, double>>{{"isat", rounded(1 / std::sqrt(v[0]), 4)}};
            };
            return e;
        }
        const double tau = rounded(system.duration * random.uniform(0.15, 0.5), 2);
        Effect e = named(name, {"alpha_over_Cth", "tau_th_s"}, {0.2 / (R * i * i * tau), tau}, {0});
        e.formula = "R*(1+y), der(y)=alpha_over_Cth*R*i^2-y/tau_th_s";
        e.own = {0};
        e.term = [R](std::size_t, const double* x, const double*, double, const double* own, const double*) {
            return -R * x[0] * own[0];
        };
        e.own_rate = [R](const double* x, const double*, const double* own, const double* q, double* rate) {
            rate[0] = q[0] * R * x[0] * x[0] - own[0] / q[1];
        };
        e.texts = {" - R*i*x_y"};
        e.own_signals = {"x_y = { initial = 0, scored = false }"};
        e.own_equations = {"der(x_y) = x_alpha_over_Cth*R*i^2 - x_y/x_tau_th_s"};
        return e;
    }
    return std::nullopt;
}

}  // namespace algest::gap
