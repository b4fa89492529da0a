# SPDX-License-Identifier: GPL-3.0-or-later
"""Models spoilt at random, a few hundred of them; test_mutated_models_long.py has more."""
import unittest

from mutants_case import MutantsCase


class Mutated(MutantsCase):
    def test_no_crash_no_hang_no_empty_message(self):
        self.examine_all(seed=1, count=400)


if __name__ == "__main__":
    unittest.main()
