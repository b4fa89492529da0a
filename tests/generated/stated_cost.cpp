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
window = 1
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

/// A motor at several speeds, two equations that share a parameter.
const std::string levels = R"toml(format = 1
name = "levels"
[sampling]
period = 1e-3
window = 0.1
[signals]
u = { unit = "V", noise = 0.1 }
i = { unit = "A", steady = 0.02, noise = 0.02 }
w = { unit = "rad/s", steady = 0.2 }
[parameters]
R = { unit = "ohm", initial = 1 }
K = { unit = "N.m/A", initial = 0.1 }
b = { unit = "N.m.s/rad", initial = 1e-4 }
[[equation]]
name = "voltage"
ode = "0 = u - R*i - K*w"
[[equation]]
name = "power"
ode = "0 = u*i - R*i^2 - b*w^2"
[estimator]
functional = "average"
solve = "least_squares"
)toml";

struct Counts {
    long rows;          ///< of one evaluation
    long push;
    long estimate;
    long uncertainty;
};

/// Of one instance that noise alone has filled: nothing of the count depends on what the samples are.
Counts counts(const plan::Plan& plan) {
    const auto data = plan::make_blueprint<Counted>(plan);
    Blueprint<Counted> blueprint = data.view();
    if (plan.points_above_noise()) blueprint.margin_over_noise = 1e-12;   // random rows have residuals that no declared error explains
    const RowSet<Counted>& rows = blueprint.rows;
    const auto sized = [](int n) { return std::vector<Counted>(static_cast<std::size_t>(n), Counted(0)); };
    const int instants = plan.solve_instants;
    const int length = ring_length(rows.samples, blueprint.kept);
    auto rings = sized(ring_scalars(rows.signals, length));
    const bool points = plan.points_above_noise();
    auto sums = sized(points ? sum_scalars(blueprint.points, rows.unknowns) : sum_scalars(blueprint.solve, rows.unknowns, instants));
    auto published = sized(points ? published_scalars(blueprint.points, rows.unknowns) : published_scalars(blueprint.solve, rows.unknowns));
    auto whitened_at = data.whiten_at;
    auto scratch = sized(uncertainty_scratch(rows.rows, rows.unknowns, instants) + above_noise_scratch(rows.unknowns) + point_uncertainty_scratch(blueprint));
    auto lumped = sized(rows.unknowns);
    auto covariance = sized(packed_size(rows.unknowns));
    auto bias = sized(rows.unknowns);
    Progress progress{};
    const Memory<Counted> memory = {rings.data(), sums.data(), published.data(), &progress, whitened_at.data()};
    points ? reset_points(blueprint, memory) : reset(blueprint, memory);
    std::mt19937 random(1);
    std::vector<Counted> sample(static_cast<std::size_t>(rows.signals));
    const auto push_newest = [&] { points ? push_point(blueprint, memory, sample.data(), scratch.data()) : push(blueprint, memory, sample.data(), scratch.data()); };
    for (int k = 0; k < rows.samples + instants + 2; ++k) {
        for (Counted& x : sample) x = Counted(static_cast<double>(random() % 1000U) - 500.0);
        push_newest();
    }
    const auto counted = [](auto&& work) {
        const long before = Counted::operations;
        work();
        return Counted::operations - before;
    };
    Counts out{};
    out.rows = counted([&] { evaluate_rows(rows, rings.data(), WindowPosition{length, 0}, scratch.data(), scratch.data() + row_entries(rows.rows, rows.unknowns)); });
    out.push = counted(push_newest);
    out.estimate = counted([&] { REQUIRE(estimate(blueprint, memory, scratch.data(), lumped.data()).status == Status::ok); });
    if (plan.uncertain()) out.uncertainty = counted([&] { REQUIRE(uncertainty(blueprint, memory, scratch.data(), lumped.data(), covariance.data(), bias.data()).status == Status::ok); });
    return out;
}

/// A count is at most 2 percent from what is stated: left out are the products of factors and the solve of two unknowns, a hundred of eight thousand.
/// evaluations: of all rows; sizes of dot products are stated for pairs of neighbours, and counted without neighbours.
void check(const plan::Plan& plan, long counted, long stated, int evaluations) {
    const auto rows = plan::make_rows<double>(plan.rows, static_cast<int>(plan.lumped.size()));
    const int pairs = size_products<double>(plan.samples()) - size_products<Counted>(plan.samples());
    const long without_pairs = stated - evaluations * static_cast<long>(rows.functionals.size()) * pairs;
    CHECK(static_cast<double>(counted) == Approx(static_cast<double>(without_pairs)).epsilon(0.02));
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
            check(plan, c.rows, cost.rows, 1);
            CHECK(c.push == 0);   // it stores samples
            check(plan, c.estimate, cost.estimate + cost.whitening, 1);   // which as many rows as unknowns do without
            check(plan, c.uncertainty, cost.uncertainty + c.estimate, 1);   // which it does first
        }
    }
    for (const std::string estimator : {"solve = \"least_squares\"\nforgetting = 0.99\n", "solve = \"least_squares\"\n"}) {
        const plan::Plan plan = coils_by("2", estimator);
        const generator::Cost cost = generator::cost_of(plan);
        check(plan, counts(plan).push, cost.push, 1);
        CHECK(cost.push > cost.rows + 60);   // 2 rows into a triangle of two unknowns: 2 (7*3 + 2*2*3)
    }
    const plan::Plan robust = coils_by("2", "solve = \"robust\"\nsolve_window = 0.2\ncondition_limit = 1e9\n");
    const generator::Cost cost = generator::cost_of(robust);
    const Counts c = counts(robust);
    check(robust, c.rows, cost.rows, 1);
    check(robust, c.push, cost.push, 1);
    check(robust, c.uncertainty, cost.uncertainty, node_count(robust.solve_instants));
}

TEST_CASE("stated multiply-adds of operating points are those that are done") {
    for (const std::string forgetting : {"", "forgetting = 0.99\n"}) {
        const plan::Plan plan = plants::plan_of(levels + forgetting);
        REQUIRE(plan.points_above_noise());
        const int unknowns = static_cast<int>(plan.lumped.size());
        const generator::Cost cost = generator::cost_of(plan);
        const Counts c = counts(plan);
        check(plan, c.push - c.rows, cost.push - cost.rows, 0);   // of windows of one sample the factors are most of what rows cost
        check(plan, c.estimate, cost.estimate + solve_triangle_cost(unknowns), 0);
        check(plan, c.uncertainty, cost.uncertainty + c.estimate, 0);   // which it does first
    }
}

}  // namespace algest
