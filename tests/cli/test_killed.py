# SPDX-License-Identifier: GPL-3.0-or-later
"""Twenty kills each of generate and discover at random, test_killed_long.py has a hundred; and one at each step of writing."""
import unittest

from killed import Killed


class TwentyTimes(Killed):
    times = 20

    def test_generate(self):
        self.kill_generate()

    def test_discover(self):
        self.kill_discover()

    def test_each_step_of_generate(self):
        self.kill_generate_at_each_step()

    def test_each_step_of_discover(self):
        self.kill_discover_at_each_step()


if __name__ == "__main__":
    unittest.main()
