# SPDX-License-Identifier: GPL-3.0-or-later
"""discover on several recordings of one machine: one fit, one verdict, and what each recording says of it. Motors are simulated here."""
import csv
import json
import math
import random
import subprocess
import tempfile
import unittest
from pathlib import Path

from discovery import attempt, discover, names, show, values
from environment import ALGEST
from hidden_plants import run

# First-order machine: J w' = K i - b w - Tc sgn(w) - T0; the current is commanded.
J, K, B = 2.5e-4, 0.05, 2e-4

MODEL = """\
name = "motor"
[sampling]
period = 1e-3
[signals]
i = { unit = "A", hold = "zoh" }
w = { unit = "rad/s", noise = 0.1 }
[constants]
K = { value = 0.05, unit = "N.m/A" }
[parameters]
J = { initial = 3e-4, unit = "kg.m^2", min = 0 }
b = { initial = 1e-4, unit = "N.m.s/rad", min = 0 }
[[equation]]
name = "torque balance"
ode = "J*der(w) = K*i - b*w"
"""


def motor(mean, friction, load, period=1e-3, seconds=4.0, seed=1, start=0.0):
    """Steps of current around a mean every 0.12 s."""
    dice = random.Random(seed)
    held = round(0.12 / period)
    return run(lambda s, i: [(K * i - B * s[0] - friction * math.tanh(s[0] / 0.02) - load) / J], [start], lambda k: mean + dice.uniform(-0.4, 0.4) if k % held == 0 else None,
               lambda s: (s[0] + dice.gauss(0, 0.1),), "t [s],i [A],w [rad/s]", round(seconds / period), steps=20, period=period)


class SeveralRecordings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-several-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "motor.toml").write_text(MODEL)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def discover(self, *recordings):
        return discover(self.folder / "motor.toml", recordings[0], self.folder / "found", *recordings[1:])

    def test_two_directions_tell_what_one_cannot(self):
        """A motor that only runs forward cannot tell dry friction from a load; one that runs backward too can."""
        forward = self.write("forward.csv", motor(1.0, 8e-3, 0.0, start=30.0, seed=1))
        backward = self.write("backward.csv", motor(-1.0, 8e-3, 0.0, period=2e-3, seconds=6.0, start=-60.0, seed=2))
        alone = self.discover(forward)
        show("forward alone", alone)
        self.assertEqual(alone["verdict"], "ambiguous")
        self.assertLessEqual({"coulomb_friction", "constant_load"}, {n for names in alone["alternatives"] for n in names})
        both = self.discover(forward, backward)
        show("forward and backward", both)
        self.assertEqual(names(both), ["coulomb_friction"])
        for alternative in both["alternatives"]:   # neither recording is slow enough to rule out a stick that gives way; a load is ruled out
            self.assertLessEqual(set(alternative), {"coulomb_friction", "stribeck_friction"})
        self.assertAlmostEqual(values(both)["Tc"], 8e-3, delta=2e-4)   # the noise gives it a deviation of 1e-5; tanh is not sgn below 0.02 rad/s
        # What each recording says: both speak for it, each with its own rows.
        first, second = both["recordings"]
        self.assertEqual([Path(r["recording"]).name for r in both["recordings"]], ["forward.csv", "backward.csv"])
        self.assertEqual(first["outputs"], both["outputs"])
        self.assertEqual((second["train_s"], second["test_s"]), ([0, 4.198], [4.2, 5.998]))   # 70 percent of 3000 samples every 2 ms
        for r in (first, second):
            self.assertGreater(r["gain"], 5, r)   # without it a run misses slowly, and few of its rows count
            (output,) = r["outputs"]
            self.assertLess(output["nrmse_after"], 1.2 * output["noise_floor"], output)
            self.assertGreater(output["nrmse_before"], 2 * output["nrmse_after"], output)
        for r, samples in ((first, 4000), (second, 3000)):
            for kind in ("before", "after"):
                rows = list(csv.reader(open(r[kind], newline="")))
                self.assertEqual((rows[0], len(rows)), (["t [s]", "w [rad/s]"], samples + 1))
        self.assertEqual([Path(second[k]).name for k in ("before", "after")], ["before_2.csv", "after_2.csv"])
        page = Path(both["report"]).read_text()
        self.assertIn("the first of 2", page)
        self.assertIn("backward.csv", page)

    def test_nothing_hidden_in_any_of_them_and_the_order_changes_no_verdict(self):
        recordings = [self.write(f"r{k}.csv", motor(mean, 0.0, 0.0, period=period, seconds=3.0, seed=k)) for k, (mean, period) in enumerate([(1.0, 1e-3), (-0.5, 4e-3), (0.0, 2e-3)])]
        for order in (recordings, recordings[::-1]):
            found = self.discover(*order)
            self.assertEqual((found["verdict"], found["effects"], found["model"]), ("none", [], None))
            self.assertEqual([r["gain"] for r in found["recordings"]], [0, 0, 0])

    def test_one_recording_says_what_it_always_said(self):
        only = self.write("only.csv", motor(0.0, 8e-3, 0.0, seed=3))
        found = self.discover(only)
        self.assertEqual(len(found["recordings"]), 1)
        self.assertEqual(found["recordings"][0]["outputs"], found["outputs"])
        self.assertFalse((self.folder / "found" / "before_2.csv").exists())
        self.assertNotIn("the first of", Path(found["report"]).read_text())

    def test_what_is_no_set_of_recordings(self):
        good = self.write("good.csv", motor(0.0, 8e-3, 0.0, seconds=1.0))
        for name, text, blamed, words in (("short.csv", "\n".join(good.read_text().splitlines()[:60]) + "\n", "short.csv", "too short"),
                                           ("column.csv", good.read_text().replace("w [rad/s]", "v [rad/s]"), "motor.toml", "no column 'w'"),
                                           ("still.csv", "t [s],i [A],w [rad/s]\n" + "".join(f"{k * 1e-3:.3f},1,2\n" for k in range(300)), "still.csv", "from end to end")):
            with self.subTest(name):
                done = attempt(self.folder / "motor.toml", good, self.folder / "found", self.write(name, text))
                self.assertEqual(done.returncode, 2, done.stdout)
                errors = json.loads(done.stdout)["error"]
                self.assertEqual({Path(e["file"]).name for e in errors}, {blamed}, errors)
                self.assertIn(words, " ".join(e["what"] for e in errors))
                self.assertFalse((self.folder / "found").exists())
        done = attempt(self.folder / "motor.toml", good, self.folder / "found", good)
        self.assertEqual(done.returncode, 2)
        self.assertIn("the same recording twice", done.stdout)

    def test_no_output_takes_the_place_of_a_recording(self):
        first = self.write("first.csv", motor(0.0, 0.0, 0.0, seconds=1.0))
        second = self.write("before_2.csv", motor(0.0, 0.0, 0.0, seconds=1.0, seed=2))
        kept = second.read_text()
        (self.folder / "model").mkdir()
        model = self.folder / "model" / "motor.toml"
        model.write_text(MODEL)
        done = subprocess.run([ALGEST, "discover", model, first, second, "-o", self.folder], text=True, capture_output=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("would be overwritten", done.stderr)
        self.assertEqual(second.read_text(), kept)


if __name__ == "__main__":
    unittest.main()
