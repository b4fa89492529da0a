// SPDX-License-Identifier: 0BSD
// The simulated drive train: G(s) of Fliess, Fuchshumer, Schlacher, Sira-Ramirez 2006, section VI, from the motor's voltage to the speed of
// the last rotor. The voltage is held over a period, so that one step is exact: x := Phi x + Gamma u.
#pragma once
#include <array>
#include <cstddef>

namespace drive_train {

/// G(s) = V / ((1 + s/corner) (1 + 2 xi_1 s/omega_1 + s^2/omega_1^2) (1 + 2 xi_2 s/omega_2 + s^2/omega_2^2))
struct Constants {
    double V = 23.7;        ///< rad/s/V
    double corner = 8.1;    ///< rad/s
    double omega_1 = 12.4;  ///< rad/s
    double omega_2 = 27.7;  ///< rad/s
    double xi_1 = 0.1;
    double xi_2 = 0.0083;
};

class Plant {
public:
    /// Behind the real pole; behind the first pair and its derivative; behind both pairs: the speed [rad/s] and its derivative.
    using State = std::array<long double, 5>;

    explicit Plant(double period, const Constants& constants = {}, const State& start = {}) : state_(start) {
        const Matrix a = dynamics(constants);
        Matrix term{};
        for (std::size_t i = 0; i < size; ++i) step_[i][i] = term[i][i] = 1.0L;
        for (int order = 1; order < 60; ++order) {   // exp(a period): |a period| is below 10 down to 5 samples a second
            term = scaled_product(term, a, static_cast<long double>(period) / order);
            for (std::size_t i = 0; i < size; ++i) for (std::size_t j = 0; j < size; ++j) step_[i][j] += term[i][j];
        }
    }

    /// rad/s
    double omega() const { return static_cast<double>(state_[3]); }

    /// One period with this voltage [V].
    void advance(double u) {
        State next{};
        for (std::size_t i = 0; i < next.size(); ++i) {
            next[i] = step_[i][5] * u;
            for (std::size_t j = 0; j < next.size(); ++j) next[i] += step_[i][j] * state_[j];
        }
        state_ = next;
    }

private:
    static constexpr std::size_t size = 6;   // the state, and the held voltage
    using Matrix = std::array<std::array<long double, size>, size>;

    static Matrix dynamics(const Constants& c) {
        Matrix a{};
        a[0][0] = -c.corner;
        a[0][5] = static_cast<long double>(c.corner) * c.V;
        a[1][2] = 1.0L;
        a[2][0] = static_cast<long double>(c.omega_1) * c.omega_1;
        a[2][1] = -a[2][0];
        a[2][2] = -2.0L * c.xi_1 * c.omega_1;
        a[3][4] = 1.0L;
        a[4][1] = static_cast<long double>(c.omega_2) * c.omega_2;
        a[4][3] = -a[4][1];
        a[4][4] = -2.0L * c.xi_2 * c.omega_2;
        return a;
    }

    static Matrix scaled_product(const Matrix& x, const Matrix& y, long double scale) {
        Matrix out{};
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t k = 0; k < size; ++k) for (std::size_t j = 0; j < size; ++j) out[i][j] += scale * x[i][k] * y[k][j];
        }
        return out;
    }

    Matrix step_{};
    State state_;
};

}  // namespace drive_train
