# SPDX-License-Identifier: GPL-3.0-or-later
"""What discover says where it cannot do what was asked: no stretch left to test on, a model file that takes no new entries."""
import json
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST
from hidden_motor import MODEL, TC, recording

ENTRY = re.compile(r"(?m)^(R|J|b) = (\{[^}]*\}).*\n")


class WhatIsSaid(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "motor.toml").write_text(MODEL)
        (self.folder / "run.csv").write_text(recording(TC, 7))

    def discover(self, *words):
        return subprocess.run([ALGEST, "discover", "motor.toml", "run.csv", "-o", "found", "--json", *words], cwd=self.folder, text=True, capture_output=True)

    def test_a_training_stretch_that_leaves_nothing_to_test_on(self):
        for end in ("10", "4.999"):
            done = self.discover("--train", f"0:{end}")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"--train 0:{end} leaves", done.stderr)
            advice = re.search(r"e\.g\. --train (\S+);", done.stderr)[1]
            self.assertEqual(advice, "0:3.5")      # 70 percent of 5 s

    def test_a_stretch_beyond_the_recording(self):
        """It ends at 4.999 s: the part of a test that is there is not the test that was asked for. Five seconds of it are all of it."""
        for option, words in (("--test 4:9", ["--test", "4:9"]), ("--train -1:3", ["--train", "-1:3"]), ("--train 0:9", ["--train", "0:9", "--test", "4:5"])):
            done = self.discover(*words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f"run.csv: error: {option} is not within the recording, which goes from 0 s to 4.999 s", done.stderr)
        self.assertEqual(self.discover("--train", "0:4", "--test", "4:5").returncode, 0)

    def test_a_name_that_misses_the_test_stretch(self):
        """Friction that grows by 30 percent behind the training stretch: it was named there, and what it leaves of the test stretch, a quarter or so of the gap, is no noise."""
        self.assertEqual([e["name"] for e in json.loads(self.discover().stdout)["effects"]], ["coulomb_friction"])
        (self.folder / "run.csv").write_text(recording(TC, 7, later=1.3))
        found = json.loads(self.discover().stdout)
        self.assertEqual((found["verdict"], found["effects"]), ("unknown", []))
        self.assertTrue(any("coulomb_friction explained the training stretch and misses the test stretch" in doubt for doubt in found["doubts"]), found["doubts"])
        self.assertTrue(any("'w' is missed by" in doubt for doubt in found["doubts"]), found["doubts"])

    def test_a_fit_that_did_not_settle(self):
        """A current sensor that is connected the wrong way round, and parameters without limits: no positive ones follow it, and the fit runs away."""
        header, *rows = recording(0.0, 7, samples=2500).splitlines()
        turned = [",".join([t, u, f"{-float(i)}", w]) for t, u, i, w in (row.split(",") for row in rows)]
        (self.folder / "run.csv").write_text("\n".join([header, *turned]) + "\n")
        (self.folder / "motor.toml").write_text(MODEL.replace(", min = 0", ""))
        found = json.loads(self.discover().stdout)
        self.assertTrue(any("did not settle" in doubt for doubt in found["doubts"]), found["doubts"])
        unseen = [p["name"] for p in found["parameters_before"] if p["sd"] is None]
        self.assertTrue(unseen)
        self.assertTrue(any(f"the data do not see {', '.join(unseen)}," in doubt for doubt in found["doubts"]), found["doubts"])
        text = subprocess.run([ALGEST, "discover", "motor.toml", "run.csv", "-o", "found"], cwd=self.folder, text=True, capture_output=True).stdout
        self.assertNotIn("+- inf", text)
        self.assertIn(f"{unseen[0]}: not seen by the data; the fit stopped at ", text)

    def test_parameters_in_an_inline_table_are_a_doubt(self):
        # Nothing can be written behind the last entry of `parameters = { ... }`: what needs a parameter is not tried, and that is said.
        entries = ", ".join(f"{name} = {value}" for name, value in ENTRY.findall(MODEL))
        text = ENTRY.sub("", MODEL).replace("[parameters]\n", "").replace("[sampling]", f"parameters = {{ {entries} }}\n\n[sampling]", 1)
        (self.folder / "motor.toml").write_text(text)
        found = json.loads(self.discover().stdout)
        self.assertEqual(found["verdict"], "unknown")
        self.assertTrue(any("coulomb_friction" in doubt and "[parameters]" in doubt for doubt in found["doubts"]), found["doubts"])


if __name__ == "__main__":
    unittest.main()
