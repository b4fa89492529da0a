// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 6 of issue 6: the classes that average steady states and eliminate keep the contract of every generated class, and agree with replay to
// the last bit, on operating points and on whatever a broken sensor delivers.
#include <catch2/catch.hpp>

#include <limits>
#include <memory>
#include <random>

#include "examples/sensorless_motor/equilibrium.hpp"
#include "generator/generate.hpp"
#include "lab/host_estimator.hpp"
#include "tests/generated/committed.hpp"
#include "tests/generated/compiled_estimator.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/estimates.hpp"

using namespace algest;
using namespace algest::test;

namespace {

constexpr int block = 200;

/// A sample of the motor at one of its operating points, each held for three blocks, with noise.
template <class Class>
Inputs<Class> motor(int k) {
    static const std::vector<sensorless_motor::OperatingPoint> points = sensorless_motor::operating_points({}, 0.2);
    const sensorless_motor::OperatingPoint& p = points[static_cast<std::size_t>(k / (3 * block) * 7) % points.size()];
    const double angle = 1e-3 * p.omega * k;
    const double c = std::cos(50 * angle), s = std::sin(50 * angle);
    const double rough = 0.03 * (static_cast<double>((k * 7919) % 1009) / 504.5 - 1);
    return {p.v_f * c - p.v_g * s, p.v_f * s + p.v_g * c, p.i_f * c - p.i_g * s + rough, p.i_f * s + p.i_g * c - rough / 2, angle, p.omega};
}

template <class Class>
plan::Plan plan_of() {
    return plants::plan_of(plants::committed_model(model<Class>));
}

template <class Class>
Answer<Class> step(Class& estimator, const Inputs<Class>& in) {
    return Answer<Class>(estimator.step(sample<Class>(in)));
}

}  // namespace

TEMPLATE_TEST_CASE("operating points: what the class is", "", ALGEST_COMMITTED_AVERAGES) {
    STATIC_REQUIRE(std::is_trivially_copyable_v<TestType>);
    STATIC_REQUIRE(std::is_standard_layout_v<TestType>);
    STATIC_REQUIRE(std::is_nothrow_default_constructible_v<TestType>);
    STATIC_REQUIRE(alignof(TestType) <= alignof(double));
    STATIC_REQUIRE(noexcept(std::declval<TestType&>().reset()));
    STATIC_REQUIRE(noexcept(std::declval<TestType&>().step(std::declval<const typename TestType::Sample&>())));
    CHECK(plan_of<TestType>().samples_to_first_estimate() == block);
}

TEMPLATE_TEST_CASE("operating points: the class and replay agree to the last bit; a refused sample ends its block alone", "", ALGEST_COMMITTED_AVERAGES) {
    const plan::Plan plan = plan_of<TestType>();
    lab::HostEstimator<double> host(plan);
    const auto estimator = std::make_unique<TestType>();
    const auto copy = std::make_unique<TestType>();
    int ok = 0, certain = 0;
    for (int k = 0; k < 60 * block; ++k) {
        Inputs<TestType> in = motor<TestType>(k);
        if (k % 1000 == 517) in[2] = std::numeric_limits<double>::quiet_NaN();
        if (k == 3333) std::memcpy(static_cast<void*>(copy.get()), estimator.get(), sizeof(TestType));
        const Answer<TestType> found = step(*estimator, in);
        const Status status = host.step(in.data());
        const double condition = host.condition();
        REQUIRE(found.status == status);
        REQUIRE(std::memcmp(&found.condition, &condition, sizeof condition) == 0);
        REQUIRE(std::memcmp(found.values.data(), host.parameters().data(), sizeof found.values) == 0);
        if (k >= 3333) REQUIRE(step(*copy, in).same_bits(found));
        if (k % 331 == 330) {
            const auto u = estimator->uncertainty();
            REQUIRE(u.status == host.uncertainty());
            certain += u.status == Status::ok ? 1 : 0;
            REQUIRE((u.status != Status::ok || std::memcmp(&u.sd, host.deviation().data(), sizeof u.sd) == 0));
            REQUIRE((u.status != Status::ok || std::memcmp(&u.bias, host.bias().data(), sizeof u.bias) == 0));
        }
        if (k % 1000 == 517) REQUIRE(status == Status::rejected);
        if (k % 1000 == 518 && k > 1000) REQUIRE(status == Status::filling);
        ok += status == Status::ok ? 1 : 0;
    }
    CHECK(ok > 15 * block);
    CHECK(certain > 5);
    CHECK(host.points() >= 14);   // of each stretch of three blocks one whole block at least is left, if a refused sample falls into it
}

