# SPDX-License-Identifier: GPL-3.0-or-later
"""The same model gives the same bytes: in 50 processes that differ in all that must not matter, and whatever its comments and
white space. What matters to the weights changes the hash. `generate --check` tells what is committed from what is not."""
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

from emitted import MODELS, differences, emitted, files
from environment import ALGEST, run

PROCESSES = 50


def locales():
    """C, C.UTF-8 and one of each other language that is installed; one that writes a decimal comma counts most."""
    listed = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout.split() if shutil.which("locale") else []
    others = {name[:2]: name for name in listed if not name.startswith(("C", "POSIX"))}
    return ["C", "C.UTF-8", *others.values()]


def model_hash(folder, name):
    """As the header and the tables carry it."""
    found = {re.search(r"; plan ([0-9a-f]{16})$", (Path(folder) / name / f"{name}{end}").read_text(), re.M)[1]
             for end in (".hpp", "_tables.hpp")}
    assert len(found) == 1
    return found.pop()


class InAFolder(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Processes(InAFolder):

    def test_fifty_processes(self):
        chance = random.Random(20260106)
        zones = ["UTC", "Pacific/Kiritimati", "America/St_Johns", "XYZ-13:45", ""]
        places = locales()
        randomised = Path("/proc/sys/kernel/randomize_va_space")
        print(f"locales: {' '.join(places)}; address space randomisation: {randomised.read_text().strip() if randomised.exists() else 'unknown'}")
        wanted = emitted(ALGEST)
        self.assertEqual(len([path for path in wanted if not path.startswith("derive")]), 3 * len(MODELS))
        for k in range(PROCESSES):
            # Its own place, with the models at a relative path; room enough in the environment to move the stack by pages.
            where = self.folder / ("d" * chance.randint(1, 60)) / str(k)
            where.mkdir(parents=True)
            shutil.copytree(MODELS[0].parent, where / "m")
            environment = {"PATH": os.environ["PATH"], "HOME": str(where), "TZ": zones[k % len(zones)],
                           "LC_ALL": places[k % len(places)], "LANG": places[(k // 2) % len(places)],
                           **{f"FILLER_{n}": "x" * chance.randint(0, 3000) for n in range(chance.randint(0, 40))}}
            names = [f"m/{model.name}" for model in MODELS]
            run(ALGEST, "generate", *names, "-o", "out", cwd=where, env=environment)
            found = {f"double/{path}": data for path, data in files(where / "out").items()}
            if k % 5 == 0:
                for model in MODELS:
                    for form in ("text", "latex", "json"):
                        weights = ["--weights"] if form == "json" else []
                        found[f"derive {model.stem} {form}"] = run(ALGEST, "derive", f"m/{model.name}", "--format", form, *weights,
                                                                  cwd=where, env=environment).encode()
                self.assertEqual(differences(found, wanted), [], environment)
            else:
                files_alone = {path: data for path, data in wanted.items() if not path.startswith("derive")}
                self.assertEqual(differences(found, files_alone), [], environment)
            shutil.rmtree(where)

    def test_models_one_by_one(self):
        """Neither the models before it nor their order shows in an estimator."""
        together = emitted(ALGEST)
        for model in reversed(MODELS):
            alone = emitted(ALGEST, [model])
            self.assertEqual(differences(alone, {path: data for path, data in together.items() if path in alone}), [])
        self.assertEqual(differences(emitted(ALGEST, MODELS[::-1]), together), [])


class Text(InAFolder):
    """Changes to the text of a model file."""

    def generated(self, text, *options):
        (self.folder / "model.toml").write_text(text)
        out = self.folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        run(ALGEST, "generate", "model.toml", "-o", "out", *options, cwd=self.folder)
        return files(out), model_hash(out, tomllib.loads(text)["name"])

    def respaced(self, text):
        """The same model: comments on lines of their own and behind values, empty lines, other white space around keys."""
        lines = []
        for k, line in enumerate(text.splitlines()):
            body = line.split("#")[0].rstrip() if line.count('"') == 0 else line.rstrip()
            body = re.sub(r"^(\w+)\s*=\s*", ("\\1=", "\\1\t =\t\t", "  \\1   =   ")[k % 3], body)
            lines += [f"# comment {k}: L*der(i) = [x] \"", "",
                      "\t" * (k % 3) + body + "  \t" * (k % 2) + (f" # behind {k}" if body and k % 4 else "")]
        return "# at the top\n\n" + "\n".join(lines) + "\n\n# at the end, without a new line"

    def test_comments_and_white_space_change_nothing(self):
        for model in MODELS:
            with self.subTest(model.name):
                text = model.read_text()
                changed = self.respaced(text)
                self.assertNotEqual(changed, text)
                wanted, wanted_hash = self.generated(text)
                for other in (changed, text.replace("\n", "\r\n"), re.sub(r"\s*#[^\"\n]*$", "", text, flags=re.M)):
                    found, found_hash = self.generated(other)
                    self.assertEqual(found_hash, wanted_hash)
                    self.assertEqual(differences(found, wanted), [])

    def test_what_matters_changes_the_hash(self):
        model = (MODELS[0].parent / "positioning_axis.toml").read_text()
        changes = {
            "as it is": ("", ""),
            "period": ("period = 1e-3 ", "period = 2e-3 "),
            "window": ("window = 0.2 ", "window = 0.201 "),
            "both, M as before": ("period = 1e-3          # s\nwindow = 0.2 ", "period = 2e-3          # s\nwindow = 0.4 "),
            "kappa": ("kappa = 0 ", "kappa = 1 "),
            "rows": ("rows = 1", "rows = 2"),
            "another row": ("rows = 1", "rows = [2]"),
            "hold": ('q = { unit = "m"', 'q = { hold = "zoh", unit = "m"'),
            "quadrature": ("[estimator]", '[estimator]\nquadrature = "trapezoid"'),
            "Simpson": ("[estimator]", '[estimator]\nquadrature = "simpson"'),
            "forgetting": ("[estimator]", "[estimator]\nforgetting = 0.999"),
            "solve": ('solve = "least_squares"', 'solve = "robust"'),
            "a factor in the equation": ("Fv*der(q) ", "2*Fv*der(q) "),
            "the 15th digit of a factor": ("Fv*der(q) ", "2.00000000000001*Fv*der(q) "),
            "a sign": ("+ offset", "- offset"),
            "a function": ("sgn(der(q))", "sgn(q)"),
            "an initial value": ("initial = 200", "initial = 201"),
            "a limit": ('force = {', 'force = { max = 500,'),
            "name": ('name = "positioning_axis"', 'name = "positioning_axes"'),
        }
        hashes = {}
        for what, (old, new) in changes.items():
            self.assertIn(old, model, what)
            text = model.replace(old, new, 1)
            if what == "kappa":                                   # kappa = 1 erases the offset, which then cannot be asked for
                text = text.replace(" + offset = force", " = force").replace('offset = { unit = "N", initial = 0 }\n', "")
            with self.subTest(what):
                hashes[what] = self.generated(text)[1]
        with self.subTest("scalar"):
            hashes["float"] = self.generated(model, "--scalar", "float")[1]
        self.assertEqual(len(hashes), len(changes) + 1)
        self.assertEqual(len(set(hashes.values())), len(hashes), hashes)

    def test_the_hash_tells_tables_apart(self):
        """Two tables files that differ in more than their hash have different hashes; all models, both scalars."""
        seen = {}
        for model in MODELS:
            for scalar in ("double", "float"):
                found, identity = self.generated(model.read_text(), "--scalar", scalar)
                tables, = [data for path, data in found.items() if path.endswith("_tables.hpp")]
                self.assertNotIn(identity, seen)
                seen[identity] = tables
        self.assertEqual(len(seen), 2 * len(MODELS))


class Check(InAFolder):
    """generate --check"""

    def setUp(self):
        super().setUp()
        run(ALGEST, "generate", *MODELS, "-o", self.folder / "out")

    def state(self):
        """Everything that writing would change."""
        return {str(path): (path.stat().st_ino, path.stat().st_mtime_ns, path.stat().st_mode,
                            path.read_bytes() if path.is_file() else None)
                for path in sorted(self.folder.rglob("*"))}

    def check(self, *options, code):
        before = self.state()
        result = subprocess.run([ALGEST, "generate", *MODELS, "-o", "out", "--check", *options], cwd=self.folder,
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertEqual(self.state(), before)     # it has written nothing
        return result.stdout

    def change(self, name, edit):
        path = self.folder / "out" / name
        text = path.read_text()
        changed = edit(text)
        self.assertNotEqual(text, changed)
        path.write_text(changed)
        return path

    def test_a_clean_tree(self):
        self.assertEqual(self.check(code=0), "")
        self.assertEqual(json.loads(self.check("--json", code=0))["models"][0]["differences"], [])

    def test_a_unified_diff_of_code_and_derivation(self):
        for name, old, new in [("rl_circuit/rl_circuit.hpp", "class RlCircuit {", "class RlCircus {"),
                               ("dc_motor/dc_motor.md", "# dc_motor: derivation", "# dc_motor: deviation")]:
            with self.subTest(name):
                path = self.change(name, lambda text, old=old, new=new: text.replace(old, new, 1))
                text = path.read_text()
                out = self.check(code=1)
                lines = out.splitlines()
                at = next(k for k, line in enumerate(lines) if line.startswith("--- "))
                self.assertIn(name, lines[at])
                self.assertTrue(lines[at + 1].startswith("+++ "))
                self.assertIn(f"-{new}", lines)      # what is on disk goes
                self.assertIn(f"+{old}", lines)      # what is generated comes
                # Every line of the diff is a header, context, or the one change.
                self.assertRegex(lines[at + 2], r"^@@ -\d+,\d+ \+\d+,\d+ @@")
                for line in lines[at + 3:]:
                    if line[:1] == " ":
                        self.assertIn(line[1:], text.splitlines())
                    else:
                        self.assertIn(line, (f"-{new}", f"+{old}"))
                self.assertLess(len(lines), 15)      # three lines of context, not the file
                self.assertEqual(differences_of(self.check("--json", code=1)), [f"out/{name}"])
                path.write_text(text.replace(new, old, 1))
        self.check(code=0)

    def test_a_missing_file_and_an_empty_folder(self):
        (self.folder / "out/pendulum/pendulum.md").unlink()
        self.assertIn("pendulum.md", self.check(code=1))
        shutil.rmtree(self.folder / "out")
        out = self.check(code=1)
        for model in MODELS:
            for end in (".hpp", "_tables.hpp", ".md"):
                self.assertIn(f"{model.stem}{end}", out)

    def one_ulp(self, literal):
        """The next number of the scalar, as the file writes it."""
        suffix = "f" if literal.endswith("f") else ""      # hexadecimal digits end at the p
        number = float.fromhex(literal.removesuffix(suffix))
        following = number + math.copysign(math.ulp(number) * (2 ** 29 if suffix else 1), number)
        mantissa, exponent = following.hex().split("p")
        return f"{mantissa.rstrip('0').rstrip('.') if '.' in mantissa else mantissa}p{exponent}{suffix}"

    def test_one_weight_by_one_ulp(self):
        for scalar in ("double", "float"):
            run(ALGEST, "generate", *MODELS, "-o", self.folder / "out", "--scalar", scalar)
            name = "magnetic_bearing/magnetic_bearing_tables.hpp"
            path = self.folder / "out" / name
            text = path.read_text()
            body = text.index("weights[")
            literals = [m for m in re.finditer(r"-?0x1\.[0-9a-f]+p[+-]\d+f?(?=,)", text) if m.start() > body]
            for which in (0, len(literals) // 2):
                with self.subTest(scalar=scalar, which=which):
                    literal = literals[which]
                    path.write_text(text[:literal.start()] + self.one_ulp(literal[0]) + text[literal.end():])
                    out = self.check("--scalar", scalar, code=1)
                    self.assertIn(name, out)
                    summary = re.search(r"(\d+) rows? of weights changed, by at most (\d+) units? in the last place", out)
                    self.assertIsNotNone(summary, out)
                    self.assertEqual((summary[1], summary[2]), ("1", "1"))
                    self.assertNotIn("@@", out)              # a summary, no diff of numbers
                    self.assertEqual(len(out.splitlines()), 1)
            path.write_text(text)
            self.assertEqual(self.check("--scalar", scalar, code=0), "")

    def test_other_options_differ(self):
        out = self.check("--scalar", "float", code=1)
        for model in MODELS:
            self.assertIn(f"{model.stem}_tables.hpp", out)


def differences_of(text):
    return [d["path"] for model in json.loads(text)["models"] for d in model["differences"]]


if __name__ == "__main__":
    sys.stdout.reconfigure(line_buffering=True)
    unittest.main()
