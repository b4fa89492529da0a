# SPDX-License-Identifier: GPL-3.0-or-later
"""What single precision costs: `generate` says which parameters, and replay in both precisions bears the figure out."""
import csv
import math
import re
import unittest

from command_line import CommandLine
from environment import SOURCE

STEP = 1e-3
CART = """format = 1
name = "cart"
[sampling]
period = 1e-3
window = 1
[signals]
x = { unit = "m" }
u = { unit = "V", hold = "zoh" }
[parameters]
damping = { unit = "1/s" }
stiffness = { unit = "1/s^2" }
gain = { unit = "m/(V.s^3)" }
[[equation]]
name = "force"
ode = "der(x,3) + damping*der(x,2) + stiffness*der(x) = gain*u"
[estimator]
solve = "SOLVE"
"""


def recording():
    """A third-order cart (3, 40, 10) under a held square wave and sine; Runge and Kutta's steps of half a period are right to 1e-12."""
    def slope(x, u):
        return [x[1], x[2], -3.0 * x[2] - 40.0 * x[1] + 10.0 * u]

    x, lines = [0.3, 0.5, 0.2], ["t [s],x [m],u [V]"]
    for k in range(3000):
        u = math.copysign(1.0, math.sin(2 * math.pi * k * STEP + 1.0)) + 0.5 * math.sin(5.4 * math.pi * k * STEP)
        lines.append(f"{k * STEP:.3f},{x[0]!r},{u!r}")
        for _ in range(2):
            h = STEP / 2
            k1 = slope(x, u)
            k2 = slope([a + h / 2 * b for a, b in zip(x, k1)], u)
            k3 = slope([a + h / 2 * b for a, b in zip(x, k2)], u)
            k4 = slope([a + h * b for a, b in zip(x, k3)], u)
            x = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(x, k1, k2, k3, k4)]
    return "\n".join(lines) + "\n"


class SinglePrecision(CommandLine):
    def notes(self, model):
        _, err = self.algest("generate", model, "-o", self.folder / "out", "--scalar", "float")
        return [line for line in err.splitlines() if "note: single precision" in line]

    def estimates(self, scalar):
        self.algest("replay", "cart.toml", "r.csv", "--scalar", scalar, "-o", f"{scalar}.csv")
        text = (self.folder / f"{scalar}.csv").read_text()
        return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))

    def test_who_is_warned(self):
        (note,) = self.notes(SOURCE / "models/dc_motor.toml")
        self.assertIn("'transfer' (n + kappa = 3)", note)
        self.assertIn("moves 'a1', 'a2', 'b0' by up to about condition * ", note)
        self.assertIn("4 % at the condition limit 8400", note)
        (note,) = self.notes(SOURCE / "models/magnetic_bearing.toml")   # the kernels of order 2 with a constant force are those of order 3
        self.assertIn("moves 'lambda1', 'lambda2', 'lambda3' by up to about condition^2 * ", note)
        for model in ("pmsm_electrical", "rl_circuit", "pendulum"):   # n + kappa up to 2
            self.assertEqual(self.notes(SOURCE / f"models/{model}.toml"), [])

    def test_the_figure_is_what_replay_finds(self):
        """99 of 100 samples lie below the figure, whichever the parameter; and no parameter would do with a figure a hundred times smaller."""
        self.write("r.csv", recording())
        for solver, power in (("square", 1), ("robust", 2)):
            self.write("cart.toml", CART.replace("SOLVE", solver))
            (note,) = self.notes("cart.toml")
            figure = float(re.search(r"condition(?:\^2)? \* ([-+.e0-9]+),", note)[1])
            pairs = [(d, f) for d, f in zip(self.estimates("double"), self.estimates("float")) if d["status"] == f["status"] == "ok"]
            self.assertGreater(len(pairs), 500)
            worst = []
            for name in ("damping [1/s]", "stiffness [1/s^2]", "gain [m/(V.s^3)]"):
                ratios = sorted(abs(float(f[name]) / float(d[name]) - 1) / float(d["condition"]) ** power / figure for d, f in pairs)
                worst.append(ratios[len(ratios) * 99 // 100])
            self.assertLess(max(worst), 1)
            self.assertGreater(max(worst), 0.01)   # two digits more than this are no figure to choose a scalar by


if __name__ == "__main__":
    unittest.main()
