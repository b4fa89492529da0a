# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of test_fresh_cases_long.py that CI runs: always the same draws, so that a change of what discover says is a change of the code."""
import unittest

import test_fresh_cases_long as whole


class FixedCases(whole.FreshCases):
    def draws(self):
        return 20261124, 30


if __name__ == "__main__":
    unittest.main()
