# SPDX-License-Identifier: GPL-3.0-or-later
"""All open cases. CI runs them."""
import unittest

from open_cases import CASES_BY_NUMBER, OpenCases


class All(OpenCases, unittest.TestCase):
    def test_open_cases(self):
        self.assertGreaterEqual(self.right_of(CASES_BY_NUMBER), 19)   # the bar of the issue


if __name__ == "__main__":
    unittest.main()
