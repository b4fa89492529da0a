# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command in README and docs runs, every model and every piece of C++ in them is right."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from environment import ALGEST, CXX, SOURCE

PAGES = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", SOURCE / "CHANGELOG.md"] + sorted((SOURCE / "docs").glob("*.md"))
# `make test` is what runs this test; a clean root runs both (tests/clean_root/prove).
INSTEAD = {"make demo": "bash examples/demo/run build/algest", "make test": "true"}


def blocks(page, language):
    return re.findall(r"```%s\n(.*?)```" % language, page.read_text(encoding="utf-8"), flags=re.DOTALL)


class Documentation(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp(prefix="algest-docs-")
        self.addCleanup(shutil.rmtree, self.root)
        for folder in ("models", "examples", "runtime", "generated"):
            os.symlink(SOURCE / folder, os.path.join(self.root, folder))
        os.mkdir(os.path.join(self.root, "build"))
        os.symlink(ALGEST, os.path.join(self.root, "build", "algest"))

    def run_line(self, line):
        return subprocess.run(INSTEAD.get(line, line), shell=True, cwd=self.root, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

    def test_every_command_runs(self):
        count = 0
        for page in PAGES:
            for block in blocks(page, "sh"):
                for line in block.strip().splitlines():
                    with self.subTest(page=page.name, command=line):
                        done = self.run_line(line)
                        self.assertEqual(done.returncode, 0, done.stdout)
                        count += 1
        self.assertGreater(count, 10, "the pages lost their commands")

    def test_the_demo_is_what_make_runs(self):
        makefile = (SOURCE / "Makefile").read_text(encoding="utf-8")
        self.assertIn(INSTEAD["make demo"], makefile)

    def test_models_in_the_pages_are_sound(self):
        for page in PAGES:
            for k, block in enumerate(blocks(page, "toml")):
                with self.subTest(page=page.name, block=k):
                    path = os.path.join(self.root, "block.toml")
                    with open(path, "w", encoding="utf-8") as out:
                        out.write(block)
                    done = subprocess.run([ALGEST, "check", path], text=True, capture_output=True)
                    self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_controller_of_the_readme_compiles(self):
        code = blocks(PAGES[0], "cpp")
        self.assertEqual(len(code), 1)
        source = os.path.join(self.root, "controller.cpp")
        with open(source, "w", encoding="utf-8") as out:
            out.write("void retune(double, double);\n" + code[0])
        done = subprocess.run([CXX, "-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-fno-exceptions",
                               "-I", SOURCE / "runtime" / "include", "-I", SOURCE / "generated", source],
                              text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            prose = [line for line in page.read_text(encoding="utf-8").splitlines() if not line.startswith("    ")]
            for target in re.findall(r"\]\(([^)#:]+)\)", "\n".join(prose)):
                with self.subTest(page=page.name, target=target):
                    self.assertTrue((page.parent / target).exists())


if __name__ == "__main__":
    unittest.main()
