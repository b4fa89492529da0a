// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is fed, an `ok` estimate is a number, values are held otherwise, and what says nothing of the parameters is singular.
#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "generator/generate.hpp"
#include "lab/host_estimator.hpp"
#include "tests/generated/committed.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::test;

namespace {

plan::Plan plan_of(const char* model, plan::Scalar scalar, const std::string& engine = "") {
    Diagnostics diagnostics;
    const auto plan =
        generator::plan_from_model(std::string(ALGEST_SOURCE "/models/") + model + ".toml", {scalar, engine}, diagnostics);
    REQUIRE(plan);
    return *plan;
}

/// Runs a host estimator, whose bits are those of the generated class, and checks every answer.
template <class S>
class Watched {
public:
    explicit Watched(const plan::Plan& plan) : plan_(plan), estimator_(plan), held_(estimator_.parameters()) {}

    Status step(const std::vector<S>& inputs) {
        const Status status = estimator_.step(inputs.data());
        bool finite = true;
        for (const S v : inputs) finite = finite && std::isfinite(v);
        if (!finite) REQUIRE(status == Status::rejected);
        if (status == Status::ok) {
            REQUIRE(std::isfinite(estimator_.condition()));
            REQUIRE(estimator_.condition() >= S(0.999));
            for (const S p : estimator_.parameters()) REQUIRE(std::isfinite(p));
            held_ = estimator_.parameters();
        } else {
            REQUIRE(estimator_.parameters() == held_);
        }
        ++count[static_cast<std::size_t>(status)];
        return status;
    }
    void reset() {
        estimator_.reset();
        held_ = estimator_.parameters();
    }

    /// After what was fed before: ok again when its windows and sums are full of sound samples. Least squares takes what it
    /// needs for a condition that float can carry, some turns of the speed.
    bool heals() {
        const int extra = plan_.solve == Solve::least_squares ? 1000 : 2 * plan_.solve_instants + 5;
        const int fill = plan_.samples_to_first_estimate() + extra;
        Status status = Status::filling;
        for (int k = 0; k < fill; ++k) status = step(sound(k));
        return status == Status::ok;
    }
    std::vector<S> sound(int k) const {
        const bool turns = plan_.name == model<generated::Servo>, has_noise = plan_.name == model<generated::PmsmElectrical>;
        const double about = turns ? middle<generated::Servo> : has_noise ? middle<generated::PmsmElectrical> : middle<void>;
        const double by = turns ? size<generated::Servo> : has_noise ? size<generated::PmsmElectrical> : size<void>;
        std::vector<S> out;
        for (std::size_t i = 0; i < plan_.inputs.size(); ++i) {
            const double phase = (0.011 + 0.0073 * static_cast<double>(i)) * k;
            const double rough = static_cast<double>((k * 7919 + static_cast<int>(i) * 104729) % 1009) / 1009.0;
            out.push_back(static_cast<S>(about + by * (std::sin(phase) + 0.3 * std::cos(2.9 * phase) + 0.1 * rough)));
        }
        return out;
    }
    const plan::Plan& plan() const { return plan_; }

