# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of docs/ in a browser: nothing overlaps or is cut, every axis has its unit. That they are what the commands of the pages draw, test_commands.py says."""
import tempfile
import unittest
from pathlib import Path

from environment import BUILD, SOURCE
from figures import faults, page_of, screenshot

PANELS = {"positioning_axis.svg": 4, "gap.svg": 1, "pmsm_drive.svg": 2, "magnetic_bearing.svg": 3, "drive_train.svg": 2, "tutorial_estimates.svg": 4, "tutorial_speed.svg": 2,
          "verdict_named.svg": 1, "verdict_ambiguous.svg": 1, "verdict_none.svg": 1, "verdict_unknown.svg": 1}
# Texts that are neither a number nor the label of an axis.
PLAIN = {"Linear axis, simulated", "estimate", "published", "truth", "first model, refitted", "with what was named", "two standard deviations of the noise", "measured", "reference", "shaft",
         "estimator is fed", "controller is retuned", "wanted", "motor", "retuned", "PI alone", "with notches"}


class Pictures(unittest.TestCase):
    def test_they_are_legible(self):
        self.assertEqual(set(PANELS), {file.name for file in (SOURCE / "docs").glob("*.svg")} - {"architecture.svg"})
        with tempfile.TemporaryDirectory() as folder:
            page = page_of({SOURCE / "docs" / name: panels for name, panels in PANELS.items()}, Path(folder) / "pictures.html")
            self.assertEqual(faults(page, PLAIN), [])
            (BUILD / "tests" / "docs").mkdir(parents=True, exist_ok=True)
            screenshot(page, BUILD / "tests" / "docs" / "pictures.png")


if __name__ == "__main__":
    unittest.main()
