// SPDX-License-Identifier: GPL-3.0-or-later
// What the header of every generated class promises: what it is, when it first answers, that it holds values, that instances
// and copies are independent.
#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>

#include "generator/generate.hpp"
#include "lab/host_estimator.hpp"
#include "tests/generated/committed.hpp"

using namespace algest;
using namespace algest::test;

namespace {

/// Larger than a thread's stack on some targets, so never on it here.
template <class Class>
std::unique_ptr<Class> make() {
    return std::make_unique<Class>();
}

template <class Class>
Answer<Class> step(Class& estimator, const Inputs<Class>& values) {
    return Answer<Class>(estimator.step(sample<Class>(values)));
}

/// The number in "First `ok` at sample 401 (...) after a start or a refused sample" of the header.
template <class Class>
int stated_first_ok() {
    const std::string name = model<Class>;
    std::ifstream file(std::string(ALGEST_SOURCE "/generated/") + name + "/" + name + ".hpp");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string before = "First `ok` at sample ";
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    REQUIRE(text.find("after a start or a refused sample", at) < text.find('\n', at));
    return std::stoi(text.substr(at + before.size()));
}

/// False where one instant has fewer rows than unknowns: these follow later, those of the axis when it has turned round.
template <class Class>
constexpr bool answers_at_once = !std::is_same_v<Class, generated::PositioningAxis> && !std::is_same_v<Class, generated::MotorPump> &&
                                 !std::is_same_v<Class, generated::PmsmMechanical> && !std::is_same_v<Class, generated::Servo>;

}  // namespace

TEMPLATE_TEST_CASE("generated class: what it is", "", ALGEST_COMMITTED) {
    STATIC_REQUIRE(std::is_trivially_copyable_v<TestType>);
    STATIC_REQUIRE(std::is_trivially_destructible_v<TestType>);
    STATIC_REQUIRE(std::is_standard_layout_v<TestType>);
    STATIC_REQUIRE_FALSE(std::is_polymorphic_v<TestType>);
    STATIC_REQUIRE(std::is_nothrow_default_constructible_v<TestType>);
    STATIC_REQUIRE(alignof(TestType) <= alignof(double));  // nothing over-aligned: the same ABI under any flags
    STATIC_REQUIRE(noexcept(std::declval<TestType&>().reset()));
    STATIC_REQUIRE(noexcept(std::declval<TestType&>().push(std::declval<const typename TestType::Sample&>())));
    STATIC_REQUIRE(noexcept(std::declval<TestType&>().estimate()));
    STATIC_REQUIRE(noexcept(std::declval<TestType&>().step(std::declval<const typename TestType::Sample&>())));
    STATIC_REQUIRE(std::is_trivially_copyable_v<typename TestType::Sample>);
    STATIC_REQUIRE(std::is_trivially_copyable_v<typename TestType::Estimate>);
}

TEMPLATE_TEST_CASE("generated class: filling to the sample that its header states", "", ALGEST_COMMITTED) {
    const int first = stated_first_ok<TestType>();
    const auto estimator = make<TestType>();
    for (int round = 0; round < 2; ++round) {  // after a start, and after a refused sample
        for (int k = 1; k < first; ++k) {
            const auto a = step(*estimator, exciting<TestType>(k));
            INFO("sample " << k << " of " << first);
            REQUIRE(a.status == Status::filling);
            REQUIRE(a.condition == std::numeric_limits<typename TestType::Scalar>::infinity());
        }
        for (int k = first; k < first + 600; ++k) {
            const Status status = step(*estimator, exciting<TestType>(k)).status;
            if (answers_at_once<TestType> || round == 1 || k > first + 500) {
                REQUIRE(status == Status::ok);
            } else {
                REQUIRE((status == Status::ok || status == Status::singular));
            }
        }
        auto bad = exciting<TestType>(0);
        bad.back() = std::numeric_limits<typename TestType::Scalar>::quiet_NaN();
        REQUIRE(step(*estimator, bad).status == Status::rejected);
    }
}

TEMPLATE_TEST_CASE("generated class: samples to the first estimate as replay counts them", "", ALGEST_COMMITTED) {
    Diagnostics diagnostics;
    const auto plan =
        generator::plan_from_model(std::string(ALGEST_SOURCE "/models/") + model<TestType> + ".toml", {}, diagnostics);
    REQUIRE(plan);
    CHECK(plan->samples_to_first_estimate() == stated_first_ok<TestType>());
}

