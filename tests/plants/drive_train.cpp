// SPDX-License-Identifier: GPL-3.0-or-later
// Issue 5: the drive train of 004 with the setup and the bars of errata.md.
#include "tests/plants/drive_train.hpp"

#include <Eigen/Dense>
#include <array>

using namespace algest;
using namespace algest::plants;

namespace {

/// Coefficients of (z-1)^minus (z+1)^plus, z^0 first.
std::vector<long double> bilinear(int minus, int plus) {
    std::vector<long double> out = {1.0L};
    for (int factor = 0; factor < minus + plus; ++factor) {
        const long double root = factor < minus ? 1.0L : -1.0L;
        out.push_back(0.0L);
        for (std::size_t k = out.size() - 1; k > 0; --k) out[k] = out[k - 1] - root * out[k];
        out[0] *= -root;
    }
    return out;
}

/// chi(k) sum_s taps[s] f(k-n+s), k = 0 .. M.
std::vector<long double> first_row(const std::vector<double>& f, const std::vector<long double>& taps) {
    constexpr int n = 5;
    std::vector<long double> out;
    for (int k = 0; k < static_cast<int>(f.size()); ++k) {
        long double chi = 1.0L, sum = 0.0L;
        for (int s = 0; s <= n; ++s) chi *= k - n + s;
        for (int s = 0; s < static_cast<int>(taps.size()); ++s) {
            if (k - n + s >= 0) sum += taps[static_cast<std::size_t>(s)] * f[static_cast<std::size_t>(k - n + s)];
        }
        out.push_back(chi * sum);
    }
    return out;
}

/// The condition of P by section II as it is written: sums of sums, each row divided by its largest entry, singular values. The sums are
/// divided by a number on the way, since they reach 1e77.
double condition_by_definition(const DriveTrainRun& run, bool q, int numerator, double period) {
    constexpr int n = 5, m = 4, skip = 7, extra = 10;
    const long double omega0 = 2.0L / period;
    std::vector<std::vector<long double>> columns;
    for (int i = 0; i < n; ++i) {
        std::vector<long double> taps = q ? bilinear(i + 1, n - i - 1) : std::vector<long double>(static_cast<std::size_t>(i) + 1, 0.0L);
        if (!q) taps.back() = 1.0L;
        for (long double& t : taps) t *= q ? std::pow(omega0, i + 1) : 1.0L;
        columns.push_back(first_row(run.omega, taps));
    }
    for (int i = 0; i <= numerator; ++i) {
        std::vector<long double> taps = q ? bilinear(i, m - i) : bilinear(0, m - numerator);
        if (!q) taps.insert(taps.begin(), static_cast<std::size_t>(i), 0.0L);
        for (long double& t : taps) t *= q ? -2.0L * std::pow(omega0, i) : -1.0L;
        columns.push_back(first_row(run.u, taps));
    }
    const int last = n + numerator + skip + extra;
    Eigen::MatrixXd P(last - skip + 1, static_cast<Eigen::Index>(columns.size()));
    for (int level = 0; level <= last; ++level) {
        if (level >= skip) {
            for (Eigen::Index c = 0; c < P.cols(); ++c) P(level - skip, c) = static_cast<double>(columns[static_cast<std::size_t>(c)].back());
            P.row(level - skip) /= P.row(level - skip).cwiseAbs().maxCoeff();
        }
        for (std::vector<long double>& column : columns) {
            long double sum = 0.0L;
            for (long double& entry : column) {
                const long double here = entry;
                entry = sum / static_cast<long double>(run.u.size());
                sum += here;
            }
        }
    }
    const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(P).singularValues();
    return singular(0) / singular(singular.size() - 1);
}

}  // namespace

