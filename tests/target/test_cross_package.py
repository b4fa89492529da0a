# SPDX-License-Identifier: GPL-3.0-or-later
"""A cross build generates with the host's tool, ALGEST_EXECUTABLE, and compiles for the controller."""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, SOURCE, run, skip

sys.path.append(str(SOURCE / "tests/package"))
from consumers import build, copy_consumer, install, take_from_source  # noqa: E402

if not shutil.which("arm-none-eabi-g++"):
    skip("no arm-none-eabi-g++ (.ci/install target)")
TOOLCHAIN = f"-DCMAKE_TOOLCHAIN_FILE={SOURCE}/tests/target/arm-none-eabi.cmake"


class CrossPackage(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def check(self, consumer, *options):
        folder = build(consumer, TOOLCHAIN, f"-DALGEST_EXECUTABLE={ALGEST}", *options)
        self.assertIn("Tag_CPU_arch: v7E-M", run("arm-none-eabi-readelf", "-A", folder / "controller"))

    def test_installed(self):
        install(self.folder / "prefix", "runtime", "host")
        (self.folder / "prefix/bin/algest").unlink()  # the one that ALGEST_EXECUTABLE names must do
        self.check(copy_consumer(self.folder), f"-DCMAKE_PREFIX_PATH={self.folder}/prefix")

    def test_from_source(self):
        self.check(take_from_source(copy_consumer(self.folder)))


if __name__ == "__main__":
    unittest.main()
