// SPDX-License-Identifier: GPL-3.0-or-later
// What the effects of the library write into a model: names are replaced where they stand and nowhere else, states and constants move in.
#include <catch2/catch.hpp>

#include "lab/amend.hpp"
#include "lab/equation_places.hpp"
#include "lab/turned.hpp"

namespace {

using namespace algest;

/// Every text that an effect of the library makes of a model, all signals measured unless named in `without`.
std::vector<std::string> amended_by(const std::string& effect, const std::string& text, const std::string& without = "", bool every_unit_known = true) {
    Diagnostics said;
    const auto model = model::read_from_text(text, "m.toml", false, said);
    for (const auto& d : said.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(model);
    std::vector<bool> measured;
    for (const model::Signal& s : model->signals) measured.push_back(s.name != without);
    std::vector<std::string> out;
    const std::vector<lab::Effect> effects = lab::read_effects({ALGEST_SOURCE "/models/effects"}, said);
    REQUIRE_FALSE(effects.empty());
    for (const lab::Effect& e : effects) {
        if (e.name != effect) continue;
        for (const lab::Binding& b : lab::bindings(e, *model, measured)) {
            out.push_back(lab::amended(text, *model, lab::amendment(b, *model, 0.25)));
            CHECK(model::read_from_text(out.back(), "m.toml", every_unit_known, said));
            for (const auto& d : said.sorted()) UNSCOPED_INFO(d.text());
        }
    }
    return out;
}

bool has(const std::string& text, const std::string& part) {
    UNSCOPED_INFO(text);
    return text.find(part) != std::string::npos;
}

constexpr const char* motor = R"toml(name = "m"
[signals]
u = { unit = "V" }
i = { unit = "A", initial = 0 }
w = { unit = "rad/s", initial = 0 }   # encoder
th = { unit = "rad", initial = 0 }
[constants]
K = { unit = "N.m/A", value = 5e-2 }   # data sheet
L = { value = 0.002, unit = "H" }
[parameters]
R = { initial = 1.2, unit = "ohm" }
J = { initial = 3e-4, unit = "kg.m^2" }
[[equation]]
name = "voltage"
ode = "L*der(i) = u - R*i - K*w"   # copper
[[equation]]
name = "torque"
ode = "J*der(w) = K*i"

# The angle.
[[equation]]
name = "angle"
ode = "der(th) = w"
)toml";

}  // namespace

TEST_CASE("a sensor's gain divides its signal and the derivative in every equation, and is one binding a sensor") {
    const auto texts = amended_by("sensor_gain", motor);
    REQUIRE(texts.size() == 3);
    CHECK(has(texts[1], "ode = \"L*der(i) = u - R*i - K*(w/g)\"   # copper\n"));
    CHECK(has(texts[1], "ode = \"J*(der(w)/g) = K*i\"\n"));
    CHECK(has(texts[1], "ode = \"der(th) = (w/g)\"\n"));
    CHECK(amended_by("sensor_gain", motor, "w").size() == 2);
}

TEST_CASE("a sensor's bias leaves the derivative") {
    const auto texts = amended_by("sensor_bias", motor);
    REQUIRE(texts.size() == 3);
    CHECK(has(texts[0], "ode = \"L*der(i) = u - R*(-bias + i) - K*w\"   # copper\n"));
    CHECK(has(texts[0], "bias = { initial = 0, unit = \"A\" }"));
}

TEST_CASE("a sensor of degC may be off too, by a difference of temperatures, which has no unit of its own") {
    const auto texts = amended_by("sensor_bias", R"toml(name = "m"
[signals]
u = { unit = "V" }
T = { unit = "degC", initial = 20 }
[constants]
Ta = { value = 20, unit = "degC" }
[parameters]
C = { initial = 5, unit = "J/K" }
h = { initial = 1, unit = "W/K" }
k = { initial = 2, unit = "W/V" }
[[equation]]
ode = "C*der(T) = k*u - h*(T - Ta)"
)toml", "", false);
    REQUIRE(texts.size() == 1);
    CHECK(has(texts[0], "ode = \"C*der(T) = k*u - h*((-bias + T) - Ta)\"\n"));
    CHECK(has(texts[0], "bias = { initial = 0 }"));
}

