// SPDX-License-Identifier: GPL-3.0-or-later
// S(t) over the last L instants, against direct sums in long double: right at once, after a million instants, and as soon as
// an instant has gone that was so large that everything else was lost beside it.
#include "algest/gram_window.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <deque>
#include <limits>
#include <random>
#include <vector>

namespace {

constexpr int unknowns = 3, rows = 2, width = unknowns + 1;
constexpr int size = algest::packed_size(width);

using Matrix = std::vector<double>;  // rows x width

/// The packed sums over the last `instants` matrices, directly.
std::vector<long double> direct(const std::deque<Matrix>& all) {
    std::vector<long double> out(size, 0.0L);
    for (const Matrix& m : all) {
        for (int i = 0; i < width; ++i) {
            for (int j = i; j < width; ++j) {
                for (int r = 0; r < rows; ++r) {
                    out[static_cast<std::size_t>(algest::packed_index(width, i, j))] +=
                        static_cast<long double>(m[static_cast<std::size_t>(r * width + i)]) *
                        static_cast<long double>(m[static_cast<std::size_t>(r * width + j)]);
                }
            }
        }
    }
    return out;
}

/// Largest error of the served sums, relative to the diagonal entries that belong to them.
double error(const std::vector<double>& served, const std::vector<long double>& wanted) {
    long double largest = 0.0L;
    for (int i = 0; i < width; ++i) {
        for (int j = i; j < width; ++j) {
            const auto at = [&](int a, int b) { return static_cast<std::size_t>(algest::packed_index(width, a, b)); };
            const long double scale = std::sqrt(wanted[at(i, i)]) * std::sqrt(wanted[at(j, j)]);
            largest = std::max(largest, std::abs(static_cast<long double>(served[at(i, j)]) - wanted[at(i, j)]) / scale);
        }
    }
    return static_cast<double>(largest);
}

class Window {
public:
    explicit Window(int instants)
        : instants_(instants), memory_(static_cast<std::size_t>(algest::gram_scalars(unknowns, instants)), 99.0) {
        algest::clear_gram(memory_.data(), progress_, unknowns);
    }
    void add(const Matrix& matrix) {
        algest::add_instant(memory_.data(), progress_, matrix.data(), rows, unknowns, instants_);
        last_.push_back(matrix);
        if (last_.size() > static_cast<std::size_t>(instants_)) last_.pop_front();
    }
    void clear() {
        algest::clear_gram(memory_.data(), progress_, unknowns);
        last_.clear();
    }
    double error() const { return ::error({memory_.begin(), memory_.begin() + size}, direct(last_)); }
    bool full() const { return algest::gram_is_full(progress_, instants_); }

private:
    int instants_;
    std::vector<double> memory_;
    algest::GramProgress progress_{};
    std::deque<Matrix> last_;
};

Matrix random_matrix(std::mt19937_64& random) {
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    Matrix out(rows * width);
    for (double& v : out) v = value(random);
    return out;
}

/// What L additions round at most, and two roundings in each product; nothing is ever taken away from a sum. Relative to the
/// sum itself.
double bound(int instants) { return (0.5 * instants + 2.0) * std::numeric_limits<double>::epsilon(); }

}  // namespace

TEST_CASE("S(t) is the sum over the last instants, from the first on") {
    std::mt19937_64 random(1);
    for (const int instants : {1, 2, 3, 5, 16, 50}) {
        Window window(instants);
        for (int k = 0; k < 6 * instants + 7; ++k) {
            window.add(random_matrix(random));
            REQUIRE(window.full() == (k + 1 >= instants));
            REQUIRE(window.error() <= bound(instants));
        }
        window.clear();
        window.add(random_matrix(random));
        CHECK(window.full() == (instants == 1));
        CHECK(window.error() <= bound(1));  // nothing of before is left
    }
}

TEST_CASE("S(t) does not drift in a million instants") {
    constexpr int instants = 20;
    std::mt19937_64 random(2);
    Window window(instants);
    std::deque<double> last;  // the recursion that this scheme replaces, on one entry: add the newest, remove the oldest
    double naive = 0.0;
    for (int k = 0; k < 1'000'000; ++k) {
        const Matrix m = random_matrix(random);
        window.add(m);
        const double square = m[0] * m[0] + m[width] * m[width];
        if (last.size() == instants) {
            naive -= last.front();
            last.pop_front();
        }
        last.push_back(square);
        naive += square;
        if (k % 997 == 0) REQUIRE(window.error() <= bound(instants));
    }
    CHECK(window.error() <= bound(instants));
    long double exact = 0.0L;
    for (const double v : last) exact += v;
    const double drift = static_cast<double>(std::abs((naive - exact) / exact));
    CHECK(drift > bound(instants));  // a million roundings are more than the bound: the check above can fail
}

TEST_CASE("S(t) forgets at once an instant that drowned all others") {
    std::mt19937_64 random(3);
    for (const int instants : {1, 2, 7, 20}) {
        for (int phase = 0; phase < 2 * instants + 2; ++phase) {
            Window window(instants);
            for (int k = 0; k < 3 * instants + phase; ++k) window.add(random_matrix(random));
            Matrix flood = random_matrix(random);
            for (double& v : flood) v *= 1e12;
            window.add(flood);
            for (int k = 1; k < instants; ++k) {
                window.add(random_matrix(random));
                REQUIRE(window.error() <= bound(instants));  // still in the window
            }
            for (int k = 0; k < 3 * instants; ++k) {
                window.add(random_matrix(random));
                REQUIRE(window.error() <= bound(instants));  // gone, and with it its roundings
            }
        }
    }
}
