# SPDX-License-Identifier: GPL-3.0-or-later
"""A DC motor simulated here, by a simulator of its own, with dry friction hidden or nothing."""
import math
import random

MODEL = """# my motor
name = "bench_motor"

[sampling]
period = 1e-3   # s

[signals]
u = { unit = "V", hold = "zoh" }
i = { unit = "A", noise = 0.005, initial = 0 }
w = { unit = "rad/s", noise = 0.1, initial = 0 }

[constants]
L = { value = 0.002, unit = "H" }
K = { value = 0.05, unit = "N.m/A" }

[parameters]
R = { initial = 1.2, unit = "ohm", min = 0 }
J = { initial = 3e-4, unit = "kg.m^2", min = 0 }
b = { initial = 1e-4, unit = "N.m.s/rad", min = 0 }   # bearing

[[equation]]
name = "voltage balance"
ode = "L*der(i) = u - R*i - K*w"

[[equation]]
name = "torque balance"
ode = "J*der(w) = K*i - b*w"
"""
TC = 0.01   # N.m, hidden


def recording(friction, seed, samples=5000, later=1.0):
    """Runge-Kutta with 20 steps a sample; R = 1, J = 2.5e-4, b = 2e-4; steps of voltage both ways every 0.12 s. later: the friction's factor in the last 30 percent."""
    random.seed(seed)
    R, L, K, J, b = 1.0, 0.002, 0.05, 2.5e-4, 2e-4
    i = w = u = 0.0
    lines = ["t [s],u [V],i [A],w [rad/s]"]

    def rate(i, w):
        return (u - R * i - K * w) / L, (K * i - b * w - friction * math.tanh(w / 0.02)) / J

    for k in range(samples):
        if k == 7 * samples // 10:
            friction *= later
        if k % 120 == 0:
            u = random.uniform(-8, 8)
        lines.append(f"{k * 1e-3:.3f},{u:.6f},{i + random.gauss(0, 0.005):.6f},{w + random.gauss(0, 0.1):.5f}")
        h = 1e-3 / 20
        for _ in range(20):
            a1 = rate(i, w)
            a2 = rate(i + h / 2 * a1[0], w + h / 2 * a1[1])
            a3 = rate(i + h / 2 * a2[0], w + h / 2 * a2[1])
            a4 = rate(i + h * a3[0], w + h * a3[1])
            i += h / 6 * (a1[0] + 2 * a2[0] + 2 * a3[0] + a4[0])
            w += h / 6 * (a1[1] + 2 * a2[1] + 2 * a3[1] + a4[1])
    return "\n".join(lines) + "\n"
