// SPDX-License-Identifier: GPL-3.0-or-later
// What the effects of the library write into a model: names are replaced where they stand and nowhere else, states and constants move in.
#include <catch2/catch.hpp>

#include "lab/amend.hpp"
#include "lab/equation_places.hpp"

namespace {

using namespace algest;

/// Every text that an effect of the library makes of a model, all signals measured unless named in `without`.
std::vector<std::string> amended_by(const std::string& effect, const std::string& text, const std::string& without = "") {
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
            CHECK(model::read_from_text(out.back(), "m.toml", true, said));
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
    CHECK(has(texts[0], "ode = \"L*der(i) = u - R*(i - bias) - K*w\"   # copper\n"));
    CHECK(has(texts[0], "bias = { initial = 0, unit = \"A\" }"));
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
