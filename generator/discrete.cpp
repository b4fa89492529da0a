// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/discrete.hpp"

#include <algorithm>

#include "generator/ginac_exact.hpp"

namespace algest::discrete {

namespace {

/// Coefficients of z^0 .. z^n of an expression that is a polynomial in z once it is brought to one fraction.
Taps coefficients(const GiNaC::ex& expression, const GiNaC::symbol& z, int n) {
    Taps out(static_cast<std::size_t>(n) + 1, 0);
    for (const auto& [powers, c] : to_polynomial(GiNaC::normal(expression).expand(), {z})) out.at(static_cast<std::size_t>(powers[0])) = c;
    return out;
}

GiNaC::ex q_of(const GiNaC::symbol& z, const Rational& omega0) { return to_ginac(omega0) * (z - 1) / (z + 1); }

/// polynomial * (k + shift)
std::vector<Integer> times_shifted(const std::vector<Integer>& polynomial, int shift) {
    std::vector<Integer> out(polynomial.size() + 1, 0);
    for (std::size_t e = 0; e < polynomial.size(); ++e) {
        out[e] = out[e] + polynomial[e] * shift;
        out[e + 1] = out[e + 1] + polynomial[e];
    }
    return out;
}

}  // namespace

std::vector<LeibnizTerm> leibniz_expansion(int i, int derivatives) {
    const GiNaC::symbol z("z");
    std::vector<LeibnizTerm> out;
    for (int j = 0; j <= std::min(i, derivatives); ++j) {
        const GiNaC::ex factor = GiNaC::binomial(derivatives, j) * GiNaC::pow(z, i).diff(z, static_cast<unsigned>(j));
        for (const auto& [powers, c] : to_polynomial(factor.expand(), {z})) out.push_back({cln::numerator(c), powers[0], derivatives - j});
    }
    return out;
}

std::vector<Integer> multiplier(int i, int n, int derivatives) {
    std::vector<Integer> out(static_cast<std::size_t>(derivatives) + 1, 0);
    for (const LeibnizTerm& term : leibniz_expansion(i, derivatives)) {
        // z^j d^j y_z/dz^j stands for (-1)^j k (k+1) ... (k+j-1) y(k), and z^(derivatives-n) brings z^power there: k becomes k-n+i.
        std::vector<Integer> rising = {(derivatives - term.derivative) % 2 == 0 ? term.coefficient : -term.coefficient};
        for (int s = 0; s < term.derivative; ++s) rising = times_shifted(rising, i - n + s);
        for (std::size_t e = 0; e < rising.size(); ++e) out[e] = out[e] + rising[e];
    }
    return out;
}

Integer value_at(const std::vector<Integer>& polynomial, int k) {
    Integer out = 0;
    for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) out = out * k + *c;
    return out;
}

Taps denominator_in_q(int i, int n, const Rational& omega0) {
    const GiNaC::symbol z("z");
    return coefficients(GiNaC::pow(z + 1, n) * GiNaC::pow(q_of(z, omega0), i), z, n);
}

Taps numerator_in_q(int i, int n, int m, const Rational& omega0) {
    const GiNaC::symbol z("z");
    const GiNaC::ex q = q_of(z, omega0);
    return coefficients(GiNaC::pow(z + 1, n) * GiNaC::pow(1 - q / to_ginac(omega0), n - m) * GiNaC::pow(q, i), z, n);
}

Taps numerator_in_z(int i, int n, int m, int numerator) {
    const GiNaC::symbol z("z");
    return coefficients(GiNaC::pow(z + 1, m - numerator) * GiNaC::pow(z, i), z, n);
}

Taps denominator_in_z(int i, int n) {
    Taps out(static_cast<std::size_t>(n) + 1, 0);
    out.at(static_cast<std::size_t>(i)) = 1;
    return out;
}

std::vector<Integer> level(int l, const Rational& gamma, int count) {
    std::vector<Integer> out(static_cast<std::size_t>(count), 0);
    if (l == 0) {
        out[0] = 1;
        return out;
    }
    // The response of 1/(z-gamma)^l is C(d-1,l-1) gamma^(d-l), here over the common denominator of all d.
    const Integer above = cln::numerator(gamma);
    const Integer below = cln::denominator(gamma);
    std::vector<Integer> scale(static_cast<std::size_t>(count), 1);   // by count-1-d: below to that power
    for (std::size_t e = 1; e < scale.size(); ++e) scale[e] = scale[e - 1] * below;
    Integer choices = 1;
    Integer power = 1;
    for (int d = l; d < count; ++d) {
        out[static_cast<std::size_t>(d)] = choices * power * scale[static_cast<std::size_t>(count - 1 - d)];
        choices = cln::exquo(choices * d, Integer(d - l + 1));
        power = power * above;
    }
    return out;
}

std::vector<Integer> impulse_response(const std::vector<Rational>& numerator, const std::vector<Rational>& denominator, int count) {
    std::vector<Rational> response;
    for (std::size_t d = 0; d < static_cast<std::size_t>(count); ++d) {
        Rational sum = d < numerator.size() ? numerator[d] : Rational(0);
        for (std::size_t s = 1; s < denominator.size() && s <= d; ++s) sum = sum - denominator[s] * response[d - s];
        response.push_back(sum / denominator[0]);
    }
    Integer common = 1;
    for (const Rational& r : response) common = cln::lcm(common, cln::denominator(r));
    std::vector<Integer> out;
    for (const Rational& r : response) out.push_back(cln::numerator(r * common));
    return out;
}

std::vector<Integer> convolved(const std::vector<Integer>& a, const std::vector<Integer>& b) {
    std::vector<Integer> out(a.size(), 0);
    for (std::size_t s = 0; s < b.size(); ++s) {
        if (cln::zerop(b[s])) continue;
        for (std::size_t d = s; d < a.size(); ++d) out[d] = out[d] + b[s] * a[d - s];
    }
    return out;
}

std::vector<Integer> weights(const std::vector<Integer>& chi, const std::vector<Integer>& by_age, const std::vector<Integer>& taps, int intervals) {
    const int n = static_cast<int>(taps.size()) - 1;
    std::vector<Integer> out(static_cast<std::size_t>(intervals) + 1, 0);
    for (int k = 0; k <= intervals; ++k) {
        const Integer& age = by_age[static_cast<std::size_t>(intervals - k)];
        if (cln::zerop(age)) continue;
        const Integer weight = value_at(chi, k) * age;
        for (int s = std::max(0, n - k); s <= n; ++s) {
            Integer& sample = out[static_cast<std::size_t>(k - n + s)];
            sample = sample + taps[static_cast<std::size_t>(s)] * weight;
        }
    }
    return out;
}

}  // namespace algest::discrete
