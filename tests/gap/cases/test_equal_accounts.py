# SPDX-License-Identifier: GPL-3.0-or-later
"""What is the same in every sample, and what only looks like it."""
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


class EqualAccounts(unittest.TestCase):
    def case(self, folder, *case):
        made, why = score.make(argparse.Namespace(cases=BUILD / "tests/gap/cases/gap_cases", output=Path(folder)), *case)
        self.assertIsNotNone(made, why)
        return made, json.loads((made / "answer.json").read_text())

    def test_a_wrong_section_of_the_lower_tank_is_a_leak_between_the_tanks(self):
        # With S2 declared s times too large, (a1 - L) / (s S2) = a1 / S2 and a2' = s a2 make the same right side: L = (1 - s) a1, to the last bit.
        with tempfile.TemporaryDirectory() as folder:
            _, answer = self.case(folder, "tank", "parameter_error@4", "944197")
        self.assertEqual((answer["verdict"], answer["equal_terms"]), ("ambiguous", ["orifice_leak"]))
        said = {"verdict": "named", "alternatives": [], "effects": [{"name": "orifice_leak", "equation": "flow balance of h1"}]}
        self.assertEqual(scoring.judge(said, answer, {}), "equal")
        said["effects"][0]["name"] = "sensor_gain"
        self.assertEqual(scoring.judge(said, answer, {}), "wrong")

    def test_a_load_does_not_start_where_a_sensor_that_is_off_does(self):
        # The current starts at 0 and is shown as 0.043 A: nine times the noise, which a voltage needs ten milliseconds to make.
        with tempfile.TemporaryDirectory() as folder:
            made, answer = self.case(folder, "rl", "sensor_bias@1", "527501")
            self.assertEqual((answer["verdict"], answer["equal_terms"]), ("named", []))
            effects = SHARED / "cases" / "effects.json"
            result = score.discover(argparse.Namespace(algest=ALGEST), made, scoring.aliases(effects) if effects.exists() else {})
        self.assertEqual(result["judged"], "right", result)


if __name__ == "__main__":
    unittest.main()
