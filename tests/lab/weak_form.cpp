// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of an equation on a recording, against what its closed-form solution says of them.
#include "lab/weak_form.hpp"

#include <cmath>
#include <random>

#include "tests/lab/scene.hpp"

using namespace algest;
using algest::lab::Rows;
using algest::test::Scene;

namespace {

constexpr std::size_t samples = 2001;

const char* const sliding = R"toml(name = "sliding"
[sampling]
period = 1e-3
[signals]
F = { unit = "N" }
v = { unit = "m/s", noise = 0.01 }
[parameters]
m = { unit = "kg", initial = 1, min = 0 }
d = { unit = "N.s/m", initial = 1 }
[[equation]]
ode = "m*der(v) = F - d*v"
)toml";

constexpr double mass = 2.0, damping = 3.0;

/// A speed that begins away from rest, and the force that 2 kg and 3 N.s/m need for it.
double speed(double t) { return 0.7 + std::sin(5 * t) + 0.5 * std::cos(11 * t); }
double force(double t) { return mass * (5 * std::cos(5 * t) - 5.5 * std::sin(11 * t)) + damping * speed(t); }

struct Slide {
    explicit Slide(const std::function<double(double)>& v = speed, const std::function<double(double)>& F = force)
        : scene(sliding), recording(scene.recorded(samples, {{"F", F}, {"v", v}})), bench(*lab::bench(scene.model, recording, scene.diagnostics)) {}
    Scene scene;
    lab::Recording recording;
    lab::Bench bench;
};

}  // namespace

TEST_CASE("weak form: rows vanish at the truth and give it back, whatever the initial value") {
    const Slide s;
    const auto form = lab::weak_form(s.scene.model, s.bench, 0, Rows{0, samples}, 200);
    REQUIRE(form);
    CHECK(form->driven);
    CHECK(form->columns.cols() == 3);
    CHECK(form->columns.rows() == 19);                 // windows of 201 samples, one every 100
    CHECK(form->centre.front() == 100);
    const std::vector<double> truth = {mass, damping};
    // Signals taken as straight between samples: (11e-3)^2/12 = 1e-5 of the largest.
    CHECK(lab::weak_residual(*form, truth).cwiseAbs().maxCoeff() < 2e-5 * lab::driving_size(*form, truth));
    CHECK(lab::weak_residual(*form, {mass, 1.1 * damping}).cwiseAbs().maxCoeff() > 1e-3 * lab::driving_size(*form, truth));
    CHECK(lab::input_size(*form, truth) == Approx(lab::driving_size(*form, truth)).epsilon(1e-12));   // F alone drives, with the known coefficient 1
    const lab::WeakFit found = lab::weak_fit(*form, {1.0, 1.0});
    CHECK(found.parameters[0] == Approx(mass).epsilon(1e-4));
    CHECK(found.parameters[1] == Approx(damping).epsilon(1e-4));
    CHECK(found.windows == 19);
    CHECK(found.unknowns == 2);
}

TEST_CASE("weak form: the noise of a row is what noise in the signal makes of it") {
    const Slide quiet;
    const std::vector<double> truth = {mass, damping};
    const int intervals = 100;
    const double said = lab::weak_noise(quiet.scene.model, quiet.bench, 0, Rows{0, samples}, intervals, truth, {0.0, 0.01});
    std::mt19937 random(11);
    std::normal_distribution<double> noise(0.0, 0.01);
    double squares = 0, rows = 0;
    for (int draw = 0; draw < 40; ++draw) {
        const Slide noisy([&](double t) { return speed(t) + noise(random); });
        const auto form = lab::weak_form(noisy.scene.model, noisy.bench, 0, Rows{0, samples}, intervals);
        REQUIRE(form);
        squares += lab::weak_residual(*form, truth).squaredNorm();
        rows += static_cast<double>(form->columns.rows());
    }
    // 40 recordings of 39 half-overlapping windows: some 1000 that are independent, 1/sqrt(2000) = 2.2 percent; four of those.
    CHECK(std::sqrt(squares / rows) == Approx(said).epsilon(0.09));
    CHECK(lab::weak_noise(quiet.scene.model, quiet.bench, 0, Rows{0, samples}, intervals, truth, {0.0, 0.02}) == Approx(2 * said));
}

