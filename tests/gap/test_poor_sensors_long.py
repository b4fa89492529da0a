# SPDX-License-Identifier: GPL-3.0-or-later
"""Sensors that are no good, each way to spoil one on both recordings."""
import unittest

from poor import I, Poor, changed, clean
from spoilt_sensors import SpoiltSensors


class PoorSensors(SpoiltSensors, Poor):
    LONG = True

    def test_a_current_of_the_wrong_sign_does_not_search_for_ever(self):
        """The loop of the model becomes unstable, and a run of it takes a hundred times as long: the search ends by its count of operations."""
        found = self.nothing_false(changed(clean(), I, lambda v: -v), [])
        self.assertEqual(found["verdict"], "unknown")
        self.assertTrue(any("stopped before every effect was tried" in d for d in found["doubts"]), found["doubts"])


if __name__ == "__main__":
    unittest.main()
