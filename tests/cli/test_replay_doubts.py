# SPDX-License-Identifier: GPL-3.0-or-later
"""What replay says of estimates that cannot be, and of samples that gave none."""
import random
import unittest

from command_line import CommandLine
from environment import SOURCE

RL = (SOURCE / "models/rl_circuit.toml").read_text()


def recording(reversed_from=10**9, noise=0.001, warm_from=10**9):
    """A coil of 3 ohm and 9 mH under a square wave, Euler's steps; from one sample on its current sensor is connected the wrong way round, or its
    resistance is 6 ohm."""
    random.seed(7)
    i, rows = 4.0, ["t [s],v [V],i [A]"]
    for k in range(1500):
        v = 12.0 + 6.0 * (k // 40 % 2)
        shown = i + noise * random.gauss(0, 1)
        rows.append(f"{k * 1e-4:.4f},{v!r},{-shown if k >= reversed_from else shown!r}")
        i += 1e-4 * (v - (6.0 if k >= warm_from else 3.0) * i) / 9e-3
    return "\n".join(rows) + "\n"


class ReplayDoubts(CommandLine):
    def said(self, model, text):
        self.write("m.toml", model)
        self.write("r.csv", text)
        status = self.algest_json("replay", "m.toml", "r.csv")["status"]
        return status, self.algest("replay", "m.toml", "r.csv")[1]

    def test_estimates_beyond_their_limits_are_counted(self):
        self.assertIn("min = 0", RL)
        status, err = self.said(RL, recording(reversed_from=700))
        # all windows that lie behind the change: the resistance is negative in each
        self.assertRegex(err, rf"r.csv: note: (\d+) of {status['ok']} ok estimates of R lie beyond its min or max")
        _, err = self.said(RL, recording())
        self.assertNotIn("lie beyond", err)
        _, err = self.said(RL.replace(", min = 0", ""), recording(reversed_from=700))   # no limit, no doubt
        self.assertNotIn("lie beyond", err)

    def test_why_samples_are_singular(self):
        def note(err):
            return next((line for line in err.splitlines() if "samples are singular" in line), None)
        status, err = self.said(RL + "condition_limit = 1.01\n", recording())
        self.assertGreater(status["singular"], 1000)
        self.assertIn(f"{status['singular']} samples are singular: {status['singular']} by a condition above condition_limit = 1.01", note(err))
        noisy = RL.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 0.001 }')
        status, err = self.said(noisy + "deviation_limit = 1e-6\n", recording())
        self.assertIn(f"{status['singular']} samples are singular: {status['singular']} by noise", note(err))
        still = "\n".join(["t [s],v [V],i [A]", *(f"{k * 1e-4:.4f},0,0" for k in range(1500))]) + "\n"
        status, err = self.said(RL, still)
        self.assertIn(f"{status['singular']} samples are singular: {status['singular']} since rows depend on each other", note(err))
        _, err = self.said(RL, recording())
        self.assertIsNone(note(err))

    def test_what_the_model_misses_shows_in_the_scatter(self):
        """Declared noise of 1 mA, and it is that: estimates of the right model scatter by about one deviation, and nothing is said. A resistance that
        doubles half way is a step of 3 ohm, hundreds of deviations."""
        noisy = RL.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 0.001 }')
        _, err = self.said(noisy, recording())
        self.assertNotIn("scatter", err)
        _, err = self.said(noisy, recording(warm_from=700))
        self.assertRegex(err, r"r.csv: note: estimates scatter over the recording by more than their standard deviations: R by [1-9]\d{2,}, ")
        _, err = self.said(RL, recording(warm_from=700))   # no noise declared: no deviations
        self.assertNotIn("scatter", err)

    def test_what_is_hardly_told_from_zero(self):
        """A coil whose current is measured with 0.9 A of noise: one of R and L has no digit, and deviation_limit lets it pass."""
        noisy = RL.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 0.9 }') + "deviation_limit = 100\n"
        status, err = self.said(noisy, recording(noise=0.9))
        self.assertGreater(status["ok"], 0)
        self.assertRegex(err, r"the last estimate of [RL] is \S+ with a standard deviation of \S+: not even its sign is known")
        _, err = self.said(noisy.replace("0.9", "0.001"), recording())
        self.assertNotIn("sign is known", err)

    def test_a_last_estimate_that_stands_apart(self):
        """The resistance doubles for the last sixth: a median cannot see it, and a controller would take it."""
        noisy = RL.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 0.001 }')
        _, err = self.said(noisy, recording(warm_from=1250))
        self.assertRegex(err, r"r.csv: note: the last estimate of R, (5\.9|6)\S*, lies \d{3,} of its standard deviations from the median of all, (2\.99|3)")
        self.assertNotIn("estimates scatter", err)
        notes = self.algest_json("replay", "m.toml", "r.csv")["notes"]
        self.assertTrue(any(n.startswith("the last estimate of R") for n in notes), notes)
        _, err = self.said(noisy, recording())
        self.assertNotIn("of its standard deviations from the median", err)

    def test_noise_that_nobody_declares(self):
        """One ampere of noise on three to six: windows of 20 ms see a current that nothing drives."""
        _, err = self.said(RL, recording(noise=1.0))
        self.assertRegex(err, r"r.csv: note: \d+ of \d+ ok estimates of L lie more than half off their median, .*: no signal declares its noise")
        _, err = self.said(RL, recording())
        self.assertNotIn("declares its noise", err)


if __name__ == "__main__":
    unittest.main()
