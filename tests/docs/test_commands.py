# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command in README and docs runs, every model and every piece of C++ in them is right."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, BUILD, CXX, SOURCE

PAGES = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", SOURCE / "CHANGELOG.md"] + sorted((SOURCE / "docs").glob("*.md"))
# `make test` is what runs this test, behind `make`; a clean root runs them (tests/clean_root/prove).
INSTEAD = {"make demo": "bash examples/demo/run build/algest", "make test": "true", "make": "true",
           "cmake --install build --prefix build/installed": f"cmake --install {BUILD} --prefix build/installed"}


def blocks(page, language):
    """Fenced blocks of a language; of "sh target" those that need a cross compiler."""
    return re.findall(r"```%s\n(.*?)```" % language, page.read_text(encoding="utf-8"), flags=re.DOTALL)


# The pictures of docs/, and which command of the pages draws each (tests/docs/test_pictures.py looks at them).
PICTURES = {"positioning_axis.svg": "demo/positioning_axis.svg", "gap.svg": "demo/gap.svg", "pmsm_drive.svg": "pmsm_drive/figure_4_velocity.svg",
            "magnetic_bearing.svg": "magnetic_bearing/figure_10_tracking_z.svg", "drive_train.svg": "drive_train/figure_7_closed_loop.svg",
            **{f"verdict_{v}.svg": f"verdicts/verdict_{v}.svg" for v in ("named", "ambiguous", "none", "unknown")},
            "tutorial_estimates.svg": "tutorial/tutorial_estimates.svg", "tutorial_speed.svg": "tutorial/tutorial_speed.svg"}
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
ROUNDING = 1.0   # px: another compiler's or library's last bits may move a point that far, no further


