# SPDX-License-Identifier: GPL-3.0-or-later
"""The runtime stands alone: copied out of the project it installs, and each header compiles by itself under two compilers."""
import shutil
import tempfile
import unittest
from pathlib import Path

from environment import SOURCE, run

FLAGS = "-std=c++17 -O2 -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Werror -fsyntax-only -xc++".split()


class RuntimeAlone(unittest.TestCase):
    def test_it_installs_without_the_project(self):
        with tempfile.TemporaryDirectory() as folder:
            runtime, prefix = Path(folder) / "runtime", Path(folder) / "prefix"
            shutil.copytree(SOURCE / "runtime", runtime)
            run("cmake", "-S", runtime, "-B", runtime / "build")
            run("cmake", "--install", runtime / "build", "--prefix", prefix)
            self.assertTrue((prefix / "share/cmake/algest_runtime/algest_runtimeConfig.cmake").is_file())
            self.assertTrue((prefix / "share/doc/algest_runtime/LICENSE").is_file())

    def test_each_header_compiles_by_itself(self):
        headers = sorted((SOURCE / "runtime/include/algest").glob("*.hpp"))
        self.assertNotEqual(headers, [])
        for header in headers:
            for compiler in ("g++", "clang++"):
                with self.subTest(header=header.name, compiler=compiler):
                    source = f'#include "algest/{header.name}"\n'
                    run("sh", "-c", 'printf %s "$0" | "$@" -', source, compiler, *FLAGS, f"-I{SOURCE}/runtime/include")

    def test_newer_standards(self):
        headers = sorted((SOURCE / "runtime/include/algest").glob("*.hpp"))
        source = "".join(f'#include "algest/{header.name}"\n' for header in headers)
        for standard in ("c++20", "c++2b"):
            for compiler in ("g++", "clang++"):
                with self.subTest(standard=standard, compiler=compiler):
                    run("sh", "-c", 'printf %s "$0" | "$@" -', source, compiler, *FLAGS, f"-std={standard}", f"-I{SOURCE}/runtime/include")

    def test_fast_math_is_refused(self):
        for flag in ("-ffast-math", "-ffinite-math-only"):
            for compiler in ("g++", "clang++"):
                with self.assertRaisesRegex(AssertionError, "ffast-math"):
                    run(compiler, *FLAGS, flag, SOURCE / "runtime/include/algest/estimator.hpp", f"-I{SOURCE}/runtime/include")


if __name__ == "__main__":
    unittest.main()
