# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs that move a model until its estimates are `ok`: what is compared and measured are estimates, not the initial values that are held until then."""
import math

MEASURED = 200   # samples at the end of a run, all with full windows, that costs are of; a block of the sensorless motor
ORDINARY = 1e-4   # of smooth inputs: less than an air gap, by which models divide
LARGE = {"pmsm_electrical": 1.0, "pmsm_electrical, M = 2000": 1.0,   # their currents have to exceed their noise
         "pendulum": 1.0}   # a sine of less is its argument


def exciting(inputs, count, size=ORDINARY):
    """Smooth signals, one sample after the other."""
    def value(k, i):
        phase = (0.011 + 0.0073 * i) * k
        return size * (0.3 + math.sin(phase) + 0.3 * math.cos(2.9 * phase) + 0.05 * rough(k, i))
    return [[value(k, i) for i in range(inputs)] for k in range(count)]


def rough(k, i):
    """In [0, 1), without an order."""
    return (k * 7919 + i * 104729) % 1009 / 1009


SERVO = {"kt": 0.4, "J": 0.007, "mgl": 0.5, "Fc": 0.03, "mu": 0.05}


def servo():
    """Two swings at once; the speed comes 4 samples late, as models/servo.toml has it."""
    period, R = 5e-3, 4.02
    kt, J, mgl, Fc, mu = SERVO.values()
    swings = ((1.2, 4.1), (0.5, 11.3))   # rad, rad/s

    def q(t):
        return sum(a * math.sin(f * t) for a, f in swings)

    def w(t):
        return sum(a * f * math.cos(f * t) for a, f in swings)

    def V(t):
        acceleration = -sum(a * f * f * math.sin(f * t) for a, f in swings)
        friction = math.copysign(Fc + mu * abs(math.sin(q(t))), w(t))
        return kt * w(t) + R / kt * (J * acceleration + mgl * math.sin(q(t)) + friction)
    return [[q(k * period), w((k - 4) * period), V(k * period)] for k in range(3 * MEASURED)]


MOTOR = {"R": 2.9, "f_v": 2.4e-4, "C_r": 0.0752, "L": 10.2e-3, "K": 0.27}   # Delpoux, Bodson, Floquet 2014
POLE_PAIRS = 50


def operating_point(omega, i_d):
    """(omega, v_d, v_q, i_d, i_q) of the motor at a constant speed: models/pmsm_electrical.toml without derivatives, its torque that of friction."""
    R, f_v, C_r, L, K = MOTOR.values()
    i_q = (f_v * omega + C_r) / K
    X = POLE_PAIRS * L * omega
    return omega, R * i_d - X * i_q, R * i_q + X * i_d + K * omega, i_d, i_q


def sensorless(points=40):
    """Each operating point for one block, the frame of the command ahead of the machine's by an angle that changes; a source of 30 V. The angle is
    wrapped, as a controller's is: single precision."""
    all_points = [operating_point(omega, i_d) for omega in (*range(2, 13), *range(30, 41)) for i_d in (-3, -2, -1.5, -1, 1, 1.5, 2, 3)]
    reached = [p for p in all_points if math.hypot(p[1], p[2]) <= 30]
    rows, theta = [], 0.1
    for block in range(points):
        omega, v_d, v_q, i_d, i_q = reached[block * 17 % len(reached)]   # speeds and currents mixed
        for k in range(MEASURED):
            noise = 0.02 * (rough(len(rows), 0) - 0.5)
            phase = POLE_PAIRS * theta + 0.2 + 0.01 * block
            c, s = math.cos(phase), math.sin(phase)
            rows.append([v_d * c - v_q * s, v_d * s + v_q * c, i_d * c - i_q * s + noise, i_d * s + i_q * c - noise / 2, theta, omega])
            theta = math.fmod(theta + 1e-3 * omega, 2 * math.pi)
    return rows


def driven(name, emitted):
    """The samples that are fed to the model of this name."""
    if name == "servo":
        return servo()
    if name.startswith("pmsm_sensorless"):
        return sensorless()
    return exciting(emitted.inputs, emitted.first_ok + MEASURED, LARGE.get(name, ORDINARY))
