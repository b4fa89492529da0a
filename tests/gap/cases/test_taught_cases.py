# SPDX-License-Identifier: GPL-3.0-or-later
"""Hidden cases that taught a rule of discover, or of what counts as right: one each."""
import argparse
import json
import sys
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, BUILD, SHARED

sys.path.insert(0, str(Path(__file__).resolve().parent))
import score
import scoring


class TaughtCases(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def case(self, *case):
        """Its folder, and the truth."""
        made, why = score.make(argparse.Namespace(cases=BUILD / "tests/gap/cases/gap_cases", output=Path(self.folder.name)), *case)
        self.assertIsNotNone(made, why)
        return made, json.loads((made / "answer.json").read_text())

    def found(self, made, judged):
        """What discover says, judged like this."""
        effects = SHARED / "cases" / "effects.json"
        result = score.discover(argparse.Namespace(algest=ALGEST), made, scoring.aliases(effects) if effects.exists() else {})
        self.assertEqual(result["judged"], judged, result)
        return json.loads((made / "discover.json").read_text())

    def test_a_wrong_section_of_the_lower_tank_is_a_leak_between_the_tanks(self):
        # With S2 declared s times as large, s a1 and s a2 make the lower tank's right side, and a leak of (1 - s) a1 the upper one's: to the last bit.
        _, answer = self.case("tank", "parameter_error@4", "944197")
        self.assertEqual((answer["verdict"], answer["equal_terms"]), ("ambiguous", [["orifice_leak", "h1"]]))
        said = {"verdict": "named", "alternatives": [], "effects": [{"name": "orifice_leak", "equation": "flow balance of h1"}]}
        self.assertEqual(scoring.judge(said, answer, {}), "equal")
        said["effects"][0]["equation"] = "flow balance of h9"
        self.assertEqual(scoring.judge(said, answer, {}), "wrong")
        said["effects"][0] = {"name": "sensor_gain", "equation": "flow balance of h1"}
        self.assertEqual(scoring.judge(said, answer, {}), "wrong")

    def test_a_voltage_does_not_start_where_a_sensor_that_is_off_does(self):
        # The current starts at 0 and is shown as 0.043 A: nine times the noise, which a voltage needs ten milliseconds to make.
        made, answer = self.case("rl", "sensor_bias@1", "527501")
        self.assertEqual((answer["verdict"], answer["equal_terms"]), ("named", []))
        self.found(made, "right")

    def test_a_load_that_is_known_to_half_of_itself_is_no_name(self):
        made, _ = self.case("axis", "none_process", "104042")   # noise of the process drifts as a small load would
        found = self.found(made, "honest")
        self.assertTrue(any("known to" in doubt and "it may be nothing" in doubt for doubt in found["doubts"]), found["doubts"])

    def test_wells_of_an_angle_are_fitted_from_a_short_run_on(self):
        made, answer = self.case("tm", "cogging_torque@0", "509148")
        found = self.found(made, "right")
        self.assertLess(scoring.parameter_error(found, answer, {}), 0.01)   # by the sensors' noise alone it would be known to 0.001

    def test_an_inverter_that_switches_within_a_thousandth_of_its_current(self):
        made, answer = self.case("pm", "inverter_dead_time@0", "359217")
        found = self.found(made, "right")
        self.assertLess(scoring.parameter_error(found, answer, {}), 0.01)   # what the thinnest layer blurs: 0.001 of the current, of 0.1 where it acts


if __name__ == "__main__":
    unittest.main()