TEST_CASE("weak form: none where a signal is not measured, or the stretch is shorter than two windows") {
    const Slide s;
    CHECK_FALSE(lab::weak_form(s.scene.model, s.bench, 0, Rows{0, 250}, 200));
    Scene unmeasured("name = \"u\"\n[sampling]\nperiod = 1e-3\n[signals]\nF = { unit = \"N\" }\nv = { unit = \"m/s\", initial = 0 }\nx = { unit = \"m\" }\n[parameters]\n"
                     "m = { unit = \"kg\", initial = 1 }\n[[equation]]\node = \"m*der(v) = F\"\n[[equation]]\node = \"der(x) = v\"\n");
    const auto bench = lab::bench(unmeasured.model, unmeasured.recorded(samples, {{"F", force}, {"x", speed}}), unmeasured.diagnostics);
    REQUIRE(bench);
    CHECK_FALSE(lab::has_weak_form(unmeasured.model, *bench, 0));
}

TEST_CASE("weak form: windows in which a product is no finite number say nothing, the others stay as they are") {
    const std::string rooted = std::string(sliding).replace(std::string(sliding).find("- d*v"), 5, "- d*sqrt(v)");
    Scene scene(rooted.c_str());
    const auto dips = [](double t) { return t > 0.55 && t < 0.56 ? -0.1 : 2 + std::sin(5 * t); };   // 10 samples, of 2001
    const auto bench = lab::bench(scene.model, scene.recorded(samples, {{"F", force}, {"v", dips}}), scene.diagnostics);
    const auto whole = lab::bench(scene.model, scene.recorded(samples, {{"F", force}, {"v", [](double t) { return 2 + std::sin(5 * t); }}}), scene.diagnostics);
    REQUIRE(bench);
    REQUIRE(whole);
    const auto form = lab::weak_form(scene.model, *bench, 0, Rows{0, samples}, 100);
    const auto plain = lab::weak_form(scene.model, *whole, 0, Rows{0, samples}, 100);
    REQUIRE(form);
    REQUIRE(plain);
    CHECK(plain->left_out == 0);
    CHECK(form->left_out == 2);   // windows of 101 samples, one every 50: those that begin at 500 and 550, less the one sample
    Eigen::Index alike = 0;
    for (Eigen::Index w = 0; w < form->columns.rows(); ++w) alike += form->columns.row(w) == plain->columns.row(w) ? 1 : 0;
    CHECK(alike == form->columns.rows() - 2);
    CHECK(form->columns.allFinite());
}

TEST_CASE("weak form: a parameter that no row sees has no finite deviation") {
    const Slide still([](double) { return 0.0; }, [](double) { return 0.0; });
    const lab::WeakEstimate e = lab::weak_estimate(still.scene.model, {{&still.bench, Rows{0, samples}}}, 200, {1.0, 1.0});
    CHECK(std::isinf(e.sd[0]));
    CHECK(std::isinf(e.sd[1]));
    CHECK(e.parameters == std::vector<double>{1.0, 1.0});
}

TEST_CASE("weak form: two parameters that no row tells apart have no finite deviation, the third one has") {
    Scene twice("name = \"t\"\n[sampling]\nperiod = 1e-3\n[signals]\nF = { unit = \"N\" }\nv = { unit = \"m/s\", initial = 0, noise = 1e-3 }\n[parameters]\n"
                "m = { unit = \"kg\", initial = 1 }\nb = { unit = \"N.s/m\", initial = 1 }\nc = { unit = \"N.s/m\", initial = 1 }\n[[equation]]\node = \"m*der(v) = F - b*v - c*v\"\n");
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 1e-3);
    const auto bench = lab::bench(twice.model, twice.recorded(samples, {{"F", force}, {"v", [&](double t) { return speed(t) + noise(random); }}}), twice.diagnostics);
    REQUIRE(bench);
    const lab::WeakEstimate e = lab::weak_estimate(twice.model, {{&*bench, Rows{0, samples}}}, 100, {1.0, 1.0, 1.0});
    CHECK(std::isfinite(e.sd[0]));
    CHECK(std::isinf(e.sd[1]));
    CHECK(std::isinf(e.sd[2]));
    CHECK(e.parameters[1] + e.parameters[2] == Approx(damping).epsilon(0.05));   // noise of 1e-3 over a second
}
