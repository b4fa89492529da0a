// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/discrete_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algest/transfer_function.hpp"

namespace algest::lab {

namespace {

using Complex = std::complex<double>;

std::vector<Complex> roots(const std::vector<double>& coefficients) {
    const int degree = static_cast<int>(coefficients.size()) - 1;
    std::vector<Complex> out(static_cast<std::size_t>(degree));
    if (degree > 0) polynomial_roots(coefficients.data(), degree, out.data());
    return out;
}

std::vector<Complex> sorted(std::vector<Complex> values) {
    std::sort(values.begin(), values.end(), [](Complex x, Complex y) {
        // Those of a pair differ in size by rounding alone.
        const double difference = std::abs(x) - std::abs(y);
        return std::abs(difference) > 1e-9 * std::abs(x) ? difference < 0.0 : x.imag() < y.imag();
    });
    return values;
}

bool finite(const std::vector<Complex>& values) {
    return std::all_of(values.begin(), values.end(), [](Complex x) { return std::isfinite(x.real()) && std::isfinite(x.imag()); });
}
bool finite(const std::vector<double>& values) { return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }); }

}  // namespace

std::optional<DiscreteSystem> discrete_system(const plan::Plan& plan, const std::vector<double>& parameters) {
    if (!plan.discrete) return std::nullopt;
    const plan::Discrete& d = *plan.discrete;
    const TransferOrders orders{d.n, d.m, d.numerator};
    const auto middle = parameters.begin() + d.n;
    const std::size_t n = static_cast<std::size_t>(d.n);
    const std::size_t numerator = static_cast<std::size_t>(d.numerator) + 1;
    DiscreteSystem out;
    if (d.domain == plan::Domain::q) {
        out.A.assign(parameters.begin(), middle);
        out.B.assign(middle, parameters.end());
        out.a.resize(n + 1);
        out.b.resize(numerator);
        z_from_q(orders, plan.period, out.A.data(), out.B.data(), out.a.data(), out.b.data());
        out.poles_s.resize(n);
        continuous_poles_of_q(out.A.data(), d.n, plan.period, out.poles_s.data());
        for (const Complex s : out.poles_s) out.poles_z.push_back(std::exp(s * plan.period));
    } else {
        out.a.assign(parameters.begin(), middle);
        out.a.push_back(1.0);
        out.b.assign(middle, parameters.end());
        out.A.resize(n);
        out.B.resize(numerator);
        q_from_z(orders, plan.period, out.a.data(), out.b.data(), out.A.data(), out.B.data());
        out.poles_z = roots(out.a);
        for (const Complex z : out.poles_z) out.poles_s.push_back(continuous_from_z(z, plan.period));
    }
    if (out.b.back() != 0.0) out.zeros_z = sorted(roots(out.b));
    out.poles_z = sorted(out.poles_z);
    out.poles_s = sorted(out.poles_s);
    const bool good = finite(out.a) && finite(out.b) && finite(out.A) && finite(out.B) && finite(out.poles_z) && finite(out.poles_s) && finite(out.zeros_z);
    return good ? std::optional(out) : std::nullopt;
}

std::optional<std::string> advice_on_domain(const plan::Plan& plan, const Replay& replay) {
    if (!plan.discrete || plan.discrete->domain != plan::Domain::z) return std::nullopt;
    if (std::find(replay.status.begin(), replay.status.end(), Status::ok) != replay.status.end()) return std::nullopt;
    const auto refused = std::find_if(replay.condition.rbegin(), replay.condition.rend(), [&](double c) { return std::isfinite(c) && c > plan.condition_limit; });
    if (refused == replay.condition.rend()) return std::nullopt;
    return fmt::format("the condition number {:.2g} of the rows in z is above the limit of {:.2g}: sampled every {:.6g} s, poles of z lie too close to 1; write domain = \"q\" under [discrete]", *refused, plan.condition_limit, plan.period);
}

}  // namespace algest::lab
