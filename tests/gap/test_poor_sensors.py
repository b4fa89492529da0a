# SPDX-License-Identifier: GPL-3.0-or-later
"""Sensors that are no good: each gives a verdict that claims nothing false. One of each kind; the rest is in test_poor_sensors_long.py."""
import unittest

from poor import W, Poor, clean
from spoilt_sensors import SpoiltSensors


class PoorSensors(SpoiltSensors, Poor):
    def test_a_sensor_that_fails_behind_the_training_stretch(self):
        """The speed reads 0 for the last quarter: what was trained on is sound, and `none` would be said of a recording whose end the model misses."""
        lines = clean().splitlines()
        from_here = len(lines) * 3 // 4
        failed = "\n".join(lines[:from_here] + [",".join("0" if c == W else v for c, v in enumerate(line.split(","))) for line in lines[from_here:]]) + "\n"
        found = self.nothing_false(failed, [])
        self.assertEqual(found["verdict"], "unknown")
        self.assertTrue(any("'w' is missed by" in d and "a sensor failed or the machine changed" in d for d in found["doubts"]), found["doubts"])


if __name__ == "__main__":
    unittest.main()
