# SPDX-License-Identifier: GPL-3.0-or-later
"""algest taken with add_subdirectory: the runtime and algest_add_estimator, with the tool that ALGEST_EXECUTABLE names."""
import tempfile
import unittest

from consumers import build, copy_consumer, take_from_source
from environment import ALGEST, CXX, run


class FromSource(unittest.TestCase):
    def test_consumer_builds_and_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            built = build(take_from_source(copy_consumer(folder)), f"-DALGEST_EXECUTABLE={ALGEST}", f"-DCMAKE_CXX_COMPILER={CXX}")
            run(built / "controller")


if __name__ == "__main__":
    unittest.main()
