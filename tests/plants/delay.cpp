// SPDX-License-Identifier: GPL-3.0-or-later
// An estimator of a model with delay(): the same, to the last bit, as that of the plain model fed with what the delay makes of the samples.
#include <cstring>

#include "algest/delay_line.hpp"
#include "tests/plants/changed_model.hpp"
#include "tests/plants/coverage.hpp"

using namespace algest;
using namespace algest::plants;

namespace {

const char* const axis = R"toml(format = 1
name = "axis"
[sampling]
period = 1e-3
window = 0.05
[signals]
q = { unit = "m" }
F = { unit = "N", hold = "zoh" }
[parameters]
M = { unit = "kg", initial = 2 }
Fv = { unit = "N.s/m", initial = 3 }
Fc = { unit = "N", initial = 1 }
[[equation]]
ode = "M*der(q,2) = F - Fv*der(q) - Fc*OF_SPEED"
)toml";

/// An axis that nothing obeys: what is compared is arithmetic.
std::vector<double> axis_sample(int k) {
    const double t = 1e-3 * k;
    return {0.1 * std::sin(31 * t) + 0.02 * std::sin(97 * t), 5 * std::cos(23 * t) + std::sin(211 * t)};
}

void same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// `late`: in the delayed model; `lines`: samples that its lines need before; `fed`: what the plain model is fed with in place of F.
void agree(const std::string& speed, const std::string& late, int lines, const std::function<double(const std::function<double(int)>&)>& fed) {
    INFO(late);
    const std::string text = changed(axis, {{"OF_SPEED", speed}});
    const plan::Plan plain = plan_of(text);
    const plan::Plan delayed = plan_of(changed(text, {{"= F -", "= " + late + " -"}}));
    CHECK(delayed.samples_to_first_estimate() == plain.samples_to_first_estimate() + lines);
    lab::HostEstimator<double> one(plain), other(delayed);
    const auto run = [&](int from, int to) {
        int ok = 0;
        for (int k = from; k < to; ++k) {
            const auto sample = axis_sample(k);
            other.step(sample.data());
            if (k - from < lines) {
                CHECK(other.status() == Status::filling);
                continue;
            }
            const double input[2] = {sample[0], fed([&](int ago) { return axis_sample(k - ago)[1]; })};
            one.step(input);
            REQUIRE(one.status() == other.status());
            same_bits(one.parameters(), other.parameters());
            ok += one.status() == Status::ok ? 1 : 0;
        }
        CHECK(ok > 100);
    };
    run(0, 300);
    const double refused[2] = {std::numeric_limits<double>::infinity(), 0};   // it empties the lines with the windows
    one.step(refused);
    other.step(refused);
    CHECK(other.status() == Status::rejected);
    run(300, 600);
}

}  // namespace

TEST_CASE("delay line: the sample of so many pushes ago, for every length and age") {
    for (const int length : {1, 2, 5}) {
        std::vector<double> lines(static_cast<std::size_t>(2 * length), -1.0);
        DelayProgress progress{};
        for (int k = 0; k < 23; ++k) {
            for (int ago = 1; ago <= length && ago <= k; ++ago) {
                CHECK(past_sample(lines.data(), length, progress, ago) == k - ago);
                CHECK(past_sample(lines.data() + length, length, progress, ago) == 100 + k - ago);
            }
            const double newest[2] = {static_cast<double>(k), 100.0 + k};
            keep_samples(lines.data(), 2, length, progress, newest);
            CHECK(progress.filled == std::min(k + 1, length));
        }
    }
}

TEST_CASE("an estimator of a delayed input is the plain one of the delayed samples") {
    const auto at = [](int ago) { return [ago](const auto& F) { return F(ago); }; };
    agree("sgn(q)", "delay(F, 0.002)", 2, at(2));
    agree("sgn(q)", "delay(F, 1e-3)", 1, at(1));
    agree("sgn(q)", "delay(F, 0.0023)", 3, [](const auto& F) { return 0.7 * F(2) + 0.3 * F(3); });   // straight between the samples
    agree("sgn(q)", "delay(F, 2.5e-4)", 1, [](const auto& F) { return 0.75 * F(0) + 0.25 * F(1); });
    agree("sgn(q)", "delay(F, 0)", 0, at(0));
    agree("sgn(q)", "min(delay(F, 0.004), delay(F, 0.001))", 4, [](const auto& F) { return std::min(F(4), F(1)); });
}

TEST_CASE("an estimator of a delayed input beside a filtered speed, one sample late as a whole") {
    // All signals of that equation are one sample late: the delayed one needs one sample more.
    agree("sgn(der(q))", "delay(F, 0.002)", 3, [](const auto& F) { return F(2); });
}
