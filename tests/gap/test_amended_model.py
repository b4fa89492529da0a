# SPDX-License-Identifier: GPL-3.0-or-later
"""The amended model goes on: it parses, derives, generates, compiles as a controller's code, and estimates on line what the report says."""
import json
import math
import resource
import subprocess
import tempfile
import unittest
from pathlib import Path

from discovery import attempt, discover, names, show
from environment import ALGEST, CXX, SOURCE, run
from filtered_samples import column
from hidden_plants import motor, spring

# Like tests/generated/test_compile.py: what a controller's compiler is told.
FLAGS = ["-std=c++17", "-O2", "-ffp-contract=off", "-fno-exceptions", "-fno-rtti", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Werror"]
QUARTERS = 4   # of a recording, whose estimates are independent: their spread is what the estimator's answer is worth


class AmendedModel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-amended-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, model, recording):
        (self.folder / "machine.toml").write_bytes(model.encode())
        (self.folder / "run.csv").write_text(recording, encoding="utf-8")
        return self.folder / "machine.toml", self.folder / "run.csv"

    def replay(self, model, recording, *options):
        """Last estimates, by name."""
        value = json.loads(run(ALGEST, "replay", model, recording, "--json", *options))
        return {p["name"]: p["last"] for p in value["parameters"]}

    def compiled(self, model, name, recording, signals, parameters):
        """Last estimates of the generated class, compiled as for a controller and fed the recording."""
        run(ALGEST, "generate", model, "-o", self.folder / "generated")
        type_name = "".join(word.capitalize() for word in name.split("_"))
        program = self.folder / "program.cpp"
        program.write_text("\n".join([
            "#include <cstdio>", f'#include "{name}/{name}.hpp"', "int main() {",
            f"    static algest::generated::{type_name} estimator;", f"    algest::generated::{type_name}::Sample s;",
            "    auto e = estimator.estimate();",
            '    while (std::scanf("{}", {}) == {}) e = estimator.step(s);'.format(" ".join(["%lf"] * len(signals)), ", ".join(f"&s.{x}" for x in signals), len(signals)),
            '    std::printf("%s{}\\n", algest::name(e.status), {});'.format(" %.17g" * len(parameters), ", ".join(f"e.{p}" for p in parameters)), "}", ""]), encoding="utf-8")
        run(CXX, *FLAGS, "-I", SOURCE / "runtime/include", "-I", self.folder / "generated", program, "-o", self.folder / "program")
        rows = zip(*[column(recording, x) for x in signals])
        said = subprocess.run([self.folder / "program"], input="".join(" ".join(map(repr, row)) + "\n" for row in rows), text=True, stdout=subprocess.PIPE, check=True).stdout.split()
        self.assertEqual(said[0], "ok")
        return dict(zip(parameters, map(float, said[1:])))

    def goes_on(self, model_text, recording_text, name, effect, parameter, truth, bias=lambda recording: 0.0):
        model, recording = self.write(model_text, recording_text)
        found = discover(model, recording, self.folder / "found")
        show(name, found)
        self.assertEqual((found["verdict"], names(found)), ("named", [effect]))
        (named,) = found["effects"][0]["parameters"]
        self.assertEqual(named["name"], parameter)
        self.text_survives(model, found)

        amended = Path(found["model"])
        run(ALGEST, "check", amended)
        derivation = run(ALGEST, "derive", amended)
        self.assertIn(parameter, derivation)
        on_line = self.replay(amended, recording)
        period = 1e-3
        end = period * (len(recording_text.splitlines()) - 2)
        quarters = [self.replay(amended, recording, "--from", f"{q * end / QUARTERS:.3f}", "--to", f"{(q + 1) * end / QUARTERS:.3f}")[parameter] for q in range(QUARTERS)]
        mean = sum(quarters) / QUARTERS
        spread = math.sqrt(sum((v - mean) ** 2 for v in quarters) / (QUARTERS - 1) / QUARTERS)   # of their mean: what all of it should know
        interval = 3 * math.hypot(named["sd"], spread) + bias(recording)
        print(f"   {parameter}: {truth} hidden, {named['value']:.6g} +- {named['sd']:.2g} reported, {on_line[parameter]:.6g} +- {spread:.2g} on line,"
              f" apart {abs(on_line[parameter] - named['value']):.2g} of {interval:.2g} allowed (bias {bias(recording):.2g})")
        self.assertLess(abs(on_line[parameter] - named["value"]), interval)
        self.assertLess(interval, 0.1 * truth, "an interval that allows everything shows nothing")
        # The truth is in the report's own interval, four standard deviations wide: three cases, and an sd that is itself an estimate.
        self.assertLess(abs(named["value"] - truth), 4 * named["sd"])

        parameters = list(on_line)
        signals = recording_text.splitlines()[0].replace(" ", ",").split(",")[2::2]
        self.assertEqual(self.compiled(amended, name, recording, signals, parameters), on_line)   # to the last bit
        return found

    def text_survives(self, model, found):
        """Every byte of the file is still there in order; the patch makes of the file what DIR holds."""
        before, after = model.read_bytes(), Path(found["model"]).read_bytes()
        place = 0
        for line in before.splitlines(keepends=True):
            if line.startswith(b"ode") and line not in after:   # the equation grew: up to its last quote, and from there on
                head, tail = line.rsplit(b'"', 1)
                place = after.index(head, place) + len(head)
                place = after.index(b'"' + tail, place)
                continue
            place = after.index(line, place) + len(line)
        copy = self.folder / "copy.toml"
        copy.write_bytes(before)
        run("patch", "--silent", "--binary", copy, found["patch"])
        self.assertEqual(copy.read_bytes(), after)
        self.assertEqual(model.read_bytes(), before)   # nothing was applied

    def test_dry_friction(self):
        """A noisy speed inside sgn(): samples within two standard deviations of standstill may have the wrong sign, and take from Tc at most
        their share, twice."""
        def bias(recording):
            w = column(recording, "w")
            return 0.01 * 2 * sum(abs(v) < 0.2 for v in w) / len(w)
        model, recording = motor("with_friction", friction=0.01, seed=2)
        self.goes_on(model, recording, "with_friction", "coulomb_friction", "Tc", 0.01, bias)

    def test_voltage_offset(self):
        model, recording = motor("with_offset", voltage_offset=0.4, seed=2)
        self.goes_on(model, recording, "with_offset", "voltage_offset", "V0", 0.4)

    def test_stiffening_spring(self):
        """x^3 of a noisy x is biased by 3 x noise^2: 1e-6 of itself here."""
        model, recording = spring("with_spring", cubic=6e4, seed=2)
        self.goes_on(model, recording, "with_spring", "cubic_stiffness", "k3", 6e4)

    def test_a_file_with_crlf_keeps_its_line_ends(self):
        model, recording = self.write(*spring("line_ends", cubic=6e4, seed=2))
        amended = Path(discover(model, recording, self.folder / "found")["model"]).read_bytes()
        self.assertEqual(amended.count(b"\n"), amended.count(b"\r\n"))

    def test_apply_writes_the_model_in_place(self):
        model_text, recording_text = spring("applied", cubic=6e4, seed=3)
        model, recording = self.write(model_text, recording_text)
        model.chmod(0o640)
        found = discover(model, recording, self.folder / "found", "--apply")
        self.assertEqual(model.read_bytes(), Path(found["model"]).read_bytes())
        self.assertNotEqual(model.read_bytes(), model_text.encode())
        self.assertEqual(model.stat().st_mode & 0o777, 0o640)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["found", "machine.toml", "run.csv"])
        # What was named is in the model now: nothing is left to find, and --apply leaves the file alone.
        amended = model.read_bytes()
        again = discover(model, recording, self.folder / "again", "--apply")
        self.assertEqual((again["verdict"], again["model"]), ("none", None))
        self.assertEqual(model.read_bytes(), amended)

    def test_a_disk_that_is_full_leaves_the_model_as_it_was(self):
        model_text, recording_text = spring("full", cubic=6e4, seed=3)
        model, recording = self.write(model_text, recording_text)
        command = [ALGEST, "discover", model, recording, "-o", self.folder / "found", "--apply"]
        # No file may grow beyond 16 KiB: the model fits, the runs do not. Python ignores SIGXFSZ, and its child inherits that.
        done = subprocess.run(command, text=True, capture_output=True, restore_signals=False, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (16384, 16384)))
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("cannot be written", done.stderr)
        self.assertEqual(model.read_bytes(), model_text.encode())
        self.assertEqual([p for p in self.folder.rglob("*") if p.is_file() and p.name not in ("machine.toml", "run.csv")], [])

    def test_a_report_that_cannot_be_written_leaves_the_model_as_it_was(self):
        model_text, recording_text = spring("no_report", cubic=6e4, seed=3)
        model, recording = self.write(model_text, recording_text)
        (self.folder / "found" / "report.html").mkdir(parents=True)
        self.assertEqual(attempt(model, recording, self.folder / "found", "--apply").returncode, 2)
        self.assertEqual(model.read_bytes(), model_text.encode())

    def test_without_apply_the_model_stays_even_where_dir_is_its_own_folder(self):
        model_text, recording_text = spring("beside", cubic=6e4, seed=3)
        model, recording = self.write(model_text, recording_text)
        attempt(model, recording, self.folder)
        self.assertEqual(model.read_bytes(), model_text.encode())


if __name__ == "__main__":
    unittest.main()
