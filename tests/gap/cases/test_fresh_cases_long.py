# SPDX-License-Identifier: GPL-3.0-or-later
"""Six hundred fresh cases, drawn by the commit's hash: the confusion matrix of what is hidden against what discover says (`make test-long`).

By hand, from the root: ALGEST=build/algest ALGEST_SOURCE=$PWD ALGEST_BUILD=$PWD/build ALGEST_SHARED=../shared CXX=g++ PYTHONPATH=tests
python3 tests/gap/cases/test_fresh_cases_long.py. ALGEST_DRAWS=40 makes fewer of them, ALGEST_SEED=1 other ones, ALGEST_KEEP=DIR keeps them.
"""
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import draws

FALSE_NAMES = 1 / 300   # of the draws that hide nothing
RIGHT = 0.9             # where the gap is above three floors; of a few draws one may always be missed, as of wrong and false names
WRONG = 0.01            # of all draws
AMBIGUOUS = 0.15        # where the excitation separates
UNKNOWN = 0.9           # outside the library


class FreshCases(unittest.TestCase):
    def draws(self):
        """Seed and number."""
        return int(os.environ.get("ALGEST_SEED", draws.seed_of_commit())), int(os.environ.get("ALGEST_DRAWS", "600"))

    def test_the_bars_of_a_release(self):
        seed, count = self.draws()
        print(f"seed {seed}")
        matrix = draws.confusion(draws.draw(seed, count), keep=os.environ.get("ALGEST_KEEP"), jobs=int(os.environ.get("ALGEST_JOBS", "0")) or None)
        print(matrix.text())
        totals = matrix.totals
        with self.subTest("every run ends well"):
            self.assertEqual(matrix.refused(), 0)
        with self.subTest("false names"):
            self.assertLessEqual(matrix.false_names(), max(1, FALSE_NAMES * totals["nothing"]))
        with self.subTest("wrong names"):
            self.assertLessEqual(matrix.wrong_names(), max(1, WRONG * matrix.draws()))
        with self.subTest("ambiguous"):
            self.assertLessEqual(matrix.share("clear", "ambiguous"), AMBIGUOUS)
        with self.subTest("outside the library"):
            self.assertGreaterEqual(matrix.share("outside", "right"), UNKNOWN)
        with self.subTest("right names"):
            right = sum(totals[group, judged] for group in ("clear", "rivals") for judged in ("right", "honest"))
            due = totals["clear"] + totals["rivals"]
            self.assertLessEqual(due - right, max(1, (1 - RIGHT) * due))


if __name__ == "__main__":
    unittest.main()
