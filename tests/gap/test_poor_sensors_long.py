# SPDX-License-Identifier: GPL-3.0-or-later
"""Sensors that are no good, each way to spoil one on both recordings."""
import unittest

from poor import Poor
from spoilt_sensors import SpoiltSensors


class PoorSensors(SpoiltSensors, Poor):
    LONG = True


if __name__ == "__main__":
    unittest.main()
