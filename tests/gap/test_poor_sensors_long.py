# SPDX-License-Identifier: GPL-3.0-or-later
"""Sensors that are no good, each way to spoil one on the recording that test_poor_sensors.py leaves out."""
import unittest

from poor import Poor
from spoilt_sensors import SpoiltSensors


class PoorSensors(SpoiltSensors, Poor):
    TURN = 1


if __name__ == "__main__":
    unittest.main()
