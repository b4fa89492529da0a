// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/plan_hash.hpp"

#include <bit>

#include "generator/elimination_data.hpp"

namespace algest::generator {

namespace {

class Hash {
public:
    void add(std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte) {
            state_ ^= (value >> (8 * byte)) & 0xFFU;
            state_ *= 0x100000001B3ULL;   // FNV-1a, 64 bits
        }
    }
    void add(int value) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
    void add(bool value) { add(value ? 1 : 0); }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const std::string& text) {
        add(static_cast<std::uint64_t>(text.size()));
        for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    }
    void add(const plan::Tape& tape) {
        add(static_cast<std::uint64_t>(tape.operations.size()));
        for (const plan::Operation& o : tape.operations) {
            add(static_cast<int>(o.op));
            add(o.a);
            add(o.b);
            add(o.value);
        }
        for (const int r : tape.results) add(r);
    }

    std::string text() const {
        std::string out;
        for (int shift = 60; shift >= 0; shift -= 4) out += "0123456789abcdef"[(state_ >> shift) & 0xFU];
        return out;
    }

private:
    std::uint64_t state_ = 0xCBF29CE484222325ULL;
};

void add_elimination(const plan::Plan& plan, Hash& hash) {
    if (!plan.elimination) return;
    const auto data = plan::make_elimination<double>(plan.elimination);
    for (const double size : data.sizes) hash.add(size);
    for (const EliminationStage& s : data.stages) {
        for (const std::uint16_t number : {s.first_column, s.columns, s.alone, s.summands, s.x, s.y, s.squares, s.degree_x, s.degree_y, s.terms, s.factors, s.resultant_degree, s.degree_of_first}) {
            hash.add(static_cast<int>(number));
        }
    }
    for (const auto& a : data.alone) {
        hash.add(static_cast<int>(a.parameter));
        hash.add(static_cast<int>(a.squared));
        hash.add(a.coefficient);
    }
    for (const std::uint16_t column : data.column_of) hash.add(static_cast<int>(column));
    for (const std::vector<double>* numbers : {&data.coefficient_of, &data.terms}) for (const double x : *numbers) hash.add(x);
    for (const std::vector<std::uint8_t>* numbers : {&data.exponents, &data.factors}) for (const std::uint8_t x : *numbers) hash.add(static_cast<int>(x));
}

}  // namespace

std::string plan_hash(const plan::Plan& plan) {
    Hash hash;
    hash.add(plan.name);
    hash.add(static_cast<int>(plan.scalar));
    hash.add(plan.period_text);
    hash.add(plan.intervals);
    hash.add(plan.decimate);
    hash.add(static_cast<int>(plan.quadrature));
    for (const plan::Input& i : plan.inputs) {
        hash.add(i.name);
        hash.add(i.unit);
        hash.add(i.min);
        hash.add(i.max);
        hash.add(i.differentiated);
    }
    for (const plan::PastInput& p : plan.past) {
        hash.add(p.input);
        hash.add(p.samples);
    }
    for (const plan::WindowSignal& s : plan.window_signals) {
        hash.add(s.text);
        hash.add(static_cast<int>(s.hold));
        hash.add(s.held);
        hash.add(s.delayed);
    }
    for (const std::string& p : plan.partials) hash.add(p);
    hash.add(plan.signals);
    for (const plan::Table& t : plan.tables) {
        hash.add(t.name);
        for (const std::string& c : t.kernel) hash.add(c);
        for (const double w : t.weights) hash.add(w);
    }
    if (plan.moments) {
        for (const int degree : plan.moments->degrees) hash.add(degree);
        hash.add(static_cast<int>(plan.moments->accumulators));
        for (const plan::MomentTable& t : plan.moments->tables) {
            for (const std::vector<double>* numbers : {&t.coefficients, &t.rests, &t.growing, &t.growing_newest}) for (const double x : *numbers) hash.add(x);
            for (const double x : {t.oldest, t.newest, t.of_one, t.gain}) hash.add(x);
        }
    }
    for (const std::vector<plan::Row>* rows : {&plan.rows, &plan.perturbation}) {
        hash.add(static_cast<int>(rows->size()));
        for (const plan::Row& row : *rows) {
            hash.add(row.equation);
            hash.add(row.p);
            for (const plan::RowTerm& t : row.terms) {
                hash.add(t.lumped);
                hash.add(t.signal);
                hash.add(t.table);
                hash.add(t.factor);
            }
        }
    }
    for (const plan::Parameter& p : plan.parameters) {
        hash.add(p.name);
        hash.add(p.unit);
        hash.add(p.initial);
    }
    hash.add(plan.parameter_map);
    hash.add(plan.map_derivatives);
    hash.add(static_cast<int>(plan.solve));
    hash.add(plan.solve_instants);
    hash.add(plan.keep);
    hash.add(plan.condition_limit);
    hash.add(plan.kept);
    for (const plan::NoiseChannel& c : plan.noise) {
        hash.add(c.input);
        hash.add(c.signal);
        hash.add(c.partial);
        hash.add(c.lag);
        hash.add(c.factor);
    }
    hash.add(plan.deviation_limit);
    if (plan.deviation_limit > 0.0) for (const plan::Lumped& u : plan.lumped) hash.add(u.initial);
    for (const double x : plan.noise_floor) hash.add(x);
    if (plan.margin_over_noise > 0.0) hash.add(plan.margin_over_noise);
    if (plan.discrete) hash.add(plan.output_noise);
    hash.add(plan.whiten);
    if (plan.longest_wait() > 0) for (const plan::Input& i : plan.inputs) hash.add(i.wait);
    if (plan.whiten) for (const plan::Lumped& u : plan.lumped) hash.add(u.initial);
    add_elimination(plan, hash);
    if (plan.steady) {
        hash.add(plan.steady->block);
        for (const plan::Averaged& a : plan.steady->averaged) {
            hash.add(a.name);
            hash.add(a.tolerance);
        }
        hash.add(plan.steady->quantities);
        hash.add(plan.steady->stretches);
    }
    if (plan.ratio) {
        for (const std::vector<double>* numbers : {&plan.ratio->transition, &plan.ratio->before, &plan.ratio->now}) for (const double x : *numbers) hash.add(x);
    }
    if (plan.normalise) hash.add(true);
    return hash.text();
}

}  // namespace algest::generator
