# SPDX-License-Identifier: GPL-3.0-or-later
"""Generators built by g++ and clang++, with -O0 and -O2, all give the same bytes."""
import tempfile
import unittest

from emitted import built_generator, differences, emitted
from environment import ALGEST

with tempfile.TemporaryDirectory(prefix="algest-test-") as folder:
    FOUND = {(compiler, level, scalar): emitted(generator, scalar=scalar)
             for compiler in ("clang++", "g++") for level in ("-O0", "-O2")
             for generator in [built_generator(compiler, level, folder)] for scalar in ("double", "float")}


class Compilers(unittest.TestCase):

    def test_bytes(self):
        wanted = {scalar: emitted(ALGEST, scalar=scalar) for scalar in ("double", "float")}
        for (compiler, level, scalar), found in FOUND.items():
            with self.subTest(compiler=compiler, level=level, scalar=scalar):
                self.assertEqual(differences(found, wanted[scalar]), [])


if __name__ == "__main__":
    unittest.main()
