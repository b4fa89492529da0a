# SPDX-License-Identifier: GPL-3.0-or-later
"""Machines of paper 001 simulated with Runge and Kutta's method, as CSV files; and `algest replay` on them."""
import json
import subprocess

from environment import ALGEST


def runge_kutta(slope, x, h):
    """x after a step h."""
    def moved(by, k):
        return [a + by * b for a, b in zip(x, k)]
    k1 = slope(x)
    k2 = slope(moved(h / 2, k1))
    k3 = slope(moved(h / 2, k2))
    k4 = slope(moved(h, k3))
    return [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(x, k1, k2, k3, k4)]


PUMP = {"L_a": 3e-4, "J_m": 1e-4, "C_0": 1e-7, "R_a": 3.5, "K_m": 0.5, "b_m": 0.0019099, "K_p": 8e-6, "alpha_p": 1e-4}
VOLTAGE, FLOW = 400.0, -1.8e-3


def pump_slope(x):
    current, speed, pressure = x
    p = PUMP
    return [(VOLTAGE - p["R_a"] * current - p["K_m"] * speed) / p["L_a"],
            (p["K_m"] * current - p["b_m"] * speed - p["K_p"] * pressure) / p["J_m"],
            (p["K_p"] * speed - p["alpha_p"] * pressure + FLOW) / p["C_0"]]


def pump(instants):
    """States at the instants (increasing, from rest at 0), each step of at most 1.25 us: then the error of a step is below 1e-12."""
    x, t, out = [0.0, 0.0, 0.0], 0.0, []
    for instant in instants:
        steps = max(1, round((instant - t) / 1.25e-6))
        if instant > t:
            for _ in range(steps):
                x = runge_kutta(pump_slope, x, (instant - t) / steps)
        t = instant
        out.append(x)
    return out


def write_pump(path, instants):
    with open(path, "w", encoding="utf-8") as file:
        file.write("t [s],I_a [A],omega [rad/s],P_0 [Pa],V_a [V],Q_0 [m^3/s]\n")
        for t, x in zip(instants, pump(instants)):
            file.write(f"{t!r},{x[0]!r},{x[1]!r},{x[2]!r},{VOLTAGE},{FLOW}\n")


def replay(*words):
    """(exit code, JSON, complaints)"""
    result = subprocess.run([str(w) for w in (ALGEST, "replay", *words, "--json")], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    return result.returncode, json.loads(result.stdout), result.stderr


def values(answer, key):
    return {p["name"]: p[key] for p in answer["parameters"]}
