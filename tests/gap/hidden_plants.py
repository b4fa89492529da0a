# SPDX-License-Identifier: GPL-3.0-or-later
"""Machines simulated here, by a simulator of its own, each with one effect that its model file leaves out. Commands are held from sample
to sample; models are written as people write them, and ask for an estimator by least squares."""
import math
import random


def runge_kutta(rate, state, h):
    """One step of the classical method."""
    def moved(slope, part):
        return [x + part * s for x, s in zip(state, slope)]
    a = rate(state)
    b = rate(moved(a, h / 2))
    c = rate(moved(b, h / 2))
    d = rate(moved(c, h))
    return [x + h / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(state, a, b, c, d)]


def run(rate, state, command, measure, header, samples, steps=10, period=1e-3):
    """CSV text: rate(state, u), command(k) or None to keep the last, measure(state) with its noise."""
    lines = [header]
    u = 0.0
    for k in range(samples):
        new = command(k)
        u = u if new is None else new
        lines.append(",".join([f"{k * period:.3f}", f"{u:.6f}"] + [f"{m:.7f}" for m in measure(state)]))
        for _ in range(steps):
            state = runge_kutta(lambda s: rate(s, u), state, period / steps)
    return "\n".join(lines) + "\n"


def motor(name, voltage_offset=0.0, friction=0.0, seed=1):
    """R = 1, L = 0.002, K = 0.05, J = 2.5e-4, b = 2e-4; steps of voltage both ways every 0.12 s."""
    dice = random.Random(seed)
    R, L, K, J, b = 1.0, 0.002, 0.05, 2.5e-4, 2e-4

    def rate(s, u):
        return [(u + voltage_offset - R * s[0] - K * s[1]) / L, (K * s[0] - b * s[1] - friction * math.tanh(s[1] / 0.02)) / J]

    text = run(rate, [0.0, 0.0], lambda k: dice.uniform(-8, 8) if k % 120 == 0 else None,
               lambda s: (s[0] + dice.gauss(0, 0.005), s[1] + dice.gauss(0, 0.1)), "t [s],u [V],i [A],w [rad/s]", 5000, steps=20)
    return MOTOR.format(name=name), text


MOTOR = """\
# The motor of the test bench.   (A comment that must stay.)
format = 1
name    = "{name}"      # an odd   gap that must stay too

[sampling]
period = 1e-3           # s
window = 0.03

[signals]
u = {{ unit = "V", hold = "zoh" }}
i = {{ unit = "A", noise = 0.005, initial = 0 }}
w = {{ unit = "rad/s", noise = 0.1, initial = 0 }}     # encoder

[constants]
L = {{ value = 0.002, unit = "H" }}
K = {{ value = 0.05, unit = "N.m/A" }}

[parameters]
R = {{ initial = 1.2, unit = "ohm", min = 0 }}
J = {{ initial = 3e-4, unit = "kg.m^2", min = 0 }}
b = {{ initial = 1e-4, unit = "N.m.s/rad", min = 0 }}   # bearing

[[equation]]
name = "voltage balance"
ode = "L*der(i) = u - R*i - K*w"   # copper, back EMF
[[equation]]
name = "torque balance"
ode = "J*der(w) = K*i - b*w"

[estimator]
solve = "least_squares"
"""


def spring(name, cubic=0.0, seed=1):
    """m = 1, d = 4, k = 400: 20 rad/s, a tenth of critical damping; steps of force both ways every 0.15 s."""
    dice = random.Random(seed)

    def rate(s, F):
        return [s[1], F - 4.0 * s[1] - 400.0 * s[0] - cubic * s[0] ** 3]

    text = run(rate, [0.0, 0.0], lambda k: dice.uniform(-25, 25) if k % 150 == 0 else None,
               lambda s: (s[0] + dice.gauss(0, 2e-5),), "t [s],F [N],x [m]", 6000)
    return SPRING.format(name=name), text


# Written on Windows, as Notepad leaves it; the parameters stand in a table of their own each.
SPRING = """\
name = "{name}"
[sampling]
period = 1e-3
window = 0.1
[signals]
F = {{ unit = "N", hold = "zoh" }}
x = {{ unit = "m", noise = 2e-5 }}
[parameters]
m = {{ unit = "kg", initial = 1.2, min = 0 }} # moving part
d = {{ unit = "N.s/m", initial = 3, min = 0 }}
k = {{ unit = "N/m", initial = 350, min = 0 }}
[[equation]]
name = "force balance"
ode = "m*der(x,2) = F - d*der(x) - k*x"
[estimator]
solve = "least_squares"
""".replace("\n", "\r\n")