TEST_CASE("a signal that is spelled like a name of the effect's own keeps it, the effect's gets a number") {
    const auto texts = amended_by("actuator_lag", R"toml(name = "m"
[signals]
tau = { unit = "N.m" }
w = { unit = "rad/s", initial = 0 }
[parameters]
J = { initial = 3e-4, unit = "kg.m^2" }
b = { initial = 1e-4, unit = "N.m.s/rad" }
[[equation]]
ode = "J*der(w) = tau - b*w"
)toml");
    REQUIRE(texts.size() == 1);
    CHECK(has(texts[0], "ode = \"J*der(w) = lagged - b*w\"\n"));
    CHECK(has(texts[0], "ode = \"tau2*der(lagged) = tau - lagged\"\n"));
}

TEST_CASE("inputs of one unit have one amplifier, those of another unit have another") {
    const auto texts = amended_by("actuator_lag", R"toml(name = "m"
[signals]
r = { unit = "m" }
F1 = { unit = "N" }
F2 = { unit = "N" }
x = { unit = "m", initial = 0 }
y = { unit = "m", initial = 0 }
[parameters]
m = { initial = 2, unit = "kg" }
k = { initial = 300, unit = "N/m" }
[[equation]]
ode = "m*der(x,2) = F1 - k*(x - r)"
[[equation]]
ode = "m*der(y,2) = F2 - k*y"
)toml");
    REQUIRE(texts.size() == 2);
    CHECK(has(texts[1], "ode = \"m*der(x,2) = lagged - k*(x - r)\"\n"));
    CHECK(has(texts[1], "ode = \"m*der(y,2) = lagged2 - k*y\"\n"));
    CHECK(has(texts[0], "ode = \"m*der(x,2) = F1 - k*(x - lagged)\"\n"));
    CHECK(has(texts[0], "ode = \"m*der(y,2) = F2 - k*y\"\n"));
}

TEST_CASE("what acts between two bodies comes into the balances of both, against each other") {
    const std::string car = R"toml(name = "m"
[signals]
r = { unit = "m" }
xs = { unit = "m", initial = 0 }
xu = { unit = "m", initial = 0 }
[parameters]
ms = { initial = 220, unit = "kg" }
mu = { initial = 28, unit = "kg" }
ks = { initial = 12000, unit = "N/m" }
kt = { initial = 116800, unit = "N/m" }
[[equation]]
name = "body"
ode = "ms*der(xs,2) = -ks*(xs - xu)"
[[equation]]
name = "wheel"
ode = "mu*der(xu,2) = ks*(xs - xu) - kt*(xu - r)"
)toml";
    const auto friction = amended_by("coulomb_friction", car);
    REQUIRE(friction.size() == 3);
    CHECK(has(friction[2], "ode = \"ms*der(xs,2) = -ks*(xs - xu) - Tc*sgn(der(xs)-der(xu))\"\n"));
    CHECK(has(friction[2], "ode = \"mu*der(xu,2) = ks*(xs - xu) - kt*(xu - r) + Tc*sgn(der(xs)-der(xu))\"\n"));
    const auto spring = amended_by("cubic_stiffness", car);
    REQUIRE(spring.size() == 3);
    CHECK(has(spring[2], "*(xs-xu)^3\"\n"));
    CHECK(amended_by("constant_load", car).size() == 2);   // it hangs on no motion: nobody knows between what it acts
    // A shaft: its bodies are known by their speeds.
    const auto shaft = amended_by("quadratic_drag", R"toml(name = "m"
[signals]
T = { unit = "N.m" }
w1 = { unit = "rad/s", initial = 0 }
w2 = { unit = "rad/s", initial = 0 }
[parameters]
J1 = { initial = 1, unit = "kg.m^2" }
J2 = { initial = 1, unit = "kg.m^2" }
d = { initial = 1, unit = "N.m.s/rad" }
[[equation]]
ode = "J1*der(w1) = T - d*(w1 - w2)"
[[equation]]
ode = "J2*der(w2) = d*(w1 - w2)"
)toml");
    REQUIRE(shaft.size() == 3);
    CHECK(has(shaft[2], "- kq*(w1-w2)*abs(w1-w2)\"\n"));
    CHECK(has(shaft[2], "+ kq*(w1-w2)*abs(w1-w2)\"\n"));
    // Two bodies that share nothing.
    std::string apart = car;
    apart.replace(apart.find("ks*(xs - xu) - kt"), 17, "ks*(xu - r) - kt");
    CHECK(amended_by("coulomb_friction", apart).size() == 2);
    // Divided by their masses the two have one friction F as F/ms and as F/mu: one parameter cannot be both.
    const std::string divided = R"toml(name = "m"