TEST_CASE("drive train: cond(P) in z and in q beside the paper's, tables (10) and (11)") {
    const std::array<double, 5> paper_z = {3.0e10, 5.1e11, 2.9e13, 5.4e14, 9.0e15};   // errata.md
    const std::array<double, 5> paper_q = {1.7e10, 8.0e9, 1.2e10, 1.4e10, 1.5e10};
    for (const int numerator : {4, 0}) {
        fmt::print("cond(P), numerator = {}; the text of table (11) is lost\n  T_a      z        SVD      paper    q        SVD      paper\n", numerator);
        std::vector<double> z, q;
        for (std::size_t k = 0; k < drive_train_periods.size(); ++k) {
            const double period = std::stod(drive_train_periods[k]);
            const DriveTrainRun run = drive_train_run(period);
            std::array<double, 2> reported{}, defined{};
            for (const bool in_q : {false, true}) {
                const plan::Plan plan = plan_of(drive_train_model({in_q ? "q" : "z", numerator, drive_train_periods[k]}));
                reported[in_q] = at_the_end(plan, run).condition;
                defined[in_q] = condition_by_definition(run, in_q, numerator, period);
                // What is reported is a bound, at most `unknowns` times too large; near 1/epsilon the singular values are rounding, too.
                CHECK(reported[in_q] > 0.5 * defined[in_q]);
                CHECK(reported[in_q] < static_cast<double>(plan.lumped.size()) * 2.0 * defined[in_q]);
            }
            z.push_back(reported[0]);
            q.push_back(reported[1]);
            const auto paper = [&](const std::array<double, 5>& of) { return numerator == 4 ? fmt::format("{:.1e}", of[k]) : std::string("-"); };
            fmt::print("  {:4} ms  {:.1e}  {:.1e}  {:7}  {:.1e}  {:.1e}  {:7}\n", period * 1e3, z[k], defined[0], paper(paper_z), q[k], defined[1], paper(paper_q));
            if (numerator != 4) continue;
            CHECK(z[k] > paper_z[k] / 5.0);   // the bars of errata.md
            CHECK(z[k] < paper_z[k] * 5.0);
            CHECK(q[k] > paper_q[k] / 5.0);
            CHECK(q[k] < paper_q[k] * 5.0);
        }
        const double growth = std::log(z.back() / z.front()) / std::log(20.0);
        const double spread = *std::max_element(q.begin(), q.end()) / *std::min_element(q.begin(), q.end());
        fmt::print("  growth exponent of z {:.2f}, spread of q {:.2f}\n", growth, spread);
        CHECK(growth > 3.5);
        CHECK(growth < 4.7);
        CHECK(spread < 5.0);
    }
}

TEST_CASE("drive train: poles without noise") {
    fmt::print("relative pole errors at 8.1, 12.4, 27.7 rad/s, noise-free, numerator = 4:\n");
    struct Bar {
        const char* domain;
        const char* period;
        double most;   // errata.md
    };
    for (const Bar& bar : {Bar{"q", "0.01", 1e-9}, Bar{"q", "0.001", 1e-4}, Bar{"q", "0.0005", 1e-4}, Bar{"z", "0.01", 1e-5}}) {
        const plan::Plan plan = plan_of(drive_train_model({bar.domain, 4, bar.period}));
        const DriveTrainEstimate e = at_the_end(plan, drive_train_run(std::stod(bar.period)));
        REQUIRE(e.status == Status::ok);
        const std::vector<double> errors = pole_errors(plan, e.unknowns);
        fmt::print("  {} {:>6} s: {:.1e} {:.1e} {:.1e}, condition {:.1e}\n", bar.domain, bar.period, errors[0], errors[1], errors[2], e.condition);
        CHECK(worst(errors) < bar.most);
    }
}

