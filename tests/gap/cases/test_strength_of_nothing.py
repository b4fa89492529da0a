# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise of the process drifts as a small constant load would: what is not told from zero is not named."""
import argparse
import json
import sys
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, BUILD

sys.path.insert(0, str(Path(__file__).resolve().parent))
import score


class StrengthOfNothing(unittest.TestCase):
    def test_a_load_that_is_known_to_half_of_itself_is_no_name(self):
        with tempfile.TemporaryDirectory() as folder:
            made, why = score.make(argparse.Namespace(cases=BUILD / "tests/gap/cases/gap_cases", output=Path(folder)), "axis", "none_process", "104042")
            self.assertIsNotNone(made, why)
            result = score.discover(argparse.Namespace(algest=ALGEST), made, {})
            found = json.loads((made / "discover.json").read_text())
        self.assertEqual(result["judged"], "honest", result)
        self.assertTrue(any("known to" in doubt and "it may be nothing" in doubt for doubt in found["doubts"]), found["doubts"])


if __name__ == "__main__":
    unittest.main()
