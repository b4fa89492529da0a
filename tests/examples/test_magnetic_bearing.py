# SPDX-License-Identifier: GPL-3.0-or-later
"""examples/magnetic_bearing: what retuning is worth in closed loop (must-show 5 of issue 4), figures 8 to 13 of Delpoux, Floquet 2015."""
import statistics
import tempfile
import unittest

from closed_loop import Run, check_figures, check_manners, table_of_the_page


class MagneticBearing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-bearing-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_retuning(self):
        done = Run("magnetic_bearing", self.folder)
        print(done.text)
        # S(t) is full two windows of 0.02 s after the first sample (000, remark 2); the currents after that are the first to know.
        self.assertAlmostEqual(done.retuned, done.fed + 2 * 0.02 + 1e-4, delta=1e-9)
        self.assertIn("status of the last sample: ok", done.text)

        for axis, unknown_force in (("y", 3.0), ("z", 8.0)):
            self.assertGreaterEqual(done.rows[f"perturbation {axis}, amplitude"][2], 3)
            # What is left is the force that is there (errata.md). The force of a held current follows the shaft, the controller's
            # model holds it: 1 percent.
            self.assertAlmostEqual(done.rows[f"perturbation {axis}, mean"][1], unknown_force, delta=0.01 * unknown_force)
            # Section 4.2.3: the error becomes slightly smaller.
            self.assertGreater(done.rows[f"rms tracking error {axis}"][2], 1)
        for magnet in (1, 2, 3):
            errors = done.errors(f"lambda{magnet} [N.m^2/A^2]")
            self.assertLess(statistics.median(errors), 2e-3)   # the bar of errata.md, there without noise
            self.assertLess(max(errors), 0.2)   # issue 4, must-show 2: no `ok` estimate is further off
            self.assertEqual(done.rows[f"lambda{magnet}"][0], 4e-6)   # section 4.2.3

    def test_figures(self):
        check_figures(self, Run("magnetic_bearing", self.folder),
                      {"figure_8_estimates.svg": 1, "figure_9_tracking_y.svg": 3, "figure_10_tracking_z.svg": 3,
                       "figure_11_currents.svg": 2, "figure_12_path_before.svg": 1, "figure_13_path_after.svg": 1})

    def test_the_page_shows_what_is_printed(self):
        self.assertEqual(table_of_the_page("magnetic_bearing"), Run("magnetic_bearing", self.folder).text)

    def test_manners(self):
        check_manners(self, "magnetic_bearing", self.folder)


if __name__ == "__main__":
    unittest.main()
