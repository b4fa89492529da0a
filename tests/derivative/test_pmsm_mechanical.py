# SPDX-License-Identifier: GPL-3.0-or-later
"""001, section 4, with the actual values of table 2 (the paper leaves pole pairs, gains and load out: these are sensible ones) and a Coulomb friction
that can be seen. What the hold of the voltages is worth."""
import math
import tempfile
import unittest
from pathlib import Path

from environment import SOURCE
from recordings import replay, runge_kutta, values

MODEL = SOURCE / "models/pmsm_mechanical.toml"
TRUE = {"L_se": 2.84e-5, "R_s": 0.02, "K_q": 0.95, "J_m": 0.1184, "b_m": 1e-3, "b_c": 0.5, "b_mq": 1e-4}
PERIOD, POLES = 5e-5, 4


def simulate(samples=12001):
    """Rows t, V_d, V_q, I_d, I_q, omega, tau_e: speed steps up, down and back under a sinusoidal load, voltages held over a period."""
    inductance, resistance = POLES * TRUE["L_se"], POLES * TRUE["R_s"]
    x, speed_sum, d_sum, q_sum, rows = [0.0, 0.0, 0.0], 0.0, 0.0, 0.0, []
    for k in range(samples):
        t = k * PERIOD
        d, q, speed = x
        wanted = 40.0 if t < 0.2 else -30.0 if t < 0.42 else 15.0
        error = wanted - speed
        torque = max(-60.0, min(60.0, 12.0 * error + speed_sum))
        if abs(torque) < 60.0:
            speed_sum += 150.0 * error * PERIOD
        d_wanted, q_wanted = 5.0 * math.sin(2 * math.pi * 9 * t), torque / TRUE["K_q"]   # a direct current makes the resistance visible
        d_sum += 40.0 * (d_wanted - d) * PERIOD
        q_sum += 40.0 * (q_wanted - q) * PERIOD
        v_d = 0.3 * (d_wanted - d) + d_sum - POLES * inductance * speed * q
        v_q = 0.3 * (q_wanted - q) + q_sum + POLES * inductance * speed * d + TRUE["K_q"] * speed
        load = 8.0 * math.sin(2 * math.pi * 3 * t)
        rows.append([t, v_d, v_q, d, q, speed, load])

        def slope(y, v_d=v_d, v_q=v_q, t=t):
            d, q, speed = y
            sign = math.copysign(1.0, speed) if speed else 0.0
            friction = TRUE["b_m"] * speed + TRUE["b_c"] * sign + TRUE["b_mq"] * sign * speed ** 2
            return [(v_d - resistance * d + POLES * inductance * speed * q) / inductance,
                    (v_q - resistance * q - POLES * inductance * speed * d - TRUE["K_q"] * speed) / inductance,
                    (TRUE["K_q"] * q - friction - load) / TRUE["J_m"]]
        for _ in range(2):   # L/R is 28 periods: a step of half a period is exact to 1e-9
            x = runge_kutta(slope, x, PERIOD / 2)
    return rows


class PmsmMechanical(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows = simulate()

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.recording = self.folder / "run.csv"
        with open(self.recording, "w", encoding="utf-8") as file:
            file.write("t [s],V_d [V],V_q [V],I_d [A],I_q [A],omega [rad/s],tau_e [N.m]\n")
            for row in self.rows:
                file.write(",".join([repr(round(row[0], 9))] + [repr(x) for x in row[1:]]) + "\n")

    def worst(self, model, names):
        code, answer, said = replay(model, self.recording, "--batch")
        self.assertEqual(code, 0, said)
        found = values(answer, "value")
        return max(abs(found[name] / TRUE[name] - 1) for name in names)

    def test_all_seven_parameters(self):
        self.assertLess(self.worst(MODEL, ("L_se", "R_s", "K_q", "J_m")), 5e-3)
        self.assertLess(self.worst(MODEL, ("b_m", "b_c", "b_mq")), 5e-2)

    def test_the_hold_of_the_voltages(self):
        linear = self.folder / "linear.toml"
        linear.write_text(MODEL.read_text().replace(', hold = "zoh"', ""))
        # Half a sample of the voltages mixes L into R and back. What L keeps is the filter's error where the currents jump.
        for name, gain in (("R_s", 10), ("L_se", 2)):
            self.assertLess(self.worst(MODEL, (name,)), self.worst(linear, (name,)) / gain)


if __name__ == "__main__":
    unittest.main()
