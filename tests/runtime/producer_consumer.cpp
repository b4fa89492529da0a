// SPDX-License-Identifier: GPL-3.0-or-later
// One producer that pushes, one consumer that estimates: whatever falls between, an estimate is that of one instant, whole, or
// there is none.
#include <catch2/catch.hpp>

#include <atomic>
#include <cstring>
#include <map>
#include <thread>
#include <utility>

#include "tests/runtime/interruptible.hpp"
#include "tests/runtime/small_estimator.hpp"

using namespace algest;
using algest::test::Interruptible;

namespace {

constexpr int samples = 19;  // two groups of eight and three more
constexpr int instants = 7;

template <class S>
void push(test::SmallEstimator<S>& estimator, unsigned k) {
    const auto sample = test::small_sample(k);
    const std::array<S, test::small_signals> scalars{S(sample[0]), S(sample[1]), S(sample[2])};
    estimator.push(scalars.data());
}

struct Answer {
    Latest<double> latest;
    std::array<double, 2> lumped;
    bool same(const Answer& o) const {
        return latest.status == o.latest.status &&
               std::memcmp(&latest.condition, &o.latest.condition, sizeof(double)) == 0 &&
               std::memcmp(lumped.data(), o.lumped.data(), sizeof lumped) == 0;
    }
};

template <class S>
Answer estimate(test::SmallEstimator<S>& estimator) {
    std::array<S, 2> lumped{S(0), S(0)};
    const Latest<S> latest = estimator.estimate(lumped);
    return {{latest.current, latest.status, static_cast<double>(latest.condition)},
            {static_cast<double>(lumped[0]), static_cast<double>(lumped[1])}};
}

/// Pushes that one estimate() bears.
int borne(Solve solve) { return solve == Solve::square ? spare_samples : published_slots - 1; }

}  // namespace

TEST_CASE("an estimate into which pushes fall is that of its beginning, or none if they are too many") {
    for (const Solve solve : {Solve::square, Solve::robust, Solve::least_squares}) {
        const test::SmallData<Interruptible> data(solve, samples, instants);
        for (const unsigned pushed : {samples + instants - 1U, samples + instants + 0U, 2U * samples + 5U, 60U}) {
            test::SmallEstimator<Interruptible> filled(data);
            for (unsigned k = 0; k < pushed; ++k) push(filled, k);
            Interruptible::arm(-1, {});
            const Answer undisturbed = estimate(filled);
            const long operations = Interruptible::operations();
            REQUIRE(undisturbed.latest.current);
            REQUIRE(undisturbed.latest.status == Status::ok);

            int spoilt = 0;
            for (long at = 0; at < operations; ++at) {
                for (int pushes = 0; pushes <= 2 * samples; ++pushes) {
                    test::SmallEstimator<Interruptible> estimator = filled;
                    Interruptible::arm(at, [&] {
                        for (int k = 0; k < pushes; ++k) push(estimator, pushed + static_cast<unsigned>(k));
                    });
                    const Answer found = estimate(estimator);
                    Interruptible::disarm();
                    INFO("solve " << static_cast<int>(solve) << ", " << pushes << " pushes at operation " << at);
                    if (pushes <= borne(solve)) REQUIRE(found.latest.current);
                    if (found.latest.current) {
                        REQUIRE(found.same(undisturbed));
                    } else {
                        ++spoilt;
                        REQUIRE(found.lumped == std::array<double, 2>{0.0, 0.0});  // untouched
                    }

                    // Afterwards the estimator stands where the pushes left it.
                    test::SmallEstimator<Interruptible> straight = filled;
                    for (int k = 0; k < pushes; ++k) push(straight, pushed + static_cast<unsigned>(k));
                    if (at % 16 == 0) REQUIRE(estimate(estimator).same(estimate(straight)));
                }
            }
            CHECK(spoilt > 0);
        }
    }
}

TEST_CASE("an uncertainty() into which pushes fall is that of its beginning, or none if they are more than eight") {
    struct Of {
        Latest<Interruptible> latest;
        std::array<double, 5> numbers;
    };
    const auto of = [](test::SmallEstimator<Interruptible>& estimator) {
        std::array<Interruptible, 3> covariance{};
        std::array<Interruptible, 2> bias{};
        const auto latest = estimator.uncertainty(covariance, bias);
        return Of{latest, {covariance[0], covariance[1], covariance[2], bias[0], bias[1]}};
    };
    for (const Solve solve : {Solve::square, Solve::robust}) {
        const test::SmallData<Interruptible> data(solve, samples, solve == Solve::robust ? instants : 0, 1.0, 1.0, true);
        test::SmallEstimator<Interruptible> filled(data);
        for (unsigned k = 0; k < 60; ++k) push(filled, k);
        Interruptible::arm(-1, {});
        const Of undisturbed = of(filled);
        const long operations = Interruptible::operations();
        REQUIRE(undisturbed.latest.current);
        REQUIRE(undisturbed.latest.status == Status::ok);
        REQUIRE(undisturbed.numbers[0] > 0.0);
        int spoilt = 0;
        for (long at = 0; at < operations; at += operations / 150) {
            for (const int pushes : {1, published_slots, spare_samples, spare_samples + 1, 3 * samples}) {
                test::SmallEstimator<Interruptible> estimator = filled;
                Interruptible::arm(at, [&] {
                    for (int k = 0; k < pushes; ++k) push(estimator, 60U + static_cast<unsigned>(k));
                });
                const Of found = of(estimator);
                Interruptible::disarm();
                INFO("solve " << static_cast<int>(solve) << ", " << pushes << " pushes at operation " << at);
                if (pushes < published_slots) REQUIRE(found.latest.current);
                if (!found.latest.current) {
                    ++spoilt;
                } else if (at > 8) {
                    REQUIRE(found.numbers == undisturbed.numbers);
                } else {   // pushes that fall before it looks at the producer belong to its beginning
                    test::SmallEstimator<Interruptible> straight = filled;
                    for (int k = 0; k < pushes; ++k) push(straight, 60U + static_cast<unsigned>(k));
                    REQUIRE((found.numbers == undisturbed.numbers || found.numbers == of(straight).numbers));
                }
            }
        }
        CHECK(spoilt > 0);
    }
}