TEST_CASE("drive train: sampled at 1 and 0.5 ms, rows in z are refused by their condition, with advice") {
    for (const std::string period : {"0.001", "0.0005"}) {
        const plan::Plan plan = plan_of(drive_train_model({"z", 4, period}));
        const DriveTrainEstimate e = at_the_end(plan, drive_train_run(std::stod(period)));
        CHECK(e.status == Status::singular);
        CHECK(e.condition > plan.condition_limit);
        lab::Replay replay{{1.35}, {e.status}, {e.condition}, e.unknowns, e.unknowns.size(), {}};
        const auto advice = lab::advice_on_domain(plan, replay);
        REQUIRE(advice);
        CHECK(advice->find("domain = \"q\"") != std::string::npos);
        // In q the same replay would have been ok, and it is not advice on q.
        CHECK_FALSE(lab::advice_on_domain(plan_of(drive_train_model({"q", 4, period})), replay));
    }
}

TEST_CASE("drive train: initial conditions are annihilated by n+1 derivatives and not by n") {
    const drive_train::Plant::State start = {3.0L, -2.0L, 0.0L, 5.0L, 20.0L};
    const DriveTrainRun moving = drive_train_run(0.01, start);
    const DriveTrainRun resting = drive_train_run(0.01);
    for (const std::string domain : {"z", "q"}) {
        const double bar = domain == "q" ? 1e-9 : 1e-5;   // errata.md, as from rest
        const auto error = [&](int derivatives, const DriveTrainRun& run) {
            const plan::Plan plan = plan_of(drive_train_model({domain, 4, "0.01", "square", fmt::format("derivatives = {}", derivatives)}));
            const DriveTrainEstimate e = at_the_end(plan, run);
            REQUIRE(e.status == Status::ok);
            return worst(pole_errors(plan, e.unknowns));
        };
        const double n = error(5, moving), n_resting = error(5, resting), n_plus_1 = error(6, moving), n_plus_2 = error(7, moving);
        fmt::print("{}: worst pole error, moving at first: {:.1e} with 6 derivatives, {:.1e} with 7, {:.1e} with 5 (from rest {:.1e})\n", domain, n_plus_1, n_plus_2, n, n_resting);
        CHECK(n_plus_1 < bar);
        CHECK(n_plus_2 < bar);
        CHECK(n_resting < bar);
        CHECK(n > 0.03);   // errata.md: 3 percent
    }
}

TEST_CASE("drive train: a pure step makes P singular for all four zeros") {
    for (const std::string domain : {"z", "q"}) {
        for (const std::string period : {"0.01", "0.001"}) {
            const DriveTrainRun step = drive_train_run(std::stod(period), [](int) { return 0.1; });   // not exact in binary: columns of rounding
            const plan::Plan plan = plan_of(drive_train_model({domain, 4, period}));
            const DriveTrainEstimate e = at_the_end(plan, step);
            CHECK(e.status == Status::singular);
            for (const double unknown : e.unknowns) CHECK(unknown == 0.0);   // held at the initial value: no numbers of this run
        }
    }
    // One unknown of the numerator is what a step shows.
    const plan::Plan plan = plan_of(drive_train_model({"q", 0}));
    const DriveTrainEstimate e = at_the_end(plan, drive_train_run(0.01, [](int) { return 0.1; }));
    CHECK(e.status == Status::ok);
    CHECK(worst(pole_errors(plan, e.unknowns)) < 0.03);
}

