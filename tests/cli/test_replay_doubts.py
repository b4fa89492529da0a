# SPDX-License-Identifier: GPL-3.0-or-later
"""What replay says of estimates that cannot be, and of samples that gave none."""
import math
import random
import re
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


    def test_a_sensor_that_is_stuck(self):
        """From 0.07 to 0.11 s the current stands at one value, twice a window of 20 ms, while the voltage goes on."""
        lines = recording().splitlines()
        for k in range(700, 1100):
            lines[1 + k] = ",".join([*lines[1 + k].split(",")[:2], lines[700].split(",")[2]])
        status, err = self.said(RL, "\n".join(lines) + "\n")
        self.assertRegex(err, r"r.csv: note: i stands at \S+ from 0\.0699 to 0\.1099 s while v moves: its sensor is stuck")
        _, err = self.said(RL, recording())
        self.assertNotIn("stands at", err)
        coarse = [line if k == 0 else ",".join([*line.split(",")[:2], f"{round(float(line.split(',')[2]) * 2) / 2}"]) for k, line in enumerate(recording().splitlines())]   # steps of 0.5 A
        _, err = self.said(RL, "\n".join(coarse) + "\n")
        self.assertNotIn("stands at", err)


MOTOR = """\
format = 1
name = "motor"
[sampling]
period = 1e-3
window = 0.1
[signals]
u = { unit = "V", hold = "zoh" }
i = { unit = "A", noise = 0.01 }
w = { unit = "rad/s", noise = 0.2 }
[constants]
K = { value = 0.06, unit = "N.m/A" }
L = { value = 0.002, unit = "H" }
[parameters]
R = { unit = "ohm", initial = 1, min = 0 }
J = { unit = "kg.m^2", initial = 2e-4, min = 0 }
b = { unit = "N.m.s/rad", initial = 1e-4, min = 0 }
[[equation]]
name = "voltage"
ode = "L*der(i) = u - R*i - K*w"
[[equation]]
name = "torque"
ode = "J*der(w) = K*i - b*w"
[estimator]
solve = "least_squares"
"""
ANGLE = MOTOR.replace("[constants]", 'th = { unit = "rad", noise = 1e-3 }\n[constants]').replace("[estimator]", '[[equation]]\node = "der(th) = w"\n[estimator]')


def drive(R=1.0, J=2.4e-4, b=2e-4, K=0.06, L=0.002, seconds=6.0, changed_from=10**9):
    """u, i, w, th of the motor at 1 kHz without noise: steps of the voltage, twenty Euler steps a sample. The friction is five times as large from one sample on."""
    random.seed(3)
    u = i = w = th = 0.0
    out = []
    for k in range(int(seconds * 1000)):
        if k % 150 == 0:
            u = random.uniform(-12, 12)
        out.append((u, i, w, th))
        for _ in range(20):
            i, w, th = i + 5e-5 * (u - R * i - K * w) / L, w + 5e-5 * (K * i - (5 * b if k >= changed_from else b) * w) / J, th + 5e-5 * w
    return out


def seen(rows):
    """The same with the sensors' noise."""
    random.seed(4)
    return "t [s],u [V],i [A],w [rad/s],th [rad]\n" + "".join(f"{k / 1000:.3f},{u!r},{i + 0.01 * random.gauss(0, 1):.5f},{w + 0.2 * random.gauss(0, 1):.4f},{th + 1e-3 * random.gauss(0, 1):.5f}\n"
                                                             for k, (u, i, w, th) in enumerate(rows))


class FreeRun(CommandLine):
    """What only the run of the whole machine shows: estimates that agree with each other and are wrong together."""

    NOTE = r"r.csv: note: a free run with the median estimates misses (.*) from 3 to 5.999 s: .*algest discover m.toml r.csv -o found"
    MISS = r"(\w+) by (\S+) (\S+ )?rms \((\S+) times its declared noise, (\d+) percent of its size\)"

    def said(self, model, text):
        self.write("m.toml", model)
        self.write("r.csv", text)
        value = self.algest_json("replay", "m.toml", "r.csv")
        return value, self.algest("replay", "m.toml", "r.csv")[1]

    def missed(self, model, rows):
        note = re.search(self.NOTE, self.said(model, seen(rows))[1])
        return {m[0]: m for m in re.findall(self.MISS, note[1])} if note else {}

    def test_a_known_constant_that_is_wrong(self):
        value, err = self.said(MOTOR.replace("0.06,", "0.054,"), seen(drive()))   # 10 percent
        medians = {p["name"]: p["median"] for p in value["parameters"]}
        self.assertEqual(value["status"]["ok"], 6000 - 100)
        ran = drive(**medians, K=0.054)
        found = {m[0]: m for m in re.findall(self.MISS, re.search(self.NOTE, err)[1])}
        self.assertIn("w", found)
        for name, column, noise in (("i", 1, 0.01), ("w", 2, 0.2)):
            true = drive()
            miss = math.sqrt(sum((a[column] - b[column]) ** 2 for a, b in zip(true[3000:], ran[3000:])) / 3000)
            if name in found:
                # three digits are printed; Euler's steps of 1/40 of L/R move a difference of runs by a percent or two; the noise adds sqrt(1 + 1/10^2)
                self.assertAlmostEqual(float(found[name][1]) / miss, 1, delta=0.03)
                self.assertAlmostEqual(float(found[name][3]) / (miss / noise), 1, delta=0.03)
            else:
                mean = sum(row[column] for row in true) / 6000
                self.assertLess(miss, 0.06 * math.sqrt(sum((row[column] - mean) ** 2 for row in true) / 6000))   # a twentieth is where it counts
        self.assertTrue(any(n.startswith("a free run") for n in value["notes"]), value["notes"])

    def test_the_right_model_is_not_doubted(self):
        for model in (MOTOR, ANGLE, MOTOR.replace("least_squares", "square")):
            _, err = self.said(model, seen(drive()))
            self.assertNotIn("free run", err)

    def test_what_a_constant_model_cannot_follow_is_not_its_fault(self):
        """Friction that changes half way, or in the last tenth: the parameter moves, no constant one follows."""
        for changed in (3000, 5400):
            _, err = self.said(MOTOR.replace("least_squares", "square"), seen(drive(changed_from=changed)))
            self.assertNotIn("free run", err)

    def test_what_integrates_is_not_looked_at(self):
        """The angle keeps every error of the speed for ever."""
        found = self.missed(ANGLE.replace("0.06,", "0.054,"), drive())
        self.assertIn("w", found)
        self.assertNotIn("th", found)

    def test_where_nothing_can_be_said(self):
        wrong = MOTOR.replace("0.06,", "0.054,")
        rows = drive()
        self.assertTrue(self.missed(wrong, rows))
        self.assertFalse(self.missed(wrong.replace(", noise = 0.01", "").replace(", noise = 0.2", ""), rows))                          # no yardstick
        self.assertFalse(self.missed(wrong.replace('name = "torque"', 'name = "torque"\nkappa = 1'), rows))                            # a load is left open
        self.assertFalse(self.missed(wrong.replace('w = { unit = "rad/s", noise = 0.2 }', 'w = { unit = "rad/s", noise = 0.2, lag = 2 }'), rows))   # a sensor that is late


if __name__ == "__main__":
    unittest.main()
