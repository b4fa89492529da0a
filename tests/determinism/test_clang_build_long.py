# SPDX-License-Identifier: GPL-3.0-or-later
"""A generator that clang++ built without optimisation gives the bytes of the one at hand. test_compilers_long.py has all four."""
import tempfile
import unittest

from emitted import built_generator, differences, emitted
from environment import ALGEST

with tempfile.TemporaryDirectory(prefix="algest-test-") as folder:
    GENERATOR = built_generator("clang++", "-O0", folder)
    FOUND = {scalar: emitted(GENERATOR, scalar=scalar) for scalar in ("double", "float")}


class ClangBuild(unittest.TestCase):

    def test_bytes(self):
        for scalar, found in FOUND.items():
            self.assertEqual(differences(found, emitted(ALGEST, scalar=scalar)), [])


if __name__ == "__main__":
    unittest.main()
