# SPDX-License-Identifier: GPL-3.0-or-later
"""replay of recordings in which nothing moves but noise: declared noise makes the estimator singular, undeclared noise makes replay say so."""
import random
import unittest

from command_line import CommandLine
from environment import SOURCE

RL = (SOURCE / "models/rl_circuit.toml").read_text()
NOISY = RL.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 0.01 }')
ROBUST = 'solve = "robust"\nsolve_window = 0.02'
SAID = "nothing moves but noise"


def recording(volts, noise=0.01, samples=1500):
    """An RL circuit of 3 ohm and 9 mH, Euler's method: what is asked here needs no digits."""
    random.seed(3)
    i, rows = 4.0, ["t [s],v [V],i [A]"]
    for k in range(samples):
        v = volts(k)
        rows.append(f"{k * 1e-4:.4f},{v!r},{i + noise * random.gauss(0, 1)!r}")
        i += 1e-4 * (v - 3.0 * i) / 9e-3
    return "\n".join(rows) + "\n"


class Standstill(CommandLine):
    def replay(self, model, text):
        self.write("m.toml", model)
        self.write("r.csv", text)
        value = self.algest_json("replay", "m.toml", "r.csv")
        _, err = self.algest("replay", "m.toml", "r.csv")
        return value["status"], err

    def test_declared_noise_makes_it_singular(self):
        for model in (NOISY, NOISY.replace('solve = "square"', ROBUST)):
            status, err = self.replay(model, recording(lambda k: 12.0))
            self.assertEqual(status["ok"], 0)
            self.assertGreater(status["singular"], 1000)
            self.assertNotIn(SAID, err)   # the status does
            self.assertIn("no window tells all unknowns apart", err)
            status, err = self.replay(model, recording(lambda k: 12.0 + 6.0 * (k // 40 % 2)))
            self.assertGreater(status["ok"], 600)
            self.assertNotIn(SAID, err)
            self.assertNotIn("no window tells", err)

    def test_undeclared_noise_is_said(self):
        for model in (RL, RL.replace('solve = "square"', ROBUST), RL.replace('solve = "square"', 'solve = "least_squares"')):
            status, err = self.replay(model, recording(lambda k: 12.0))
            self.assertGreater(status["ok"], 0)
            self.assertIn(f"note: {SAID}: i scatters about a constant, all else is constant", err)

    def test_several_recordings_say_what_one_says(self):
        self.write("m.toml", RL)
        self.write("moves.csv", recording(lambda k: 12.0 + 6.0 * (k // 40 % 2)))
        self.write("rests.csv", recording(lambda k: 12.0))
        _, err = self.algest("replay", "m.toml", "moves.csv", "rests.csv")
        self.assertIn(f"rests.csv: note: {SAID}", err)
        self.assertNotIn("moves.csv: note", err)
        self.write("m.toml", NOISY)
        _, err = self.algest("replay", "m.toml", "moves.csv", "rests.csv")
        self.assertIn("rests.csv: note: no window tells all unknowns apart; what this recording does not excite is said by: algest design m.toml rests.csv", err)

    def test_rest_behind_the_last_estimate_is_said(self):
        """It moves for a tenth of a second, then rests: what the summary shows at last is made of noise."""
        _, err = self.replay(RL, recording(lambda k: 12.0 + 6.0 * (k // 40 % 2) if k < 1000 else 12.0))
        self.assertIn(f"behind the last estimate, from 0.1299 to 0.1499 s: {SAID}", err)

    def test_what_moves_is_not_suspected(self):
        switching = random.Random(5)
        levels = [12.0 + 6.0 * switching.choice((-1, 1)) for _ in range(1500)]   # a command as white as noise, and the current that follows
        for volts in (lambda k: 12.0 + 6.0 * (k // 40 % 2), lambda k: 12.0 + 0.001 * k, lambda k: levels[k]):
            _, err = self.replay(RL, recording(volts))
            self.assertNotIn(SAID, err)


if __name__ == "__main__":
    unittest.main()
