# SPDX-License-Identifier: GPL-3.0-or-later
"""Models spoilt at random, many thousands of them. ALGEST_SEEDS=100:110 takes other seeds, each 1000 models."""
import os
import unittest

from mutants_case import MutantsCase


class MutatedLong(MutantsCase):
    def test_no_crash_no_hang_no_empty_message(self):
        first, _, last = os.environ.get("ALGEST_SEEDS", "2:22").partition(":")
        for seed in range(int(first), int(last)):
            self.examine_all(seed, count=1000)


if __name__ == "__main__":
    unittest.main()
