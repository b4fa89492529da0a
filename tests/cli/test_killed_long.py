# SPDX-License-Identifier: GPL-3.0-or-later
"""A hundred kills each of generate and discover."""
import unittest

from killed import Killed


class HundredTimes(Killed):
    times = 100

    def test_generate(self):
        self.kill_generate()

    def test_discover(self):
        self.kill_discover()


if __name__ == "__main__":
    unittest.main()