    std::array<int, 4> count{};

private:
    const plan::Plan& plan_;
    lab::HostEstimator<S> estimator_;
    std::vector<S> held_;
};

/// What a broken sensor, wire or program may deliver.
template <class S>
std::vector<std::function<S(std::mt19937_64&)>> regimes() {
    using Limits = std::numeric_limits<S>;
    const auto one_of = [](std::vector<S> values) {
        return [values](std::mt19937_64& random) { return values[random() % values.size()]; };
    };
    const S huge = std::sqrt(Limits::max());
    return {
        one_of({S(0), -S(0)}),
        one_of({Limits::max(), Limits::lowest()}),
        one_of({Limits::max()}),
        one_of({huge, -huge, huge / S(3)}),
        one_of({Limits::denorm_min(), -Limits::denorm_min(), Limits::min(), S(0)}),
        one_of({std::sqrt(Limits::min()), -std::sqrt(Limits::min())}),
        one_of({S(1), S(1), S(1), S(1), Limits::max()}),
        one_of({S(1), S(2), S(3), S(-1), Limits::denorm_min(), huge}),
        one_of({S(1), S(2), S(3), S(4), S(5), S(6), S(7), S(8), Limits::quiet_NaN(), Limits::infinity()}),
    };
}

template <class S>
void survives(const char* model, const plan::Plan& plan) {
    Watched<S> estimator(plan);
    std::mt19937_64 random(21);
    const int fill = std::max(plan.samples_to_first_estimate(), 60);   // some of every regime, where a window is one sample
    std::size_t number = 0;
    for (const auto& value : regimes<S>()) {
        INFO(model << ", regime " << number++);
        // alone
        std::vector<S> inputs(plan.inputs.size());
        const int steps = plan.solve == Solve::square ? fill + 20 : 2 * fill + 20;
        for (int k = 0; k < steps; ++k) {
            for (S& v : inputs) v = value(random);
            estimator.step(inputs);
        }
        // now and then among sound samples
        for (int k = 0; k < 3 * fill; ++k) {
            inputs = estimator.sound(k);
            if (k % (fill / 2 + 3) == 0) inputs[random() % inputs.size()] = value(random);
            estimator.step(inputs);
        }
        if (plan.solve == Solve::least_squares) {
            estimator.reset();  // rows that were absorbed stay: that is what it is for
        }
        CHECK(estimator.heals());
    }
    CHECK(estimator.count[static_cast<std::size_t>(Status::ok)] > 100);
    CHECK(estimator.count[static_cast<std::size_t>(Status::rejected)] > 50);
}

/// The status of one estimator after it was fed `inputs` long enough to be full, and before that `moved` windows of sound samples.
template <class S = double>
Status fed(const char* model, const std::function<std::vector<double>(int)>& inputs, const std::string& engine = "", int moved = 0) {
    const plan::Plan plan = plan_of(model, std::is_same_v<S, double> ? plan::Scalar::float64 : plan::Scalar::float32, engine);
    Watched<S> estimator(plan);
    Status status = Status::filling;
    for (int k = 0; k < moved * plan.samples(); ++k) estimator.step(estimator.sound(k));
    const int fill = plan.samples_to_first_estimate() + 50;
    for (int k = 0; k < fill; ++k) {
        const std::vector<double> now = inputs(k);
        status = estimator.step(std::vector<S>(now.begin(), now.end()));
    }
    return status;
}

constexpr const char* engines[] = {"fir", "moments"};

constexpr const char* all_models[] = {"dc_motor", "drive_train", "drive_train_zeros", "magnetic_bearing", "motor_pump", "pendulum",
                                      "pmsm_electrical", "pmsm_inertia", "pmsm_mechanical", "positioning_axis", "rl_circuit", "servo"};

}  // namespace

TEMPLATE_TEST_CASE("hostile samples: an ok estimate is a number, in double", "", ALGEST_COMMITTED) {
    for (const char* engine : engines) survives<double>(model<TestType>, plan_of(model<TestType>, plan::Scalar::float64, engine));
}

TEMPLATE_TEST_CASE("hostile samples: an ok estimate is a number, in float", "", ALGEST_COMMITTED) {
    for (const char* engine : engines) survives<float>(model<TestType>, plan_of(model<TestType>, plan::Scalar::float32, engine));
}

TEST_CASE("hostile samples: an ok estimate is a number, through a ratio filter") {
    const std::string text = plants::changed(plants::committed_model("rl_circuit"),
                                             {{"solve = \"square\"", "solve = \"robust\"\nsolve_window = 0.02\nratio_filter = { omega_n = 15, zeta = 0.707 }"}});
    survives<double>("rl_circuit with a ratio filter", plants::plan_of(text));
    survives<float>("rl_circuit with a ratio filter", plants::plan_of(text, plan::Scalar::float32));
}

TEST_CASE("hostile samples: the compiled classes answer them alike") {
    // The host estimator stands for the classes above: here they are held together on such samples.
    const auto compare = [](auto estimator, const char* name) {
        using Class = typename decltype(estimator)::element_type;
        const plan::Plan plan = plan_of(name, plan::Scalar::float64);
        lab::HostEstimator<double> host(plan);
        std::mt19937_64 random(22);
        for (const auto& value : regimes<double>()) {
            for (int k = 0; k < std::max(3 * plan.samples() / 2, 300); ++k) {
                Inputs<Class> in = exciting<Class>(k);
                if (k % 3 == 0 || k % 1000 < 300) {
                    for (double& v : in) v = value(random);
                }
                const Answer<Class> found(estimator->step(sample<Class>(in)));
                const Status status = host.step(in.data());
                const double condition = host.condition();
                REQUIRE(found.status == status);
                REQUIRE(std::memcmp(&found.condition, &condition, sizeof condition) == 0);
                REQUIRE(std::memcmp(found.values.data(), host.parameters().data(), sizeof found.values) == 0);
            }
        }
    };
    compare(std::make_unique<generated::DcMotor>(), "dc_motor");
    compare(std::make_unique<generated::DriveTrain>(), "drive_train");
    compare(std::make_unique<generated::DriveTrainZeros>(), "drive_train_zeros");
    compare(std::make_unique<generated::MagneticBearing>(), "magnetic_bearing");
    compare(std::make_unique<generated::Pendulum>(), "pendulum");
    compare(std::make_unique<generated::PmsmElectrical>(), "pmsm_electrical");
    compare(std::make_unique<generated::PmsmInertia>(), "pmsm_inertia");
    compare(std::make_unique<generated::PositioningAxis>(), "positioning_axis");
    compare(std::make_unique<generated::RlCircuit>(), "rl_circuit");
    compare(std::make_unique<generated::MotorPump>(), "motor_pump");
    compare(std::make_unique<generated::PmsmMechanical>(), "pmsm_mechanical");
    compare(std::make_unique<generated::Servo>(), "servo");
}

