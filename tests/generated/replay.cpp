// SPDX-License-Identifier: GPL-3.0-or-later
// Must-show 8 of the first issue: replay and the compiled estimator agree to the last bit, on recordings of real machines where
// they are at hand and always on simulated ones.
#include "lab/replay.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <memory>

#include "generator/generate.hpp"
#include "lab/recording.hpp"
#include "tests/generated/committed.hpp"
#include "tests/plants/drive_train.hpp"
#include "tests/plants/pendulum.hpp"
#include "tests/plants/pmsm.hpp"
#include "tests/plants/positioning_axis.hpp"

using namespace algest;
using namespace algest::test;

namespace {

/// A recording as if it had been read.
lab::Recording recording(double period, const std::vector<std::pair<std::string, std::string>>& names,
                         const std::vector<std::vector<double>>& rows) {
    lab::Recording out{};
    out.file = "simulated";
    out.time_place = 1;
    out.period = period;
    for (const auto& [name, unit] : names) out.columns.push_back({name, unit, 1, {}});
    for (std::size_t k = 0; k < rows.size(); ++k) {
        out.t.push_back(static_cast<double>(k) * period);
        for (std::size_t c = 0; c < names.size(); ++c) out.columns[c].values.push_back(rows[k][c]);
    }
    out.columns.push_back({"t", "s", 1, out.t});
    return out;
}

template <class Class>
void agree(const lab::Recording& recording) {
    Diagnostics diagnostics;
    const auto plan =
        generator::plan_from_model(std::string(ALGEST_SOURCE "/models/") + model<Class> + ".toml", {}, diagnostics);
    REQUIRE(plan);
    const auto replay = lab::replay(*plan, recording, {}, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(replay);
    REQUIRE(replay->samples() == recording.samples());

    std::vector<std::vector<double>> columns;
    for (const plan::Input& input : plan->inputs) columns.push_back(recording.column(input.column)->values);
    lab::Replay with_deviations = *replay;
    lab::add_deviations(*plan, recording, 20, with_deviations);
    CHECK(with_deviations.deviations.empty() == !plan->uncertain());
    const auto estimator = std::make_unique<Class>();
    std::size_t ok = 0, different = 0, deviations = 0;
    for (std::size_t k = 0; k < recording.samples(); ++k) {
        Inputs<Class> in;
        for (std::size_t i = 0; i < in.size(); ++i) in[i] = columns[i][k];
        const Answer<Class> found(estimator->step(sample<Class>(in)));
        ok += found.status == Status::ok ? 1U : 0U;
        const bool same =
            found.status == replay->status[k] &&
            std::memcmp(&found.condition, &replay->condition[k], sizeof found.condition) == 0 &&
            std::memcmp(found.values.data(), replay->parameters.data() + k * found.values.size(), sizeof found.values) == 0;
        different += same ? 0U : 1U;
        if constexpr (uncertain<Class>) {
            if (!std::isfinite(with_deviations.deviation(k, 0))) continue;
            ++deviations;
            const auto u = estimator->uncertainty();
            CHECK(u.status == Status::ok);
            CHECK(std::memcmp(&u.sd, with_deviations.deviations.data() + k * with_deviations.parameter_count, sizeof u.sd) == 0);
        }
    }
    if (plan->uncertain()) {
        CHECK(deviations >= 15);
        CHECK(lab::summarise(with_deviations).deviation[0].has_value());
        CHECK(lab::replay_csv(*plan, with_deviations).find(",sd(" + plan->parameters[0].name + ") [" + plan->parameters[0].unit + "]") != std::string::npos);
    }
    INFO(recording.file << ": " << ok << " of " << recording.samples() << " samples ok");
    CHECK(different == 0);
    CHECK(ok > recording.samples() / 2);
}

template <class Class>
void agree_on(const char* file) {
    const std::string path = std::string(ALGEST_SHARED "/recordings/") + file;
    if (!std::filesystem::exists(path)) {
        WARN("skipped: there is no " << path);
        return;
    }
    Diagnostics diagnostics;
    const auto read = lab::read_recording(path, diagnostics);
    REQUIRE(read);
    agree<Class>(*read);
}

}  // namespace

TEST_CASE("replay and the compiled estimator agree to the last bit on simulated recordings") {
    std::vector<std::vector<double>> rows;
    for (const plants::AxisSample& s : plants::simulate(plants::PositioningAxis{}, 6000)) rows.push_back({s.q, s.force});
    agree<generated::PositioningAxis>(recording(1e-3, {{"qm", "m"}, {"force", "N"}}, rows));

    rows.clear();
    for (const double angle : plants::simulate(plants::Pendulum{}, 3000)) rows.push_back({angle});
    agree<generated::Pendulum>(recording(1e-3, {{"theta", "rad"}}, rows));

    rows.clear();
    plants::DriveTrainRun drive = plants::drive_train_run(0.01);
    for (int second = 0; second < 2; ++second) {   // long enough to move the window on
        plants::add_drive_train_noise(drive, 7);
        for (std::size_t k = 0; k < drive.u.size(); ++k) rows.push_back({drive.u[k], drive.omega[k]});
    }
    agree<generated::DriveTrain>(recording(0.01, {{"u", "V"}, {"omega", "rad/s"}}, rows));
    agree<generated::DriveTrainZeros>(recording(0.01, {{"u", "V"}, {"omega", "rad/s"}}, rows));

    rows.clear();
    for (int k = 0; k < 2000; ++k) {   // any signals do: agreement is about bits
        const Inputs<generated::MotorPump> in = exciting<generated::MotorPump>(k);
        rows.emplace_back(in.begin(), in.end());
    }
    agree<generated::MotorPump>(recording(5e-6, {{"I_a", "A"}, {"omega", "rad/s"}, {"P_0", "Pa"}, {"V_a", "V"}, {"Q_0", "m^3/s"}}, rows));

    rows.clear();
    for (int k = 0; k < 2000; ++k) {
        const Inputs<generated::PmsmMechanical> in = exciting<generated::PmsmMechanical>(k);
        rows.emplace_back(in.begin(), in.end());
    }
    agree<generated::PmsmMechanical>(
        recording(5e-5, {{"V_d", "V"}, {"V_q", "V"}, {"I_d", "A"}, {"I_q", "A"}, {"omega", "rad/s"}, {"tau_e", "N.m"}}, rows));

    rows.clear();
    plants::Pmsm motor;
    motor.period = 1e-3;
    motor.current_noise = 0.03;
    for (const plants::PmsmSample& s : plants::simulate(motor, 2000)) rows.push_back({s.v_d, s.v_q, s.i_d, s.i_q, s.omega});
    agree<generated::PmsmElectrical>(
        recording(1e-3, {{"v_d", "V"}, {"v_q", "V"}, {"i_d", "A"}, {"i_q", "A"}, {"omega", "rad/s"}}, rows));
}

TEST_CASE("replay and the compiled estimator agree to the last bit on recordings of real machines") {
    agree_on<generated::PositioningAxis>("emps.csv");
    agree_on<generated::Pendulum>("single_pendulum.csv");
    agree_on<generated::Servo>("servo_sin_time_square.csv");
    agree_on<generated::Servo>("servo_sin_sin.csv");
}