TEMPLATE_TEST_CASE("generated class: values are held from the initial ones on", "", ALGEST_COMMITTED) {
    Diagnostics diagnostics;
    const auto plan =
        generator::plan_from_model(std::string(ALGEST_SOURCE "/models/") + model<TestType> + ".toml", {}, diagnostics);
    REQUIRE(plan);
    REQUIRE(plan->parameters.size() == parameters<TestType>);
    const auto estimator = make<TestType>();
    std::array<typename TestType::Scalar, parameters<TestType>> held;
    for (std::size_t p = 0; p < held.size(); ++p) held[p] = plan->parameters[p].initial;
    const int samples = plan->samples_to_first_estimate() + 630;
    int ok = 0, changed = 0;
    for (int round = 0; round < 3; ++round) {
        for (int k = 0; k < samples; ++k) {
            const auto a = step(*estimator, exciting<TestType>(k, round));
            if (a.status == Status::ok) {
                ++ok;
                changed += a.values != held ? 1 : 0;
                held = a.values;
            }
            REQUIRE(a.values == held);
        }
        auto bad = exciting<TestType>(samples);
        bad[0] = std::numeric_limits<typename TestType::Scalar>::infinity();
        const auto a = step(*estimator, bad);
        REQUIRE(a.status == Status::rejected);
        REQUIRE(a.values == held);
        REQUIRE(a.condition == std::numeric_limits<typename TestType::Scalar>::infinity());
    }
    CHECK(ok > 60);
    CHECK(changed > 60);
}

TEMPLATE_TEST_CASE("generated class: two instances know nothing of each other", "", ALGEST_COMMITTED) {
    const int samples = stated_first_ok<TestType>() + 640;
    const auto a_alone = make<TestType>(), b_alone = make<TestType>(), a = make<TestType>(), b = make<TestType>();
    int ok = 0;
    for (int k = 0; k < samples; ++k) {
        const auto expected_a = step(*a_alone, exciting<TestType>(k, 1));
        const auto expected_b = step(*b_alone, exciting<TestType>(k, 2));
        a->push(sample<TestType>(exciting<TestType>(k, 1)));
        b->push(sample<TestType>(exciting<TestType>(k, 2)));
        REQUIRE(Answer<TestType>(b->estimate()).same_bits(expected_b));
        REQUIRE(Answer<TestType>(a->estimate()).same_bits(expected_a));
        if (expected_a.status == Status::ok && expected_b.status == Status::ok) {
            ++ok;
            REQUIRE_FALSE(expected_a.same_bits(expected_b));
        }
    }
    CHECK(ok > 20);
}

TEMPLATE_TEST_CASE("generated class: a copy of an instance, even of its bytes, goes on alike", "", ALGEST_COMMITTED) {
    const int samples = stated_first_ok<TestType>() + 640;
    for (const int at : {0, 1, 2, samples / 3, samples - 645, samples - 20}) {
        const auto original = make<TestType>();
        for (int k = 0; k < at; ++k) step(*original, exciting<TestType>(k));
        const auto copy = std::make_unique<TestType>(*original);
        const auto bytes = make<TestType>();
        step(*bytes, exciting<TestType>(3, 3));
        std::memcpy(static_cast<void*>(bytes.get()), original.get(), sizeof(TestType));
        const auto other = make<TestType>();
        *other = *original;
        for (int k = 0; k < samples; ++k) step(*copy, exciting<TestType>(k, 9));  // must not matter to the others
        int ok = 0;
        for (int k = at; k < samples; ++k) {
            const auto wanted = step(*original, exciting<TestType>(k));
            REQUIRE(step(*bytes, exciting<TestType>(k)).same_bits(wanted));
            REQUIRE(step(*other, exciting<TestType>(k)).same_bits(wanted));
            ok += wanted.status == Status::ok ? 1 : 0;
        }
        CHECK(ok > 10);
    }
}

TEMPLATE_TEST_CASE("generated class: after reset it is as new", "", ALGEST_COMMITTED) {
    const int samples = stated_first_ok<TestType>() + 25;
    const auto used = make<TestType>(), fresh = make<TestType>();
    for (int k = 0; k < samples + 17; ++k) step(*used, exciting<TestType>(k, 5));
    used->reset();
    REQUIRE(Answer<TestType>(used->estimate()).same_bits(Answer<TestType>(fresh->estimate())));
    for (int k = 0; k < samples; ++k) {
        REQUIRE(step(*used, exciting<TestType>(k)).same_bits(step(*fresh, exciting<TestType>(k))));
    }
}

TEMPLATE_TEST_CASE("generated class: step is push and estimate, and estimate alone changes nothing", "", ALGEST_COMMITTED) {
    const int samples = stated_first_ok<TestType>() + 25;
    const auto stepped = make<TestType>(), pushed = make<TestType>();
    for (int k = 0; k < samples; ++k) {
        const auto wanted = step(*stepped, exciting<TestType>(k));
        pushed->push(sample<TestType>(exciting<TestType>(k)));
        if (k % 7 != 0 && k < samples - 3) continue;  // not every push has its estimate
        REQUIRE(Answer<TestType>(pushed->estimate()).same_bits(wanted));
        REQUIRE(Answer<TestType>(pushed->estimate()).same_bits(wanted));
    }
}
