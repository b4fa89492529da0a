# SPDX-License-Identifier: GPL-3.0-or-later
"""`make` where packages are missing and nobody here may install them: what it says is what to do."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import SOURCE

USED = ("sh", "bash", "make", "env", "dirname", "awk")    # by Makefile and .ci/install


class MissingPackages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copytree(SOURCE / ".ci", self.folder / ".ci")
        for name in ("Makefile", "packages.txt"):
            shutil.copy(SOURCE / name, self.folder)
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for name in USED:
            (self.programs / name).symlink_to(shutil.which(name))
        self.program("id", "echo 1000")               # not root
        self.program("dpkg-query", "exit 1")          # nothing is installed

    def program(self, name, text):
        path = self.programs / name
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def made(self, target):
        environment = {key: value for key, value in os.environ.items() if not key.startswith("MAKE")} | {"PATH": str(self.programs)}
        done = subprocess.run([self.programs / "make", target], cwd=self.folder, capture_output=True, text=True, env=environment)
        self.assertNotEqual(done.returncode, 0)
        self.assertFalse((self.folder / "build").exists())
        return done.stdout, done.stderr

    def test_no_sudo(self):
        self.program("apt-get", "echo apt-get ran")
        said, complained = self.made("test")
        self.assertNotIn("apt-get ran", said)
        self.assertRegex(complained, r"no sudo; as root, run\n  apt-get update && apt-get install --no-install-recommends g\+\+ .*libginac-dev.* catch2 ")
        self.assertIn("then make again", complained)

    def test_no_apt(self):
        _, complained = self.made("test")
        self.assertRegex(complained, r"these packages of Debian 12.*libginac-dev.* catch2 ")
        self.assertIn("cmake --preset release && cmake --build --preset release && ctest --preset release", complained)

    def test_sudo(self):
        self.program("apt-get", "echo apt-get \"$@\"")
        self.program("sudo", "echo as root:; \"$@\"")
        self.program("cmake", "exit 9")               # what comes after the installation
        said, _ = self.made("all")
        self.assertRegex(said, r"Installing g\+\+ ")
        self.assertRegex(said, r"as root:\napt-get .*install -y --no-install-recommends g\+\+ .*libginac-dev")
        self.assertNotIn("catch2", said)


if __name__ == "__main__":
    unittest.main()