TEST_CASE("drive train: 1 percent of coloured noise, against least squares, over 100 seeds") {
    fmt::print("median relative pole errors at 8.1, 12.4, 27.7 rad/s over 100 seeds, 10 ms:\n");
    for (const int numerator : {0, 4}) {
        for (const std::string domain : {"q", "z"}) {
            const plan::Plan algebraic = plan_of(drive_train_model({domain, numerator}));
            const plan::Plan plain = plan_of(drive_train_model({domain, numerator, "0.01", "least_squares"}));
            std::array<std::vector<double>, 3> of_algebraic, of_plain;
            for (unsigned seed = 1; seed <= 100; ++seed) {
                DriveTrainRun run = drive_train_run(0.01);
                add_drive_train_noise(run, seed);
                const DriveTrainEstimate a = at_the_end(algebraic, run), l = at_the_end(plain, run);
                REQUIRE(a.status == Status::ok);
                REQUIRE(l.status == Status::ok);
                const std::vector<double> ea = pole_errors(algebraic, a.unknowns), el = pole_errors(plain, l.unknowns);
                for (std::size_t p = 0; p < 3; ++p) {
                    of_algebraic[p].push_back(ea[p]);
                    of_plain[p].push_back(el[p]);
                }
            }
            const std::array<double, 3> bar = {0.1, 0.03, 0.06};   // errata.md, numerator = 0, q
            fmt::print("  {}, numerator = {}: ", domain, numerator);
            for (std::size_t p = 0; p < 3; ++p) {
                const double a = median(of_algebraic[p]), l = median(of_plain[p]);
                fmt::print(" {:.3f} (least squares {:.3f}, {:.1f} times)", a, l, l / a);
                if (numerator == 0) CHECK(a < bar[p]);
                CHECK(l > 3.0 * a);   // issue 5, must-show 5
            }
            fmt::print("\n");
        }
    }
}

TEST_CASE("drive train: least squares is the plain one, without noise exact") {
    for (const std::string domain : {"q", "z"}) {
        const plan::Plan plan = plan_of(drive_train_model({domain, 4, "0.01", "least_squares"}));
        CHECK(plan.rows.size() == 1);
        CHECK(plan.samples() == 6);
        const DriveTrainEstimate e = at_the_end(plan, drive_train_run(0.01));
        REQUIRE(e.status == Status::ok);
        CHECK(worst(pole_errors(plan, e.unknowns)) < 1e-5);   // as z by the algebraic rows: one fifth difference of rounded samples
    }
}

TEST_CASE("drive train: gamma below 1, a filter of the rows, and more rows find the same poles without noise") {
    for (const std::string more : {"gamma = 0.9", "row_filter = { numerator = [0.1], denominator = [1, \"-9/10\"] }", "row_filter = { numerator = [1, 2, 1] }"}) {
        INFO(more);
        const plan::Plan plan = plan_of(drive_train_model({"q", 4, "0.01", "square", more}));
        const DriveTrainEstimate e = at_the_end(plan, drive_train_run(0.01));
        REQUIRE(e.status == Status::ok);
        CHECK(worst(pole_errors(plan, e.unknowns)) < 1e-7);
    }
}

TEST_CASE("drive train: lambda and Lambda say the same system") {
    const plan::Plan in_q = plan_of(drive_train_model({"q", 4}));
    const plan::Plan in_z = plan_of(drive_train_model({"z", 4}));
    const DriveTrainRun run = drive_train_run(0.01);
    const auto q = lab::discrete_system(in_q, at_the_end(in_q, run).unknowns);
    const auto z = lab::discrete_system(in_z, at_the_end(in_z, run).unknowns);
    REQUIRE(q);
    REQUIRE(z);
    REQUIRE(q->a.back() == 1.0);
    for (std::size_t i = 0; i < q->a.size(); ++i) CHECK(q->a[i] == Approx(z->a[i]).epsilon(1e-5));
    for (std::size_t i = 0; i < q->b.size(); ++i) CHECK(q->b[i] == Approx(z->b[i]).epsilon(3e-2));   // zeros of z lose most digits
    for (std::size_t i = 0; i < q->A.size(); ++i) CHECK(q->A[i] == Approx(z->A[i]).epsilon(1e-4));
    // The difference equation with them gives the recorded speed.
    double largest = 0.0, speed = 0.0;
    for (std::size_t k = 5; k < run.u.size(); ++k) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 5; ++i) sum += q->b[i] * run.u[k - 5 + i] - q->a[i] * run.omega[k - 5 + i];
        largest = std::max(largest, std::abs(sum - run.omega[k]));
        speed = std::max(speed, std::abs(run.omega[k]));
    }
    CHECK(largest < 1e-9 * speed);
}
