# SPDX-License-Identifier: GPL-3.0-or-later
"""A motor's recording with one sensor spoilt, dry friction hidden or nothing: what discover must not say. Quick tests take the first of several like
ways to spoil it; long ones take all, on both recordings."""
from poor import HIDDEN, SHORT, I, U, W, changed, clean, clipped, with_friction

RECORDINGS = [(with_friction(SHORT), HIDDEN), (clean(SHORT), [])]


def stuck(text):
    lines = text.splitlines()
    middle = len(lines) // 2
    held = lines[middle].split(",")[W]
    return "\n".join(lines[:middle] + [line.rsplit(",", 1)[0] + "," + held for line in lines[middle:]]) + "\n"


def dropouts(text):
    return "\n".join(line if k == 0 or k % 311 else line.rsplit(",", 1)[0] + ",500" for k, line in enumerate(text.splitlines())) + "\n"


class SpoiltSensors:
    LONG = False

    def in_turn(self, *ways):
        for k, way in enumerate(ways):
            for j, (text, hidden) in enumerate(RECORDINGS):
                if self.LONG or (k == 0 and j == 0):
                    yield way, text, hidden

    def test_a_wrong_scale_is_not_given_a_false_name(self):
        """mA under a header that says A; rpm that say rad/s; kV that say V. R, J, b are free, K and L are known: no effect makes this good, but for
        the voltage, which both sensors together may be wrong about: gains of theirs are what the data say as well."""
        for (column, factor), text, hidden in self.in_turn((I, 1000.0), (W, 9.5493), (U, 1e-3)):
            both = [("sensor_gain", "torque balance"), ("sensor_gain", "voltage balance")] if column == U and not hidden else []
            found = self.nothing_false(changed(text, column, lambda v: v * factor), both)
            self.assertNotEqual(found["verdict"], "none")   # the gap is large, whatever its name

    def test_a_clipped_sensor_is_doubted(self):
        for (column, share), text, hidden in self.in_turn((I, 0.5), (I, 0.2), (W, 0.8), (W, 0.5)):
            found = self.nothing_false(clipped(text, column, share), hidden)
            self.assertTrue(any("clipped" in d for d in found["doubts"]), found["doubts"])

    def test_a_clipped_command(self):
        for share, text, hidden in self.in_turn(0.5):
            self.nothing_false(clipped(text, U, share), hidden)

    def test_a_sensor_that_loses_its_sign_is_named(self):
        for column, text, hidden in self.in_turn(W):
            self.nothing_false(changed(text, column, abs), hidden + [("absolute_value_sensor", "torque balance")])

    def test_a_sensor_that_sticks_or_drops_out(self):
        for spoilt, text, hidden in self.in_turn(stuck, dropouts):
            self.nothing_false(spoilt(text), hidden)