[signals]
r = { unit = "m" }
xs = { unit = "m", initial = 0 }
xu = { unit = "m", initial = 0 }
[parameters]
a = { initial = 54.5, unit = "1/s^2" }
b = { initial = 428.6, unit = "1/s^2" }
c = { initial = 4171, unit = "1/s^2" }
[[equation]]
ode = "der(xs,2) = -a*(xs - xu)"
[[equation]]
ode = "der(xu,2) = b*(xs - xu) - c*(xu - r)"
)toml";
    const auto alone = amended_by("coulomb_friction", divided);
    REQUIRE(alone.size() == 2);
    CHECK(has(alone[0], "ode = \"der(xu,2) = b*(xs - xu) - c*(xu - r)\"\n"));
    CHECK(has(alone[1], "ode = \"der(xs,2) = -a*(xs - xu)\"\n"));
}

TEST_CASE("the signs of a sum are turned, not those inside of its terms") {
    CHECK(lab::turned("-a*(b - c) + d") == "+a*(b - c) - d");
    CHECK(lab::turned("+k*x^-2 - e*-y") == "-k*x^-2 + e*-y");
    CHECK(lab::turned("a*b - c") == "-a*b + c");        // no sign is a plus
    CHECK(lab::turned("-a+b") == "+a-b");               // without blanks
    CHECK(lab::turned("-a*1e-3*b + 2E+3*c") == "+a*1e-3*b - 2E+3*c");   // an exponent's sign is the number's
    CHECK(lab::turned("- -a*b") == "+ -a*b");           // of two signs one
    CHECK(lab::turned("a - -b") == "-a + -b");
    CHECK(lab::turned("-T_1e*sgn({speed}) +c2e-d") == "+T_1e*sgn({speed}) -c2e+d");   // a name may end like an exponent
}

TEST_CASE("a constant that is let go keeps its comment, its unit and its digits among the parameters") {
    const auto texts = amended_by("parameter_error", motor);
    REQUIRE(texts.size() == 2);
    CHECK(has(texts[0], "[constants]\nL = { value = 0.002, unit = \"H\" }\n[parameters]\n"));
    CHECK(has(texts[0], "J = { initial = 3e-4, unit = \"kg.m^2\" }\nK = { unit = \"N.m/A\", initial = 0.05 }   # data sheet\n"));
    CHECK(has(texts[1], "L = { initial = 0.002, unit = \"H\" }\n"));
}

TEST_CASE("a state comes with its signal behind the last one and its equation behind the last one") {
    const auto texts = amended_by("actuator_lag", motor);
    REQUIRE(texts.size() == 1);
    CHECK(has(texts[0], "ode = \"L*der(i) = lagged - R*i - K*w\"   # copper\n"));
    CHECK(has(texts[0], "th = { unit = \"rad\", initial = 0 }\nlagged = { unit = \"V\", initial = 0, scored = false }"));
    CHECK(has(texts[0], "ode = \"der(th) = w\"\n\n[[equation]]\nname = \"actuator lag, lagged\"\node = \"tau*der(lagged) = u - lagged\"\n"));
    CHECK(has(texts[0], "tau = { initial = 0.25, unit = \"s\", min = 0 }"));
}

TEST_CASE("an inductance is replaced where it multiplies the highest derivative alone") {
    const auto texts = amended_by("magnetic_saturation", motor);
    REQUIRE(texts.size() == 1);
    CHECK(has(texts[0], "ode = \"(L/(1 + (i/isat)^2))*der(i) = u - R*i - K*w\""));
}

TEST_CASE("the q axis gets an inductance of its own, and the torque what the two make") {
    const auto texts = amended_by("saliency", R"toml(name = "m"
[signals]
vd = { unit = "V" }
vq = { unit = "V" }
id = { unit = "A", initial = 0 }
iq = { unit = "A", initial = 0 }
w = { unit = "rad/s", initial = 0 }
th = { unit = "rad", initial = 0 }
[constants]
pp = { value = 4, unit = "1" }
psi = { value = 0.03, unit = "Wb" }
[parameters]
R = { initial = 0.5, unit = "ohm" }
L = { initial = 0.003, unit = "H" }
J = { initial = 0.002, unit = "kg.m^2" }
[[equation]]
ode = "L*der(id) = vd - R*id + pp*w*L*iq"
[[equation]]
ode = "L*der(iq) = vq - R*iq - pp*w*L*id - pp*w*psi"
[[equation]]
ode = "J*der(w) = 1.5*pp*psi*iq"
[[equation]]
ode = "der(th) = w"
)toml");
    REQUIRE(texts.size() == 1);
    CHECK(has(texts[0], "\"L*der(id) = vd - R*id + pp*w*Lq*iq\""));
    CHECK(has(texts[0], "\"Lq*der(iq) = vq - R*iq - pp*w*L*id - pp*w*psi\""));
    CHECK(has(texts[0], "\"J*der(w) = 1.5*pp*psi*iq + 1.5*pp*(L - Lq)*id*iq\""));
    CHECK(has(texts[0], "Lq = { initial = 0, unit = \"H\", min = 0 }"));
}