TEST_CASE("zero signals are singular") {
    for (const char* model : all_models) {
        INFO(model);
        const std::size_t inputs = plan_of(model, plan::Scalar::float64).inputs.size();
        CHECK(fed(model, [&](int) { return std::vector<double>(inputs, 0.0); }) == Status::singular);
    }
}

TEST_CASE("constant signals are singular") {
    for (const char* model : {"rl_circuit", "pmsm_electrical", "positioning_axis", "drive_train", "drive_train_zeros"}) {
        const plan::Plan plan = plan_of(model, plan::Scalar::float64);
        const std::size_t inputs = plan.inputs.size();
        for (const double value : {1.0, 0.3, 1e-5}) {
            for (const char* engine : engines) {
                if (plan.discrete && engine != engines[0]) continue;
                INFO(model << " at " << value << ", engine " << engine);
                CHECK(fed(model, [&](int) { return std::vector<double>(inputs, value); }, engine) == Status::singular);
            }
        }
    }
}

// Kernels that erase a constant leave its rounding, which is no more data than the constant itself.
TEMPLATE_TEST_CASE("constant signals are singular where kappa = 1 erases them: bearing", "", double, float) {
    for (const double Z : {0.0, 1e-5, 7e-5, 1.0 / 3.0 * 1e-4}) {
        for (const char* engine : engines) {
            INFO("Z = " << Z << ", engine " << engine);
            CHECK(fed<TestType>("magnetic_bearing", [&](int) { return std::vector<double>{Z, 1e-5, 1.7, 1.9, 1.1}; }, engine) == Status::singular);
        }
    }
}

TEMPLATE_TEST_CASE("constant signals are singular where only derivatives see them: DC motor", "", double, float) {
    for (const double angle : {0.3, -1e6, 1e-9}) {
        for (const char* engine : engines) {
            INFO("angle " << angle << ", engine " << engine);
            CHECK(fed<TestType>("dc_motor", [&](int) { return std::vector<double>{angle, 1.0}; }, engine) == Status::singular);
        }
    }
}

TEMPLATE_TEST_CASE("constant signals are singular where only derivatives see them: pendulum", "", double, float) {
    for (const double angle : {0.3, 1.7}) {  // held by hand
        for (const char* engine : engines) {
            INFO("angle " << angle << ", engine " << engine);
            CHECK(fed<TestType>("pendulum", [&](int) { return std::vector<double>{angle}; }, engine) == Status::singular);
        }
    }
}

TEST_CASE("constant signals are singular in a growing window") {
    const plan::Plan plan = plants::plan_of(plants::changed(plants::committed_model("dc_motor"), {{"[sampling]", "[sampling]\ngrowing = true"}, {"[estimator]", "[estimator]\nengine = \"moments\""}}));
    REQUIRE(plan.samples_to_first_estimate() < plan.samples());   // it estimates before the window is full
    for (const double angle : {0.3, -1e6, 1e-9}) {
        Watched<double> estimator(plan);
        for (int k = 0; k < plan.samples() + 50; ++k) REQUIRE(estimator.step({angle, 1.0}) != Status::ok);
        CHECK(estimator.count[static_cast<std::size_t>(Status::singular)] > plan.samples() / 2);
    }
}

TEST_CASE("a ramp is singular where only the second derivative sees it: DC motor") {
    // 2^-10 a sample: no sample of the ramp is rounded.
    for (const char* engine : engines) CHECK(fed("dc_motor", [](int k) { return std::vector<double>{0.5 + k / 1024.0, 1.0}; }, engine) == Status::singular);
}

// Sums of moments outlive the window: what they keep of the samples before is rounding.
TEMPLATE_TEST_CASE("constant signals are singular as soon as the window holds nothing else", "", double, float) {
    for (const char* engine : engines) {
        for (const int moved : {1, 2, 3}) {
            INFO("engine " << engine << ", moved for " << moved);
            CHECK(fed<TestType>("rl_circuit", [](int) { return std::vector<double>{0.3, 0.1}; }, engine, moved) == Status::singular);
            CHECK(fed<TestType>("dc_motor", [](int) { return std::vector<double>{0.3, 0.1}; }, engine, moved) == Status::singular);
        }
    }
}

// Least squares keeps its rows for good, absurd ones too: declared limits are what keeps them out.
TEST_CASE("least squares with declared limits recovers from a sample that is finite and absurd") {
    for (const char* model : {"pendulum", "positioning_axis"}) {
        plan::Plan plan = plan_of(model, plan::Scalar::float64);
        for (plan::Input& input : plan.inputs) input.max = 1.0;
        Watched<double> estimator(plan);
        CHECK(estimator.heals());
        std::vector<double> wild = estimator.sound(1);
        wild[0] = 1e200;
        CHECK(estimator.step(wild) == Status::rejected);
        CHECK(estimator.heals());
    }
}
