# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of recordings that are no good share: the recordings, how they are spoilt, and what must not be said of them."""
import json
import tempfile
import unittest
from pathlib import Path

from discovery import attempt, discover, names, no_constant
from hidden_motor import MODEL, TC, recording

U, I, W = 1, 2, 3             # columns
HIDDEN = [("coulomb_friction", "torque balance")]
SHORT = 3000                  # samples: 25 steps of voltage, 17 of them to train on, show what a spoilt sensor shows


def with_friction(samples=5000):
    return recording(TC, 7, samples)


def clean(samples=5000):
    return recording(0.0, 7, samples)


def changed(text, column, law, header=None):
    """The recording with law(value) in a column, and another header above it."""
    rows = [line.split(",") for line in text.splitlines()]
    if header:
        rows[0][column] = header
    for row in rows[1:]:
        row[column] = repr(law(float(row[column])))
    return "\n".join(map(",".join, rows)) + "\n"


def largest(text, column):
    return max(abs(float(line.split(",")[column])) for line in text.splitlines()[1:])


def clipped(text, column, share):
    limit = share * largest(text, column)
    return changed(text, column, lambda v: max(-limit, min(limit, v)))


class Poor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-poor-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "motor.toml").write_text(MODEL, encoding="utf-8")

    def run_on(self, text):
        (self.folder / "run.csv").write_text(text, encoding="utf-8")
        return attempt(self.folder / "motor.toml", self.folder / "run.csv", self.folder / "found")

    def refused(self, text, *words):
        done = self.run_on(text)
        self.assertEqual(done.returncode, 2, done.stdout)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(json.loads(done.stdout, parse_constant=no_constant).get("verdict"), None)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["motor.toml", "run.csv"], "an error leaves no file")
        return done.stderr

    def answered(self, text):
        """The JSON, sound; numbers in the runs are numbers too."""
        (self.folder / "run.csv").write_text(text, encoding="utf-8")
        found = discover(self.folder / "motor.toml", self.folder / "run.csv", self.folder / "found")
        self.assertIn(found["verdict"], ("named", "ambiguous", "none", "unknown"))
        for name in ("before.csv", "after.csv"):
            words = (self.folder / "found" / name).read_text(encoding="utf-8").split("\n", 1)[1].lower()
            self.assertNotIn("nan", words)
            self.assertNotIn("inf", words)
        print(f"   {self.id().split('.')[-1]}: {found['verdict']} {names(found)}; " + "; ".join("{signal} {nrmse_before:.3g} -> {nrmse_after:.3g}, floor {noise_floor:.2g}".format(**o) for o in found["outputs"]))
        return found

    def nothing_false(self, text, hidden):
        """Named is at most what is hidden, where it is hidden."""
        found = self.answered(text)
        if found["verdict"] == "named":
            self.assertEqual(sorted(hidden), sorted((e["name"], e["equation"]) for e in found["effects"]), "named, and wrong")
        return found
