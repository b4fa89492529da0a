# SPDX-License-Identifier: GPL-3.0-or-later
"""Twenty kills each of generate and discover; test_killed_long.py has a hundred."""
import unittest

from killed import Killed


class TwentyTimes(Killed):
    times = 20

    def test_generate(self):
        self.kill_generate()

    def test_discover(self):
        self.kill_discover()


if __name__ == "__main__":
    unittest.main()
