// SPDX-License-Identifier: GPL-3.0-or-later
// The estimators of generated/, all behind one interface: samples and answers as arrays.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "generated/dc_motor/dc_motor.hpp"
#include "generated/drive_train/drive_train.hpp"
#include "generated/drive_train_zeros/drive_train_zeros.hpp"
#include "generated/magnetic_bearing/magnetic_bearing.hpp"
#include "generated/motor_pump/motor_pump.hpp"
#include "generated/pendulum/pendulum.hpp"
#include "generated/pmsm_electrical/pmsm_electrical.hpp"
#include "generated/pmsm_inertia/pmsm_inertia.hpp"
#include "generated/pmsm_mechanical/pmsm_mechanical.hpp"
#include "generated/pmsm_sensorless/pmsm_sensorless.hpp"
#include "generated/pmsm_sensorless_voltage/pmsm_sensorless_voltage.hpp"
#include "generated/positioning_axis/positioning_axis.hpp"
#include "generated/rl_circuit/rl_circuit.hpp"
#include "generated/servo/servo.hpp"

#define ALGEST_COMMITTED                                                                                                   \
    algest::generated::DcMotor, algest::generated::DriveTrain, algest::generated::DriveTrainZeros,                         \
        algest::generated::MagneticBearing, algest::generated::MotorPump, algest::generated::Pendulum,                     \
        algest::generated::PmsmElectrical, algest::generated::PmsmInertia, algest::generated::PmsmMechanical,              \
        algest::generated::PositioningAxis, algest::generated::RlCircuit, algest::generated::Servo

/// Those that answer operating points alone.
#define ALGEST_COMMITTED_AVERAGES algest::generated::PmsmSensorless, algest::generated::PmsmSensorlessVoltage

namespace algest::test {

/// The name of the model: that of the files in models/ and generated/.
template <class Class>
constexpr const char* model = nullptr;
template <>
inline constexpr const char* model<generated::DcMotor> = "dc_motor";
template <>
inline constexpr const char* model<generated::DriveTrain> = "drive_train";
template <>
inline constexpr const char* model<generated::DriveTrainZeros> = "drive_train_zeros";
template <>
inline constexpr const char* model<generated::MagneticBearing> = "magnetic_bearing";
template <>
inline constexpr const char* model<generated::MotorPump> = "motor_pump";
template <>
inline constexpr const char* model<generated::Pendulum> = "pendulum";
template <>
inline constexpr const char* model<generated::PmsmElectrical> = "pmsm_electrical";
template <>
inline constexpr const char* model<generated::PmsmInertia> = "pmsm_inertia";
template <>
inline constexpr const char* model<generated::PmsmMechanical> = "pmsm_mechanical";
template <>
inline constexpr const char* model<generated::PmsmSensorless> = "pmsm_sensorless";
template <>
inline constexpr const char* model<generated::PmsmSensorlessVoltage> = "pmsm_sensorless_voltage";
template <>
inline constexpr const char* model<generated::PositioningAxis> = "positioning_axis";
template <>
inline constexpr const char* model<generated::RlCircuit> = "rl_circuit";
template <>
inline constexpr const char* model<generated::Servo> = "servo";

/// Sample is an array of inputs, Estimate a status, a condition and the parameters: the generated structs promise no more.
template <class Class>
constexpr std::size_t inputs = sizeof(typename Class::Sample) / sizeof(typename Class::Scalar);
template <class Class>
constexpr std::size_t parameters = sizeof(typename Class::Estimate) / sizeof(typename Class::Scalar) - 2;

/// True where the model declares noise.
template <class Class>
constexpr bool uncertain = requires(Class& c) { c.uncertainty(); };

template <class Class>
using Inputs = std::array<typename Class::Scalar, inputs<Class>>;

template <class Class>
typename Class::Sample sample(const Inputs<Class>& values) {
    typename Class::Sample out;
    static_assert(sizeof out == sizeof values);
    std::memcpy(&out, values.data(), sizeof out);
    return out;
}

template <class Class>
struct Answer {
    Status status;
    typename Class::Scalar condition;
    std::array<typename Class::Scalar, parameters<Class>> values;

    explicit Answer(const typename Class::Estimate& e) : status(e.status), condition(e.condition) {
        std::memcpy(values.data(), reinterpret_cast<const char*>(&e) + 2 * sizeof condition, sizeof values);
    }
    bool same_bits(const Answer& o) const {
        return status == o.status && std::memcmp(&condition, &o.condition, sizeof condition) == 0 &&
               std::memcmp(values.data(), o.values.data(), sizeof values) == 0;
    }
};

/// What inputs move about, and by how much: positive, of the size of an air gap in metres; the servo has to turn, and to turn back; the currents of
/// the PMSM have to exceed their noise.
template <class Class>
constexpr double middle = 2e-3;
template <>
inline constexpr double middle<generated::Servo> = 0.0;
template <>
inline constexpr double middle<generated::PmsmElectrical> = 2.0;
template <class Class>
constexpr double size = 1e-3;
template <>
inline constexpr double size<generated::PmsmElectrical> = 1.0;
template <>
inline constexpr double size<generated::Servo> = 1.0;

/// Inputs without an end that excite every model, smooth.
template <class Class>
Inputs<Class> exciting(int k, int stream = 0) {
    Inputs<Class> out;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double phase = (0.011 + 0.0073 * static_cast<double>(i) + 0.0011 * stream) * k;
        const double rough = static_cast<double>((k * 7919 + static_cast<int>(i) * 104729 + stream * 31) % 1009) / 1009.0;
        out[i] = static_cast<typename Class::Scalar>(
            middle<Class> + size<Class> * (std::sin(phase) + 0.3 * std::cos(2.9 * phase + 0.4 * stream) + 0.05 * rough));
    }
    return out;
}

}  // namespace algest::test
