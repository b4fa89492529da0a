// SPDX-License-Identifier: GPL-3.0-or-later
// The multiply-adds that emitted headers state, against those that the runtime does, counted one by one.
#include "tests/runtime/counted.hpp"   // before the runtime

#include <random>

#include "generator/blueprint.hpp"
#include "generator/cost.hpp"
#include "tests/plants/estimates.hpp"

namespace algest {
namespace {

using test::Counted;

/// A coil beside another: noise comes in through constants and through a partial derivative, w. The solver is a test's choice.
const std::string coils = R"toml(format = 1
name = "coils"
[sampling]
period = 1e-3
window = 0.3
[signals]
v = { unit = "V", hold = "zoh" }
i = { unit = "A", noise = 1e-3 }
j = { unit = "A", noise = 2e-3 }
w = { unit = "rad/s" }
[constants]
turns = { value = 0.1, unit = "V.s/(rad.A)" }
[parameters]
R = { unit = "ohm", initial = 2 }
L = { unit = "H", initial = 0.02 }
[[equation]]
ode = "L*der(i) = v - R*i - turns*w*j"
rows = ROWS
[estimator]
)toml";

struct Counts {
    long rows;          ///< of one evaluation
    long estimate;
    long uncertainty;
};

/// Of one instance that noise alone has filled: nothing of the count depends on what the samples are.
Counts counts(const plan::Plan& plan) {
    const auto data = plan::make_blueprint<Counted>(plan);
    const Blueprint<Counted> blueprint = data.view();
    const RowSet<Counted>& rows = blueprint.rows;
    const auto sized = [](int n) { return std::vector<Counted>(static_cast<std::size_t>(n), Counted(0)); };
    const int instants = plan.solve_instants;
    const int length = ring_length(rows.samples, blueprint.kept);
    auto rings = sized(ring_scalars(rows.signals, length));
    auto sums = sized(sum_scalars(blueprint.solve, rows.unknowns, instants));
    auto published = sized(published_scalars(blueprint.solve, rows.unknowns));
    auto whitened_at = data.whiten_at;
    auto scratch = sized(uncertainty_scratch(rows.rows, rows.unknowns, instants));
    auto lumped = sized(rows.unknowns);
    auto covariance = sized(packed_size(rows.unknowns));
    auto bias = sized(rows.unknowns);
    Progress progress{};
    const Memory<Counted> memory = {rings.data(), sums.data(), published.data(), &progress, whitened_at.data()};
    reset(blueprint, memory);
    std::mt19937 random(1);
    std::vector<Counted> sample(static_cast<std::size_t>(rows.signals));
    for (int k = 0; k < rows.samples + instants + 2; ++k) {
        for (Counted& x : sample) x = Counted(static_cast<double>(random() % 1000U) - 500.0);
        push(blueprint, memory, sample.data(), scratch.data());
    }
    const auto counted = [](auto&& work) {
        const long before = Counted::operations;
        work();
        return Counted::operations - before;
    };
    Counts out{};
    out.rows = counted([&] { evaluate_rows(rows, rings.data(), WindowPosition{length, 0}, scratch.data(), scratch.data() + row_entries(rows.rows, rows.unknowns)); });
    out.estimate = counted([&] { REQUIRE(estimate(blueprint, memory, scratch.data(), lumped.data()).status == Status::ok); });
    out.uncertainty = counted([&] { REQUIRE(uncertainty(blueprint, memory, scratch.data(), lumped.data(), covariance.data(), bias.data()).status == Status::ok); });
    return out;
}

/// A count is at most 5 percent from what is stated: the products of factors and of the solve, which "besides one solve" leaves out, are tens or a few
/// hundred of thousands; a scalar that is counted stands for a unit without neighbours, whose sizes take at most 31 products less a functional.
void check(long counted, long stated) {
    CHECK(static_cast<double>(counted) == Approx(static_cast<double>(stated)).epsilon(0.05));
}

plan::Plan coils_by(const std::string& rows, const std::string& estimator) {
    std::string model = coils;
    model.replace(model.find("ROWS"), 4, rows);
    return plants::plan_of(model + estimator);
}

}  // namespace

TEST_CASE("stated multiply-adds are those that are done") {
    for (const std::string rows : {"2", "3"}) {
        for (const bool whitened : {false, true}) {
            INFO("square, rows " << rows << ", whitened " << whitened);
            const plan::Plan plan = coils_by(rows, std::string("solve = \"square\"\ndeviation_limit = 0\ncondition_limit = 1e9\nwhiten = ") + (whitened ? "true\n" : "false\n"));
            const generator::Cost cost = generator::cost_of(plan);
            const Counts c = counts(plan);
            check(c.rows, cost.rows);
            check(c.estimate, cost.estimate + cost.whitening);   // which as many rows as unknowns do without
            check(c.uncertainty, cost.uncertainty + c.estimate);   // which it does first
        }
    }
    const plan::Plan robust = coils_by("2", "solve = \"robust\"\nsolve_window = 0.2\ncondition_limit = 1e9\n");
    const generator::Cost cost = generator::cost_of(robust);
    const Counts c = counts(robust);
    check(c.rows, cost.rows);
    check(c.uncertainty, cost.uncertainty);
}

}  // namespace algest
