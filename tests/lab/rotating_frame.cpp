// SPDX-License-Identifier: GPL-3.0-or-later
// A rotating frame is found by its cross coupling, whatever the equations are called and in whatever order they stand.
#include "lab/rotating_frame.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace algest;

constexpr const char* head = R"toml(name = "m"
[signals]
a = { unit = "A" }
b = { unit = "A" }
va = { unit = "V" }
vb = { unit = "V" }
w = { unit = "rad/s" }
th = { unit = "rad" }
w2 = { unit = "rad/s" }
[constants]
n_p = { value = 4, unit = "1" }
[parameters]
R = { unit = "ohm", initial = 1 }
La = { unit = "H", initial = 0.02 }
Lb = { unit = "H", initial = 0.05 }
K = { unit = "V.s", initial = 0.1 }
p = { unit = "1", initial = 3 }
)toml";

/// The frame of these equations, signals being measured unless named in `without`.
std::optional<lab::RotatingFrame> frame(const std::vector<std::string>& odes, const std::string& without = "") {
    std::string text = head;
    for (const std::string& ode : odes) text += "[[equation]]\node = \"" + ode + "\"\n";
    Diagnostics said;
    const auto model = model::read_from_text(text, "m.toml", false, said);
    for (const auto& d : said.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(model);
    std::vector<bool> measured;
    for (const model::Signal& s : model->signals) measured.push_back(s.name != without);
    return lab::rotating_frame(*model, measured);
}

constexpr const char* d_axis = "La*der(a) = va - R*a + n_p*w*Lb*b";
constexpr const char* q_axis = "Lb*der(b) = vb - R*b - n_p*w*La*a - K*w";
constexpr const char* kinematics = "der(th) = w";

}  // namespace

TEST_CASE("rotating frame: a salient machine; the inductances cancel from the pairs of poles") {
    const auto f = frame({d_axis, q_axis, kinematics});
    REQUIRE(f);
    CHECK(f->d_equation == 0);
    CHECK(f->q_equation == 1);
    CHECK(f->d_current == "a");
    CHECK(f->q_current == "b");
    CHECK(f->angle == "n_p*th");
}

TEST_CASE("rotating frame: the signs of the coupling say which axis is which, not the order or the side of the terms") {
    const auto f = frame({kinematics, "-vb + R*b + K*w + n_p*w*La*a = -Lb*der(b)", "va - R*a = La*der(a) - n_p*b*w*Lb"});
    REQUIRE(f);
    CHECK(f->d_equation == 2);
    CHECK(f->q_equation == 1);
    CHECK(f->d_current == "a");
    CHECK(f->angle == "n_p*th");
    const auto turned = frame({"La*der(a) = va - R*a - n_p*w*Lb*b", "Lb*der(b) = vb - R*b + n_p*w*La*a", kinematics});   // the other way round: a is q
    REQUIRE(turned);
    CHECK(turned->d_equation == 1);
    CHECK(turned->d_current == "b");
    CHECK(turned->q_current == "a");
}

TEST_CASE("rotating frame: pairs of poles without a name are a number, one pair is none") {
    const auto seven = frame({"La*der(a) = va - R*a + 7*w*Lb*b", "Lb*der(b) = vb - R*b - 7*w*La*a", kinematics});
    REQUIRE(seven);
    CHECK(seven->angle == "7*th");
    const auto one = frame({"La*der(a) = va - R*a + w*Lb*b", "Lb*der(b) = vb - R*b - w*La*a", kinematics});
    REQUIRE(one);
    CHECK(one->angle == "th");
    const auto free = frame({"La*der(a) = va - R*a + p*w*Lb*b", "Lb*der(b) = vb - R*b - p*w*La*a", kinematics});   // a parameter: its initial value
    REQUIRE(free);
    CHECK(free->angle == "3*th");
    const auto mean = frame({"La*der(a) = va - R*a + 2*w*Lb*b", "Lb*der(b) = vb - R*b - 8*w*La*a", kinematics});   // sqrt(2*8)
    REQUIRE(mean);
    CHECK(mean->angle == "n_p*th");
}

TEST_CASE("rotating frame: none without a coupling in opposite senses by one speed") {
    CHECK_FALSE(frame({"La*der(a) = va - R*a", "Lb*der(b) = vb - R*b", kinematics}));
    CHECK_FALSE(frame({"La*der(a) = va - R*a + n_p*w*Lb*b", "Lb*der(b) = vb - R*b", kinematics}));
    CHECK_FALSE(frame({"La*der(a) = va - R*a + n_p*w*Lb*b", "Lb*der(b) = vb - R*b + n_p*w*La*a", kinematics}));
    CHECK_FALSE(frame({"La*der(a) = va - R*a - n_p*w*Lb*b", "Lb*der(b) = vb - R*b - n_p*w*La*a", kinematics}));
    CHECK_FALSE(frame({"La*der(a) = va - R*a + n_p*w*Lb*b", "Lb*der(b) = vb - R*b - n_p*w2*La*a", kinematics}));   // two speeds
    CHECK_FALSE(frame({"La*der(a) = va - R*a + n_p*w*Lb*a", "Lb*der(b) = vb - R*b - n_p*w*La*b", kinematics}));   // each with itself
}

TEST_CASE("rotating frame: none without a measured angle") {
    CHECK_FALSE(frame({d_axis, q_axis}));
    CHECK_FALSE(frame({d_axis, q_axis, kinematics}, "th"));
    CHECK(frame({d_axis, q_axis, kinematics}, "w"));
}
