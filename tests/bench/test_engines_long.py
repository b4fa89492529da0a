# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/engines in one run: tables are as fast as the best peer's, moments as much faster as docs/engines.md says, and no slower for a longer window."""
import re
import unittest

from environment import BUILD, run, skip

PROGRAM = BUILD / "bench/engines"
if not PROGRAM.exists():
    skip("bench/engines is not built (.ci/install bench)")

# Processor time, the least of many short repetitions: other programs on the machine cost some of them, not all.
SHORT = ["--benchmark_min_time=0.01", "--benchmark_repetitions=30"]


class Engines(unittest.TestCase):
    def test_ratios(self):
        said = run(PROGRAM, *SHORT)
        print(said)
        ratios = {int(m): tuple(map(float, rest)) for m, *rest in re.findall(r"^\| (\d+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", said, re.M)}
        # A ring's samples must be read once a kernel in any program: a peer that is a fifth faster would have the better loop.
        for intervals in (2000, 20000):
            self.assertLessEqual(ratios[intervals][0], 1.2)   # double: Eigen
            self.assertLessEqual(ratios[intervals][1], 1.2)   # float: Eigen, liquid-dsp
        # 18 000 and 180 000 products and sums against 185 (by the costs that evaluate_moment_rows and add_sample state): 97 and 970 times, of which a
        # quarter must be left, since the loops of the tables are longer.
        self.assertGreaterEqual(ratios[2000][2], 25)
        self.assertGreaterEqual(ratios[20000][2], 250)
        self.assertLessEqual(abs(int(re.search(r"changes by (-?\d+) percent", said)[1])), 10)
        self.assertRegex(said, r"Moments cost less than tables where M is above: ")


if __name__ == "__main__":
    unittest.main()
