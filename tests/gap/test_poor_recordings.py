# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings that are no good: each gives a verdict that claims nothing false, or an error with exit 2 and no file."""
import json
import random
import tempfile
import unittest
from pathlib import Path

from discovery import attempt, discover, names, no_constant
from hidden_motor import MODEL, TC, recording

FRICTION = recording(TC, 7)   # dry friction hidden
CLEAN = recording(0.0, 7)     # nothing hidden
U, I, W = 1, 2, 3             # columns


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


def noise_alone(volts):
    dice = random.Random(5)
    rows = [f"{k * 1e-3:.3f},{dice.gauss(0, volts):.5f},{dice.gauss(0, 0.005):.6f},{dice.gauss(0, 0.1):.5f}" for k in range(3000)]
    return "\n".join(["t [s],u [V],i [A],w [rad/s]"] + rows) + "\n"


class PoorRecordings(unittest.TestCase):
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

    HIDDEN = [("coulomb_friction", "torque balance")]

    def test_too_short(self):
        for rows in (0, 1, 2, 50, 110, 142):   # 0.7 of 143 are the 100 that are asked for
            with self.subTest(rows=rows):
                self.refused("".join(FRICTION.splitlines(True)[:rows + 1]), "too short" if rows > 2 else "error")
        for rows in (143, 150, 400):   # less than one step of voltage that settles; three of them
            with self.subTest(rows=rows):
                self.nothing_false("".join(FRICTION.splitlines(True)[:rows + 1]), self.HIDDEN)
                self.nothing_false("".join(CLEAN.splitlines(True)[:rows + 1]), [])

    def test_unexcited(self):
        self.refused(noise_alone(0.0), "not excited")
        self.refused(noise_alone(3.0), "not excited")   # the amplifier was off: voltage is commanded, nothing moves

    def test_a_column_of_zeros(self):
        for column, name in ((I, "i"), (W, "w")):
            self.refused(changed(FRICTION, column, lambda v: 0.0), f"column '{name}'", "from end to end")
        self.nothing_false(changed(FRICTION, U, lambda v: 0.0), [])   # an input may be constant: it is the model that cannot move

    def test_units_that_convert_are_converted(self):
        plain = self.answered(FRICTION)
        for column, factor, header in ((I, 1000, "i [mA]"), (W, 60 / (2 * 3.141592653589793), "w [rpm]")):
            with self.subTest(header):
                found = self.answered(changed(FRICTION, column, lambda v: v * factor, header))
                self.assertEqual(names(found), names(plain))
                # The same numbers but for the last bit of a product, which the search may turn into its tolerance of 1e-4.
                self.assertAlmostEqual(found["effects"][0]["parameters"][0]["value"], TC, delta=0.05 * TC)
                self.assertAlmostEqual(found["effects"][0]["parameters"][0]["value"] / plain["effects"][0]["parameters"][0]["value"], 1, delta=1e-3)

    def test_units_that_do_not_convert_are_refused_in_their_place(self):
        self.assertIn("run.csv:1:13: error", self.refused(changed(FRICTION, I, float, "i [V]"), "does not convert", "'A'"))
        self.assertIn("run.csv:1:19: error", self.refused(changed(FRICTION, W, float, "w [m]"), "does not convert", "'rad/s'"))
        self.assertIn("run.csv:1:19: error", self.refused(changed(FRICTION, W, float, "w [blorp]"), "blorp"))

    def test_a_wrong_scale_is_not_given_a_false_name(self):
        """mA under a header that says A; rpm that say rad/s; kV that say V. R, J, b are free, K and L are known: no effect makes this good, but for
        the voltage, which both sensors together may be wrong about: gains of theirs are what the data say as well."""
        for column, factor in ((I, 1000.0), (W, 9.5493), (U, 1e-3)):
            for text in (FRICTION, CLEAN):
                with self.subTest(column=column):
                    both = [("sensor_gain", "torque balance"), ("sensor_gain", "voltage balance")] if column == U and text == CLEAN else []
                    found = self.nothing_false(changed(text, column, lambda v: v * factor), both)
                    self.assertNotEqual(found["verdict"], "none")   # the gap is large, whatever its name

    def test_a_clipped_sensor_is_doubted(self):
        for column, share in ((I, 0.5), (I, 0.2), (W, 0.8), (W, 0.5)):
            for text, hidden in ((FRICTION, self.HIDDEN), (CLEAN, [])):
                with self.subTest(column=column, share=share):
                    found = self.nothing_false(clipped(text, column, share), hidden)
                    self.assertTrue(any("clipped" in d for d in found["doubts"]), found["doubts"])
        for text, hidden in ((FRICTION, self.HIDDEN), (CLEAN, [])):
            self.nothing_false(clipped(text, U, 0.5), hidden)

    def test_a_sensor_that_loses_its_sign_is_named(self):
        for text, hidden in ((FRICTION, self.HIDDEN), (CLEAN, [])):
            self.nothing_false(changed(text, W, abs), hidden + [("absolute_value_sensor", "torque balance")])

    def test_a_sensor_that_sticks_or_drops_out(self):
        def stuck(text):
            lines = text.splitlines()
            held = lines[2500].split(",")[W]
            return "\n".join(lines[:2500] + [line.rsplit(",", 1)[0] + "," + held for line in lines[2500:]]) + "\n"

        def dropouts(text):
            return "\n".join(line if k == 0 or k % 311 else line.rsplit(",", 1)[0] + ",500" for k, line in enumerate(text.splitlines())) + "\n"
        for spoilt in (stuck, dropouts):
            for text, hidden in ((FRICTION, self.HIDDEN), (CLEAN, [])):
                self.nothing_false(spoilt(text), hidden)

    def test_numbers_that_are_none(self):
        lines = FRICTION.splitlines(True)
        for word in ("nan", "inf", "", "1,5"):
            with self.subTest(word=word):
                t, u, _, w = lines[77].split(",")
                said = self.refused("".join(lines[:77] + [",".join([t, u, word, w])] + lines[78:]))
                self.assertIn("run.csv:78:", said)

    def test_a_current_of_the_wrong_sign_does_not_search_for_ever(self):
        """The loop of the model becomes unstable, and a run of it takes a hundred times as long: the search ends by its count of operations."""
        found = self.nothing_false(changed(CLEAN, I, lambda v: -v), [])
        self.assertEqual(found["verdict"], "unknown")
        self.assertTrue(any("stopped before every effect was tried" in d for d in found["doubts"]), found["doubts"])

    def test_a_current_that_nobody_measured(self):
        """Rows need every signal: here the free run alone looks, and says which equation it looked at. The model says that the current is hidden."""
        (self.folder / "motor.toml").write_text(MODEL.replace('i = { unit = "A", noise = 0.005,', 'i = { unit = "A",'), encoding="utf-8")
        def without_current(text):
            return "".join(",".join(word for k, word in enumerate(line.split(",")) if k != I) + "\n" for line in text.splitlines())
        found = self.nothing_false(without_current(FRICTION), self.HIDDEN)
        self.assertNotEqual(found["verdict"], "none")
        self.assertEqual([w["equation"] for w in found["where"]], ["torque balance"])
        self.assertTrue(any("not measured" in d for d in found["doubts"]), found["doubts"])
        self.assertEqual(self.nothing_false(without_current(CLEAN), [])["verdict"], "none")


if __name__ == "__main__":
    unittest.main()
