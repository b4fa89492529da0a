# SPDX-License-Identifier: GPL-3.0-or-later
"""examples/pmsm_drive: what retuning is worth in closed loop (must-show 5 of issue 4), figures 3 to 5 of Delpoux, Floquet 2015."""
import statistics
import tempfile
import unittest

from closed_loop import Run, check_figures, check_manners, table_of_the_page


class PmsmDrive(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-pmsm-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_retuning(self):
        for frame in ("rotor", "stator"):
            with self.subTest(frame=frame):
                done = Run("pmsm_drive", self.folder, frame)
                print(done.text)
                # S(t) is full two windows of 0.2 s after the first sample (000, remark 2): tau + T_f. The last sample's voltage
                # acts for 1 ms more.
                self.assertAlmostEqual(done.retuned, done.fed + 2 * 0.2 + 1e-3, delta=1e-9)
                self.assertIn("status of the last sample: ok", done.text)

                before, after, ratio, unit = done.rows["rms velocity error"]
                self.assertEqual(unit, "rad/s")
                self.assertGreaterEqual(ratio, 5)
                # errata.md; the noise has another seed there: 1 percent
                self.assertAlmostEqual(before, 0.317, delta=0.01 * 0.317)
                self.assertLess(after, 0.028)   # what the paper's estimates give, which are 3 to 8 percent off

                before, after, ratio, unit = done.rows["rms voltage"]
                self.assertEqual(unit, "V")
                self.assertLessEqual(after, 0.9 * before)
                self.assertAlmostEqual(before, 5.64, delta=0.01 * 5.64)
                self.assertAlmostEqual(after, 4.73, delta=0.01 * 4.73)

                # the bars of errata.md for medians with noisy currents
                for parameter, bar in (("R [ohm]", 1.5e-2), ("L [H]", 1e-2), ("K [N.m/A]", 1e-2)):
                    errors = done.errors(parameter)
                    self.assertLess(statistics.median(errors), bar, parameter)
                    self.assertLess(max(errors), 0.2)   # issue 4, must-show 2: no `ok` estimate is further off
                self.assertEqual([done.rows[name][0] for name in "RLK"], [5.0, 0.03, 0.4])   # section 4.1.3

    def test_figures(self):
        check_figures(self, Run("pmsm_drive", self.folder),
                      {"figure_3_estimates.svg": 3, "figure_4_velocity.svg": 2, "figure_5_voltages.svg": 2})

    def test_the_page_shows_what_is_printed(self):
        self.assertEqual(table_of_the_page("pmsm_drive"), Run("pmsm_drive", self.folder).text)

    def test_manners(self):
        check_manners(self, "pmsm_drive", self.folder)


if __name__ == "__main__":
    unittest.main()