TEST_CASE("a refused sample that falls into an estimate leaves it as it was") {
    for (const Solve solve : {Solve::square, Solve::robust, Solve::least_squares}) {
        const test::SmallData<Interruptible> data(solve, samples, instants);
        test::SmallEstimator<Interruptible> filled(data);
        for (unsigned k = 0; k < 40; ++k) push(filled, k);
        Interruptible::arm(-1, {});
        const Answer undisturbed = estimate(filled);
        const long operations = Interruptible::operations();
        for (long at = 0; at < operations; ++at) {
            test::SmallEstimator<Interruptible> estimator = filled;
            Interruptible::arm(at, [&] {
                estimator.push(nullptr);
                estimator.prime();
                push(estimator, 40);
            });
            const Answer found = estimate(estimator);
            Interruptible::disarm();
            REQUIRE(found.latest.current);
            REQUIRE(found.same(undisturbed));
            REQUIRE(estimate(estimator).latest.status == Status::filling);
        }
    }
}

TEST_CASE("an estimate in the middle of a push says so") {
    for (const Solve solve : {Solve::square, Solve::robust, Solve::least_squares}) {
        const test::SmallData<Interruptible> data(solve, samples, instants);
        test::SmallEstimator<Interruptible> filled(data);
        for (unsigned k = 0; k < 40; ++k) push(filled, k);
        test::SmallEstimator<Interruptible> next = filled;
        Interruptible::arm(-1, {});
        const auto sample = test::small_sample(40);
        const std::array<Interruptible, 3> scalars{sample[0], sample[1], sample[2]};
        next.push(scalars.data());
        const long operations = Interruptible::operations();
        const Answer after = estimate(next);
        REQUIRE(operations >= 6);  // each signal is written twice
        for (long at = 0; at < operations; ++at) {
            test::SmallEstimator<Interruptible> estimator = filled;
            Answer within{};
            Interruptible::arm(at, [&] { within = estimate(estimator); });
            estimator.push(scalars.data());
            Interruptible::disarm();
            REQUIRE_FALSE(within.latest.current);
            REQUIRE(estimate(estimator).same(after));
        }
    }
}

TEST_CASE("two threads: every estimate is one that a single thread has seen, and later ones are not older") {
    constexpr unsigned pushes = 20'000;
    for (const Solve solve : {Solve::square, Solve::robust, Solve::least_squares}) {
        const test::SmallData<double> data(solve, samples, instants, 0.9);
        // the bits of an estimate -> the pushes after which it appeared
        std::map<std::pair<double, double>, unsigned> seen;
        test::SmallEstimator<double> alone(data);
        for (unsigned k = 0; k < pushes; ++k) {
            push(alone, k);
            const Answer a = estimate(alone);
            REQUIRE(a.latest.current);
            if (a.latest.status == Status::ok) seen[{a.lumped[0], a.lumped[1]}] = k + 1;
        }
        REQUIRE(seen.size() > pushes / 2);

        test::SmallEstimator<double> shared(data);
        std::atomic<unsigned> begun{0}, done{0};
        std::atomic<bool> ready{false};
        std::atomic<unsigned> answered{0};
        std::thread producer([&] {
            while (!ready) std::this_thread::yield();
            for (unsigned k = 0; k < pushes; ++k) {
                while (k == pushes / 2 && answered == 0) std::this_thread::yield();   // a busy machine may not have run the consumer yet
                begun.store(k + 1);
                push(shared, k);
                done.store(k + 1);
                if (k % 64 == 0) std::this_thread::yield();
            }
        });
        unsigned estimates = 0, overtaken = 0, unknown = 0, out_of_time = 0, backwards = 0, newest = 0;
        ready = true;
        while (done < pushes) {
            const unsigned before = done;
            const Answer a = estimate(shared);
            const unsigned after = begun;
            if (!a.latest.current) {
                ++overtaken;
                ++answered;
                continue;
            }
            if (a.latest.status != Status::ok) continue;
            ++estimates;
            ++answered;
            const auto found = seen.find({a.lumped[0], a.lumped[1]});
            if (found == seen.end()) {
                ++unknown;
                continue;
            }
            out_of_time += found->second < before || found->second > after ? 1U : 0U;
            backwards += found->second < newest ? 1U : 0U;
            newest = found->second;
        }
        producer.join();
        INFO("solve " << static_cast<int>(solve) << ": " << estimates << " estimates, " << overtaken << " overtaken");
        CHECK(estimates + overtaken > 0);
        CHECK(unknown == 0);
        CHECK(out_of_time == 0);
        CHECK(backwards == 0);
        CHECK(estimate(shared).same(estimate(alone)));
    }
}