TEST_CASE("what runs over is lost, or comes into what the vessel feeds") {
    constexpr const char* tanks = R"toml(name = "m"
[signals]
u = { unit = "V" }
h1 = { unit = "m", initial = 0 }
h2 = { unit = "m", initial = 0 }
p = { unit = "1/s", initial = 0 }
y = { unit = "m" }
[constants]
M = { unit = "m.s^2", value = 2 }
[parameters]
k1 = { initial = 1, unit = "1/s" }
k2 = { initial = 1, unit = "1/s" }
b = { initial = 1, unit = "m/(V.s)" }
[[equation]]
ode = "der(h1) = b*u - k1*h1"
[[equation]]
ode = "der(h2) = k1*h1 - k2*h2"
[[equation]]
ode = "M*der(p) = h1"
[[equation]]
ode = "y = h1"
)toml";
    const auto texts = amended_by("overflow", tanks);
    REQUIRE(texts.size() == 2);
    CHECK(has(texts[0], "\"der(h1) = b*u - k1*h1 - kover*max(h1 - brim,0)\""));
    CHECK(has(texts[0], "\"der(h2) = k1*h1 - k2*h2 + kcatch*max(h1 - brim,0)\""));
    CHECK(has(texts[0], "kcatch = { initial = 0, unit = \"1/s\", min = 0 }"));
    CHECK(has(texts[1], "\"der(h2) = k1*h1 - k2*h2 - kover*max(h2 - brim,0)\""));   // it feeds nothing
    CHECK_FALSE(has(texts[1], "kcatch"));
}

TEST_CASE("dry friction differs between the directions only where the model has one") {
    CHECK(amended_by("asymmetric_friction", motor).empty());
    const std::string with = std::string(motor).replace(std::string(motor).find("K*i\""), 4, "K*i - Tc*sgn(w)\"");
    const auto texts = amended_by("asymmetric_friction", std::string(with).insert(with.find("J = {"), "Tc = { initial = 1e-2, unit = \"N.m\" }\n"));
    REQUIRE(texts.size() == 1);
    CHECK(has(texts[0], "ode = \"J*der(w) = K*i - (Tc + T_skew*sgn(w))*sgn(w)\""));
}

TEST_CASE("play opens the spring and the damper of a shaft, whichever way round the difference is written") {
    const auto texts = amended_by("backlash", R"toml(name = "m"
[signals]
T = { unit = "N.m" }
w1 = { unit = "rad/s", initial = 0 }
w2 = { unit = "rad/s", initial = 0 }
th1 = { unit = "rad", initial = 0 }
th2 = { unit = "rad", initial = 0 }
[parameters]
J1 = { initial = 1, unit = "kg.m^2" }
J2 = { initial = 1, unit = "kg.m^2" }
k = { initial = 1, unit = "N.m/rad" }
c = { initial = 1, unit = "N.m.s/rad" }
[[equation]]
ode = "J1*der(w1) = T - k*(th1 - th2) - c*(w1 - w2)"
[[equation]]
ode = "J2*der(w2) = -k*(th2-th1) + c*(w1-w2)"
[[equation]]
ode = "der(th1) = w1"
[[equation]]
ode = "der(th2) = w2"
)toml");
    REQUIRE(texts.size() == 1);
    CHECK(has(texts[0], "T - k*(max((th1-th2) - delta,0) + min((th1-th2) + delta,0)) - c*((w1 - w2)*min(max(abs((th1-th2))/delta - 1,0)*200,1))\""));
    CHECK(has(texts[0], "\"J2*der(w2) = -k*(-(max((th1-th2) - delta,0) + min((th1-th2) + delta,0))) + c*((w1-w2)*min("));
}