TEMPLATE_TEST_CASE("operating points: an ok estimate is a number, whatever is fed", "", ALGEST_COMMITTED_AVERAGES) {
    const auto estimator = std::make_unique<TestType>();
    const plan::Plan plan = plan_of<TestType>();
    lab::HostEstimator<double> host(plan);
    std::mt19937_64 random(23);
    const double wild[] = {0, 1, -1, 3, 1e-300, 1e154, -1e154, std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()};
    for (int round = 0; round < 30; ++round) {
        Inputs<TestType> in;
        for (int k = 0; k < 2 * block; ++k) {
            if (k % block == 0) for (double& v : in) v = wild[random() % std::size(wild)];
            const Answer<TestType> found = step(*estimator, in);
            REQUIRE(host.step(in.data()) == found.status);
            for (const double v : found.values) REQUIRE(std::isfinite(v));
            if (found.status == Status::ok) REQUIRE(std::isfinite(found.condition));
        }
    }
}

TEST_CASE("operating points: two compilers, both scalars, the bits of replay") {
    const std::string text = plants::changed(plants::committed_model("pmsm_sensorless_voltage"), {{"stages =", "stretches = \"omega_r\"\nforgetting = 0.99\nstages ="}});
    for (const std::string compiler : {"g++ -O0", "clang++ -O3"}) {
        INFO(compiler);
        const plan::Plan wide = plants::plan_of(text);
        CompiledEstimator<double> compiled(wide, compiler);
        lab::HostEstimator<double> host(wide);
        const plan::Plan narrow = plants::plan_of(text, plan::Scalar::float32);
        CompiledEstimator<float> compiled_narrow(narrow, compiler);
        lab::HostEstimator<float> host_narrow(narrow);
        for (int k = 0; k < 60 * block; ++k) {
            const Inputs<generated::PmsmSensorlessVoltage> in = motor<generated::PmsmSensorlessVoltage>(k);
            const std::vector<double> found = compiled.step(in.data());
            const Status status = host.step(in.data());
            REQUIRE(found[0] == static_cast<double>(static_cast<int>(status)));
            REQUIRE(std::memcmp(found.data() + 2, host.parameters().data(), host.parameters().size() * sizeof(double)) == 0);
            if (k % 331 == 330 && host.uncertainty() == Status::ok) {
                const std::vector<double> of_class = compiled.uncertainty();
                REQUIRE(of_class[0] == static_cast<double>(static_cast<int>(Status::ok)));
                REQUIRE(std::memcmp(of_class.data() + 1, host.deviation().data(), host.deviation().size() * sizeof(double)) == 0);
                REQUIRE(std::memcmp(of_class.data() + 1 + host.deviation().size(), host.bias().data(), host.bias().size() * sizeof(double)) == 0);
            }
            std::array<float, 6> single;
            for (std::size_t i = 0; i < single.size(); ++i) single[i] = static_cast<float>(in[i]);
            const std::vector<float> found_narrow = compiled_narrow.step(single.data());
            (void)host_narrow.step(single.data());
            REQUIRE(std::memcmp(found_narrow.data() + 2, host_narrow.parameters().data(), host_narrow.parameters().size() * sizeof(float)) == 0);
        }
        CHECK(host.status() == Status::ok);
    }
}