class Documentation(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp(prefix="algest-docs-")
        self.addCleanup(shutil.rmtree, self.root)
        for folder in ("models", "examples", "runtime", "generated", "tests"):
            os.symlink(SOURCE / folder, os.path.join(self.root, folder))
        os.mkdir(os.path.join(self.root, "build"))
        os.symlink(ALGEST, os.path.join(self.root, "build", "algest"))

    def run_line(self, line):
        path = f"{self.root}/build:{os.environ['PATH']}"   # help says `algest`
        return subprocess.run(INSTEAD.get(line, line), shell=True, cwd=self.root, text=True, env={**os.environ, "PATH": path},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

    def runs(self, page, language):
        """Runs the commands of a page in their order; how many there are. What stands in a block of plain text behind them is what they print."""
        count, printed = 0, ""
        for kind, block in re.findall(rf"```({language}|text)\n(.*?)```", page.read_text(encoding="utf-8"), flags=re.DOTALL):
            if kind == "text":
                self.shows(page, block, printed)
                continue
            printed = ""
            for line in block.strip().splitlines():
                with self.subTest(page=page.name, command=line):
                    done = self.run_line(line)
                    self.assertEqual(done.returncode, 0, done.stdout)
                    printed += done.stdout
                    count += 1
        return count

    def shows(self, page, block, printed):
        """Every line of the block begins one that was printed, in this order; spaces and lines between do not count."""
        lines = iter([" ".join(line.split()) for line in printed.splitlines()])
        for line in block.strip().splitlines():
            words = " ".join(line.split())
            with self.subTest(page=page.name, shown=words):
                self.assertTrue(words == "..." or any(line.startswith(words) for line in lines), printed)

    def test_every_command_runs(self):
        counts = {page.name: self.runs(page, "sh") for page in PAGES}
        self.assertGreater(counts["README.md"], 10, "the page lost its commands")
        self.pictures_are_what_the_commands_draw()

    def pictures_are_what_the_commands_draw(self):
        self.assertEqual(set(PICTURES), {file.name for file in (SOURCE / "docs").glob("*.svg")} - {"architecture.svg"})
        for name, drawn in PICTURES.items():
            with self.subTest(picture=name):
                kept, fresh = (file.read_text(encoding="utf-8") for file in (SOURCE / "docs" / name, Path(self.root) / "build" / drawn))
                self.assertEqual(NUMBER.split(kept), NUMBER.split(fresh), f"copy build/{drawn} to docs/{name}, and look at it")
                self.assertLessEqual(max(abs(float(a) - float(b)) for a, b in zip(NUMBER.findall(kept), NUMBER.findall(fresh))), ROUNDING)

    def test_five_commands_to_a_project_of_your_own(self):
        """On a machine with a cross compiler the README's commands for a controller too."""
        block = next(b for b in blocks(PAGES[0], "sh") if "your_project" in b)
        self.assertEqual(len(block.strip().splitlines()), 5)
        for line in block.strip().splitlines():
            done = self.run_line(line)
            self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn(re.search(r"It prints `(.*?)`", PAGES[0].read_text(encoding="utf-8"))[1], done.stdout)
        if not shutil.which("arm-none-eabi-g++"):
            self.skipTest("no arm-none-eabi-g++ (.ci/install target)")
        self.assertEqual(self.runs(PAGES[0], "sh target"), 2)
        attributes = subprocess.run(["arm-none-eabi-readelf", "-A", "build/your_project/m7/controller"], cwd=self.root, text=True, capture_output=True, check=True).stdout
        self.assertIn("Tag_CPU_arch: v7E-M", attributes)

    def test_the_examples_of_every_help_run(self):
        """In the project's folder, after `make demo`, of which the recording is made here."""
        os.mkdir(os.path.join(self.root, "build", "demo"))
        done = self.run_line(f"{CXX} -std=c++17 -O2 examples/demo/simulate_motor.cpp -o build/simulate_motor && build/simulate_motor 1 build/demo/motor.csv build/hidden.txt")
        self.assertEqual(done.returncode, 0, done.stdout)
        shown = self.run_line("algest --help").stdout
        commands = re.findall(r"(?m)^  ([a-z]+) {2,}[A-Z]", shown)
        self.assertGreaterEqual(len(commands), 8)
        for words in ["", *commands]:
            shown = self.run_line(f"algest {words} --help").stdout
            examples = re.findall(r"(?m)^  (algest [a-z]+.*)$", shown)
            self.assertGreaterEqual(len(examples), 2, shown)
            for example in examples:
                with self.subTest(example=example):
                    done = self.run_line(example)
                    self.assertEqual(done.returncode, 0, done.stdout)

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

    def test_the_tutorial_shows_its_model(self):
        model = (SOURCE / "examples" / "demo" / "motor.toml").read_text(encoding="utf-8")
        self.assertEqual(blocks(SOURCE / "docs" / "tutorial.md", "toml"), ["".join(line for line in model.splitlines(keepends=True) if not line.startswith("#"))])

    def test_the_effect_that_the_page_of_unknown_teaches(self):
        """Torque 2 T w/w0/(1 + (w/w0)^2) with T = 0.03 N.m, w0 = 60 rad/s in examples/verdicts/bench.cpp."""
        done = self.run_line(f"{CXX} -std=c++17 -O2 examples/verdicts/bench.cpp -o build/bench && build/bench unknown build/unknown.csv && mkdir -p mine/effects && cp examples/demo/motor.toml mine")
        self.assertEqual(done.returncode, 0, done.stdout)
        (Path(self.root) / "mine/effects/eddy_brake.toml").write_text(blocks(SOURCE / "docs" / "verdict-unknown.md", "toml-effect")[0], encoding="utf-8")
        done = self.run_line("algest discover mine/motor.toml build/unknown.csv -o build/found --json 2>/dev/null")
        found = json.loads(done.stdout)
        self.assertEqual((found["verdict"], [e["name"] for e in found["effects"]]), ("named", ["eddy_brake"]))
        for parameter, truth in zip(found["effects"][0]["parameters"], (0.06, 60)):
            self.assertLess(abs(parameter["value"] / truth - 1), 0.01)   # three standard deviations are 1 and 0.75 percent

    def test_links_lead_somewhere(self):
        for page in PAGES:
            prose = [line for line in page.read_text(encoding="utf-8").splitlines() if not line.startswith("    ")]
            for target in re.findall(r"\]\(([^)#:]+)\)", "\n".join(prose)):
                with self.subTest(page=page.name, target=target):
                    self.assertTrue((page.parent / target).exists())


if __name__ == "__main__":
    unittest.main()
