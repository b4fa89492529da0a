// SPDX-License-Identifier: GPL-3.0-or-later
// What an equation moves and what may stand for the roles of an effect in it, read off the models below.
#include "lab/roles.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace algest;

model::Model model_of(const std::string& text) {
    Diagnostics said;
    auto out = model::read_from_text("name = \"m\"\n" + text, "m.toml", false, said);
    for (const auto& d : said.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(out);
    return *out;
}

const model::Model& motor() {
    static const model::Model m = model_of(R"toml([signals]
u = { unit = "V" }
i = { unit = "mA" }
w = { unit = "rad/s" }
th = { unit = "rad" }
load = { unit = "N.m" }
plain = {}
[parameters]
p = {}
q = {}
r = {}
[[equation]]
ode = "der(i) = p*u - q*i - r*w"
[[equation]]
ode = "p*i + q*load + plain = der(w)"
[[equation]]
ode = "w = der(th)"
[[equation]]
ode = "p*u + q*i = r*w"
)toml");
    return m;
}

const model::Model& cart() {
    static const model::Model m = model_of(R"toml([signals]
F = { unit = "N" }
x = { unit = "mm" }
v = { unit = "m/s" }
[parameters]
m = {}
p = {}
q = {}
[[equation]]
ode = "m*der(x,2) = F - p*der(x) - q*v"
)toml");
    return m;
}

/// "formula [unit]" of every filler.
std::vector<std::string> of(const std::string& kind, const model::Model& model, std::size_t equation, std::vector<bool> measured = {}) {
    measured.resize(model.signals.size(), true);
    std::vector<std::string> out;
    for (const lab::Filler& f : lab::fillers(kind, model, equation, measured)) out.push_back(f.formula + " [" + f.unit + "]");
    return out;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("roles: an equation moves the signal of its first highest derivative, on either side") {
    const auto is = [](const lab::Moved& m, const model::Model& model, const std::string& name, int order) { return m.signal == model.signal_index(name) && m.order == order; };
    CHECK(is(lab::moved(motor(), motor().equations[0]), motor(), "i", 1));
    CHECK(is(lab::moved(motor(), motor().equations[1]), motor(), "w", 1));
    CHECK(is(lab::moved(motor(), motor().equations[2]), motor(), "th", 1));
    CHECK(lab::moved(motor(), motor().equations[3]).signal == -1);
    CHECK(is(lab::moved(cart(), cart().equations[0]), cart(), "x", 2));   // not der(x), not der of the last signal
    const model::Model pair = model_of("[signals]\nx = {}\ny = {}\n[parameters]\na = {}\n[[equation]]\node = \"der(y) + a*der(x) = x\"\n");
    CHECK(is(lab::moved(pair, pair.equations[0]), pair, "y", 1));
}

TEST_CASE("roles: the integral of a speed, where the model says der(x) = v in either order") {
    CHECK(lab::integral_of(motor(), motor().signal_index("w")) == motor().signal_index("th"));
    CHECK(lab::integral_of(motor(), motor().signal_index("i")) == -1);
    CHECK(lab::integral_of(cart(), cart().signal_index("v")) == -1);
    const model::Model other = model_of("[signals]\nx = {}\nv = {}\n[parameters]\na = {}\n[[equation]]\node = \"der(x) = v\"\n[[equation]]\node = \"der(v) = a*x\"\n");
    CHECK(lab::integral_of(other, other.signal_index("v")) == other.signal_index("x"));
    CHECK(lab::integral_of(other, other.signal_index("x")) == -1);   // der(v) = a*x is no kinematics
    const model::Model second = model_of("[signals]\nx = {}\nv = {}\n[parameters]\na = {}\n[[equation]]\node = \"der(x,2) = v\"\n[[equation]]\node = \"der(v) = a\"\n");
    CHECK(lab::integral_of(second, second.signal_index("v")) == -1);
}

TEST_CASE("roles: what stands for each kind in the equations of a motor") {
    CHECK(of("own", motor(), 0) == Texts{"i [mA]"});
    CHECK(of("own", motor(), 1) == Texts{"w [rad/s]"});
    CHECK(of("own", motor(), 3) == Texts{});
    CHECK(of("current", motor(), 0) == Texts{"i [mA]"});
    CHECK(of("current", motor(), 1) == Texts{});
    CHECK(of("speed", motor(), 0) == Texts{});
    CHECK(of("speed", motor(), 1) == Texts{"w [rad/s]"});
    CHECK(of("speed", motor(), 2) == Texts{});                  // der(th) = w moves an angle, at first order
    CHECK(of("angle", motor(), 1) == Texts{"th [rad]"});
    CHECK(of("position", motor(), 1) == Texts{"th [rad]"});
    CHECK(of("angle", motor(), 0) == Texts{});
    CHECK(of("any_speed", motor(), 0) == Texts{"w [rad/s]"});
    CHECK(of("any_speed", motor(), 1) == Texts{});              // its own is not any other
    CHECK(of("input", motor(), 1) == Texts{"u [V]", "load [N.m]", "plain []"});
    CHECK(of("time", motor(), 1) == Texts{"t [s]"});
    CHECK(of("none of these", motor(), 1) == Texts{});
}

TEST_CASE("roles: a sensor that is not there stands for no input and no other speed, but a state may be its own") {
    const std::vector<bool> two = {true, true, false, false, false, true};   // u, i and plain
    CHECK(of("input", motor(), 1, two) == Texts{"u [V]", "plain []"});
    CHECK(of("any_speed", motor(), 0, two) == Texts{});
    CHECK(of("speed", motor(), 1, two) == Texts{"w [rad/s]"});
    CHECK(of("angle", motor(), 1, two) == Texts{"th [rad]"});
}

TEST_CASE("roles: where an equation moves a position its speed is a derivative") {
    CHECK(of("speed", cart(), 0) == Texts{"der(x) [(mm)/s]"});
    CHECK(of("position", cart(), 0) == Texts{"x [mm]"});
    CHECK(of("angle", cart(), 0) == Texts{});                   // a length is none
    CHECK(of("any_speed", cart(), 0) == Texts{"v [m/s]"});
    CHECK(of("input", cart(), 0) == Texts{"F [N]", "v [m/s]"});
}

TEST_CASE("roles: a speed that moves at second order is no speed of a force balance") {
    const model::Model jerk = model_of("[signals]\nw = { unit = \"rad/s\" }\nx = { unit = \"m\" }\n[parameters]\np = {}\n[[equation]]\node = \"der(w,2) = p*w\"\n[[equation]]\node = \"der(x) = p*x\"\n");
    CHECK(of("speed", jerk, 0) == Texts{});
    CHECK(of("speed", jerk, 1) == Texts{});
    CHECK(of("position", jerk, 1) == Texts{});
}

/// A machine in its rotor's frame, with a shaft.
const model::Model& geared() {
    static const model::Model m = model_of(R"toml([signals]
vd = { unit = "V" }
vq = { unit = "V" }
id = { unit = "A" }
iq = { unit = "A" }
w = { unit = "rad/s" }
th = { unit = "rad" }
load = { unit = "rad" }
[constants]
pairs = { value = 4, unit = "1" }
flux = { value = 0.03, unit = "Wb" }
[parameters]
R = { unit = "ohm", initial = 1 }
L = { unit = "H", initial = 0.1 }
J = { unit = "kg.m^2", initial = 1 }
k = { unit = "N.m/rad", initial = 1 }
Tc = { unit = "N.m", initial = 1 }
[[equation]]
ode = "L*der(id) = vd - R*id + pairs*w*L*iq"
[[equation]]
ode = "L*der(iq) = vq - R*iq - pairs*w*L*id - pairs*w*flux"
[[equation]]
ode = "J*der(w) = 1.5*pairs*flux*iq - k*(th - load) - Tc*sgn(w)"
[[equation]]
ode = "der(th) = w"
)toml");
    return m;
}

TEST_CASE("roles: quantities, differences and constants as they stand in an equation") {
    CHECK(of("leading", geared(), 0) == Texts{"L [H]"});
    CHECK(of("leading", geared(), 2) == Texts{"J [kg.m^2]"});
    CHECK(of("leading", geared(), 3) == Texts{});
    CHECK(of("factor", geared(), 1) == Texts{"R [ohm]"});
    CHECK(of("dry_friction", geared(), 2) == Texts{"Tc [N.m]"});
    CHECK(of("dry_friction", geared(), 1) == Texts{});
    CHECK(of("difference", geared(), 2) == Texts{"(load-th) [rad]"});
    CHECK(of("difference", geared(), 0) == Texts{});
    CHECK(of("constant", geared(), 1) == Texts{"flux [Wb]"});   // nobody is wrong about a number of poles
    CHECK(of("constant", geared(), 0) == Texts{});
    CHECK(of("actuator", geared(), 0) == Texts{"vd [V]"});
    CHECK(of("drive", geared(), 2) == Texts{"iq [A]"});
    CHECK(of("sensor", geared(), 2) == Texts{"w [rad/s]"});
    CHECK(of("pole_pairs", geared(), 0) == Texts{"pairs [1]"});
    CHECK(of("rotor_speed", geared(), 0) == Texts{"w [rad/s]"});
    CHECK(of("q_current", geared(), 1) == Texts{});        // seen from the d equation
}

TEST_CASE("roles: every kind that a file may name stands for something somewhere") {
    for (const lab::RoleKind& kind : lab::role_kinds()) {
        bool found = false;
        for (const model::Model* m : {&motor(), &cart(), &geared()}) for (std::size_t e = 0; e < m->equations.size(); ++e) {
            for (const lab::Filler& f : lab::fillers(kind.name, *m, e, std::vector<bool>(m->signals.size(), true))) {
                found = true;
                if (f.unit.empty()) continue;   // what has no unit fits any
                const auto unit = units::Unit::parse(f.unit);
                REQUIRE(unit);
                // And its unit is one that the kind is said to have.
                CHECK((kind.units.empty() || std::any_of(kind.units.begin(), kind.units.end(), [&](const std::string& u) { return lab::fits(*unit, u); })));
            }
        }
        INFO(kind.name);
        CHECK(found);
    }
}

TEST_CASE("roles: time is the model's own signal, else the first name that is free") {
    CHECK(lab::time_name(cart()) == "t");
    const auto with = [](const std::string& names) { return lab::time_name(model_of("[signals]\nx = {}\n" + names + "[[equation]]\node = \"der(x) = x\"\n")); };
    CHECK(with("clock = { unit = \"s\", column = \"t\" }\n") == "clock");
    CHECK(with("[parameters]\nT = {}\n") == "time");             // t and T would differ by case alone
    CHECK(with("t = { column = \"temperature\" }\n") == "time");
    CHECK(with("t = { column = \"temperature\" }\n[constants]\ntime = { value = 1 }\n") == "recording_time");
}

TEST_CASE("roles: units fit by dimension, and nothing fits the unknown") {
    const auto unit = [](const std::string& text) { return *units::Unit::parse(text); };
    CHECK(lab::fits(unit("rpm"), "rad/s"));
    CHECK(lab::fits(unit("mA"), "A"));
    CHECK_FALSE(lab::fits(unit("V"), "A"));
    CHECK_FALSE(lab::fits(units::Unit(), "A"));
    CHECK_FALSE(lab::fits(unit("A"), "no unit"));
}

TEST_CASE("what an equation balances is told by what it moves, whatever its unit") {
    using lab::balanced;
    CHECK(balanced(motor(), motor().equations[0]) == "V");
    CHECK(balanced(motor(), motor().equations[1]) == "N.m");
    CHECK(balanced(motor(), motor().equations[2]) == "");   // a kinematic tie is no balance
    CHECK(balanced(motor(), motor().equations[3]) == "");   // nor is what moves nothing
    CHECK(balanced(cart(), cart().equations[0]) == "N");
    const model::Model plain = model_of(R"toml([signals]
y = {}
z = { unit = "V" }
[parameters]
p = {}
[[equation]]
ode = "der(y,2) = -p*y"
[[equation]]
ode = "der(z) = -p*z"
)toml");
    CHECK(balanced(plain, plain.equations[0]) == "N");
    CHECK(balanced(plain, plain.equations[1]) == "");       // of first order volts may show anything
}
