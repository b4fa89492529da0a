# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings that are no good: each gives a verdict that claims nothing false, or an error with exit 2 and no file. Sensors that are none: test_poor_sensors.py."""
import random
import unittest

from discovery import names
from hidden_motor import MODEL, TC
from poor import HIDDEN, I, U, W, Poor, changed, clean, with_friction

FRICTION = with_friction()   # dry friction hidden
CLEAN = clean()              # nothing hidden


def noise_alone(volts):
    dice = random.Random(5)
    rows = [f"{k * 1e-3:.3f},{dice.gauss(0, volts):.5f},{dice.gauss(0, 0.005):.6f},{dice.gauss(0, 0.1):.5f}" for k in range(3000)]
    return "\n".join(["t [s],u [V],i [A],w [rad/s]"] + rows) + "\n"


class PoorRecordings(Poor):
    def test_too_short(self):
        for rows in (0, 1, 2, 50, 110, 142):   # 0.7 of 143 are the 100 that are asked for
            with self.subTest(rows=rows):
                self.refused("".join(FRICTION.splitlines(True)[:rows + 1]), "too short" if rows > 2 else "error")
        for rows in (143, 150, 400):   # less than one step of voltage that settles; three of them
            with self.subTest(rows=rows):
                self.nothing_false("".join(FRICTION.splitlines(True)[:rows + 1]), HIDDEN)
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

    def test_numbers_that_are_none(self):
        lines = FRICTION.splitlines(True)
        for word in ("nan", "inf", "", "1,5"):
            with self.subTest(word=word):
                t, u, _, w = lines[77].split(",")
                said = self.refused("".join(lines[:77] + [",".join([t, u, word, w])] + lines[78:]))
                self.assertIn("run.csv:78:", said)

    def test_a_current_that_nobody_measured(self):
        """Rows need every signal: here the free run alone looks, and says which equation it looked at. The model says that the current is hidden."""
        (self.folder / "motor.toml").write_text(MODEL.replace('i = { unit = "A", noise = 0.005,', 'i = { unit = "A",'), encoding="utf-8")
        def without_current(text):
            return "".join(",".join(word for k, word in enumerate(line.split(",")) if k != I) + "\n" for line in text.splitlines())
        found = self.nothing_false(without_current(FRICTION), HIDDEN)
        self.assertNotEqual(found["verdict"], "none")
        self.assertEqual([w["equation"] for w in found["where"]], ["torque balance"])
        self.assertTrue(any("not measured" in d for d in found["doubts"]), found["doubts"])
        self.assertEqual(self.nothing_false(without_current(CLEAN), [])["verdict"], "none")


if __name__ == "__main__":
    unittest.main()
