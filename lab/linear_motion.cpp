// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/linear_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace algest::lab {

namespace {

/// How a value may change between two samples.
enum class Course {
    constant,   ///< in the whole run
    held,       ///< from sample to sample
    straight,   ///< in time, between samples
    affine,     ///< in the state, with constant factors, beside what is straight
    other
};

Course product(Course a, Course b) {
    if (a > b) std::swap(a, b);
    if (a == Course::constant) return b;
    return a == Course::held && b < Course::affine ? b : Course::other;
}

Course quotient(Course a, Course by) { return by > Course::held ? Course::other : product(a, by); }

/// Of an operation, from the courses of what it is made of.
Course course_of(const plan::Operation& o, const std::vector<Course>& inputs, const std::vector<Course>& values) {
    using plan::Op;
    const auto of = [&](int k) { return values[static_cast<std::size_t>(k)]; };
    switch (o.op) {
        case Op::constant: return Course::constant;
        case Op::input: return inputs[static_cast<std::size_t>(o.a)];
        case Op::previous:
        case Op::derivative: return Course::other;
        case Op::neg: return of(o.a);
        case Op::add:
        case Op::sub: return std::max(of(o.a), of(o.b));
        case Op::mul: return product(of(o.a), of(o.b));
        case Op::div: return quotient(of(o.a), of(o.b));
        case Op::min:
        case Op::max:
        case Op::pow: return std::max(of(o.a), of(o.b)) > Course::held ? Course::other : std::max(of(o.a), of(o.b));
        default: return of(o.a) > Course::held ? Course::other : of(o.a);   // a function of one value
    }
}

/// By scaling and squaring: a Taylor series of a matrix of norm below a half, to the last digit.
Eigen::MatrixXd exponential(const Eigen::MatrixXd& m) {
    constexpr int terms = 16;   // 0.5^16 / 16! < 1e-18
    const double norm = m.cwiseAbs().rowwise().sum().maxCoeff();
    if (!std::isfinite(norm)) return Eigen::MatrixXd::Constant(m.rows(), m.cols(), std::numeric_limits<double>::quiet_NaN());   // a run of it diverges
    const int squarings = norm > 0.5 ? static_cast<int>(std::ceil(std::log2(norm / 0.5))) : 0;
    const Eigen::MatrixXd small = m / std::ldexp(1.0, squarings);
    Eigen::MatrixXd out = Eigen::MatrixXd::Identity(m.rows(), m.cols());
    for (int k = terms; k > 0; --k) out = Eigen::MatrixXd::Identity(m.rows(), m.cols()) + small * out / k;
    for (int k = 0; k < squarings; ++k) out = out * out;
    return out;
}

}  // namespace

bool is_linear(const OdeSystem& system, const std::vector<bool>& held) {
    const bool remembers = std::any_of(system.delays.begin(), system.delays.end(), [](const DelayedSignal& d) { return d.moves; });
    if (!system.constant_mass || remembers || !system.layers.empty() || !system.input_derivatives.empty()) return false;
    std::vector<Course> inputs(static_cast<std::size_t>(system.inputs), Course::constant);
    for (const int s : system.driven) inputs[static_cast<std::size_t>(s)] = held[static_cast<std::size_t>(s)] ? Course::held : Course::straight;
    for (const Law& law : system.laws) inputs[static_cast<std::size_t>(law.signal)] = Course::held;
    for (const Output& output : system.outputs) inputs[static_cast<std::size_t>(output.signal)] = Course::held;
    for (std::size_t d = 0; d < system.delays.size(); ++d) inputs[static_cast<std::size_t>(system.delay_input) + d] = inputs[static_cast<std::size_t>(system.delays[d].signal)];
    for (std::size_t r = 0; r < system.relays.size(); ++r) inputs[static_cast<std::size_t>(system.relay_input) + r] = Course::held;
    for (std::size_t m = 0; m < system.moving.size(); ++m) {
        inputs[static_cast<std::size_t>(system.moving[m])] = Course::affine;
        for (const int derivative : system.derivative_input[m]) inputs[static_cast<std::size_t>(derivative)] = Course::affine;
    }
    std::vector<Course> values;
    for (const plan::Operation& o : system.residual.operations) values.push_back(course_of(o, inputs, values));
    const auto& results = system.residual.results;
    return std::all_of(results.begin(), results.begin() + static_cast<std::ptrdiff_t>(system.moving.size()), [&](int r) { return values[static_cast<std::size_t>(r)] != Course::other; });
}

LinearStep linear_step(const Eigen::MatrixXd& a, double h) {
    // e^([hA 1 0; 0 0 1; 0 0 0]) holds both phi in its first rows.
    const Eigen::Index n = a.rows();
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    m.topLeftCorner(n, n) = h * a;
    m.block(0, n, n, n).setIdentity();
    m.block(n, 2 * n, n, n).setIdentity();
    const Eigen::MatrixXd e = exponential(m);
    return {h * e.block(0, n, n, n), h * e.block(0, 2 * n, n, n)};
}

}  // namespace algest::lab
