# SPDX-License-Identifier: GPL-3.0-or-later
"""The contract of the command line: exit codes, what goes to which stream, JSON, files."""
import json
import math
import os
import pty
import re
import subprocess
import unittest

from command_line import HEADER, L, R, RL_CIRCUIT, CommandLine, coil_rows, csv
from environment import ALGEST, SOURCE


class Parsing(CommandLine):
    def test_help_and_version(self):
        out, err = self.algest("--help")
        for command in ("check", "derive", "generate", "replay"):
            self.assertRegex(out, rf"(?m)^  {command}\b")
        self.assertEqual(err, "")
        out, _ = self.algest("--version")
        self.assertRegex(out, r"^algest \d+\.\d+\.\d+\n$")

    def test_every_command_shows_examples_that_parse(self):
        for command in ("check", "derive", "generate", "replay"):
            out, _ = self.algest(command, "--help")
            self.assertEqual(out, self.algest("help", command)[0])
            examples = re.findall(rf"(?m)^  algest ({command} .*)$", out)
            self.assertGreaterEqual(len(examples), 2, out)
            for example in examples:     # the files do not exist here: what is complained of must be they
                words = example.split(" > ")[0].split()
                _, err = self.algest(*words, exit_code=2)
                self.assertNotIn("--help", err, example)

    def test_what_cannot_be_parsed_is_bad_input(self):
        for words in ([], ["nonsense"], ["check"], ["replay", "rl.toml"], ["check", "rl.toml", "--nonsense"],
                      ["generate", "rl.toml", "--scalar", "half"], ["generate", "rl.toml", "--engine", "steam"],
                      ["derive", "rl.toml", "--format", "pdf"], ["derive", "rl.toml", "two.toml"],
                      ["replay", "rl.toml", "coil.csv", "--from", "soon"]):
            out, err = self.algest(*words, exit_code=2)
            self.assertEqual(out, "")
            self.assertRegex(err, r"^algest: error: .*--help")
            self.assertEqual(list(self.algest_json(*words, exit_code=2)), ["error"])
        self.assertEqual(self.files(), ["coil.csv", "rl.toml"])

    def test_model_and_recording_in_each_others_place(self):
        for words in (["replay", "coil.csv", "rl.toml"], ["replay", "coil.csv", "coil.csv", "rl.toml"], ["design", "coil.csv", "rl.toml"], ["simulate", "coil.csv", "rl.toml"], ["discover", "coil.csv", "rl.toml", "-o", "found"]):
            _, err = self.algest(*words, exit_code=2)
            self.assertIn(f"'coil.csv' stands where the model belongs and a .toml among the recordings: they look swapped; algest {words[0]} MODEL RECORDING", err)
            self.assertEqual(list(self.algest_json(*words, exit_code=2)), ["error"])

    def test_output_that_cannot_be_written_is_an_error(self):
        with open("/dev/full", "wb") as full:
            result = subprocess.run([ALGEST, "derive", "rl.toml"], cwd=self.folder, stdout=full, stderr=subprocess.PIPE)
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"standard output", result.stderr)

    def test_colour_is_for_terminals_alone(self):
        self.assertNotIn("\x1b", self.algest("check", "nothing.toml", exit_code=2)[1])
        for no_colour, expected in ((None, True), ("1", False)):
            environment = {k: v for k, v in os.environ.items() if k != "NO_COLOR"}
            if no_colour:
                environment["NO_COLOR"] = no_colour
            ours, theirs = pty.openpty()
            subprocess.run([ALGEST, "check", "nothing.toml"], cwd=self.folder, stderr=theirs, env=environment)
            os.close(theirs)
            self.assertEqual(b"\x1b[" in os.read(ours, 10000), expected)
            os.close(ours)


class Check(CommandLine):
    def test_a_sound_model(self):
        out, err = self.algest("check", "rl.toml")
        self.assertEqual(out, "rl.toml: ok\n")
        self.assertEqual(err, "")
        self.assertEqual(self.algest_json("check", "rl.toml"), {"models": [{"model": "rl.toml", "ok": True, "warnings": []}]})

    def test_all_models_are_checked_and_the_worst_counts(self):
        self.write("broken.toml", RL_CIRCUIT.replace("u - R*i", "u - R*("))
        out, err = self.algest("check", "broken.toml", "rl.toml", exit_code=2)
        self.assertEqual(out, "rl.toml: ok\n")
        line = RL_CIRCUIT.splitlines().index('ode = "L*der(i) = u - R*i"') + 1
        self.assertRegex(err, rf"(?m)^broken\.toml:{line}:\d+: error: [^;]+; .+$")
        value = self.algest_json("check", "rl.toml", "broken.toml", exit_code=2)
        self.assertEqual([m["ok"] for m in value["models"]], [True, False])
        self.assertEqual([(e["file"], e["line"], e["severity"]) for e in value["error"]], [("broken.toml", line, "error")])

    def test_a_missing_unit_is_a_warning_and_with_strict_an_error(self):
        self.write("no_unit.toml", RL_CIRCUIT.replace('i = { unit = "A" }', "i = {}"))
        out, err = self.algest("check", "no_unit.toml")
        self.assertEqual(out, "no_unit.toml: ok\n")
        self.assertIn("warning", err)
        self.assertIn("error", self.algest("check", "no_unit.toml", "--strict", exit_code=2)[1])

    def test_where_the_format_is_described(self):
        self.write("torn.toml", "[signals\n")
        _, err = self.algest("check", "torn.toml", exit_code=2)
        self.assertIn("torn.toml:1:", err)
        self.assertIn("docs/model-file.md", err)

    def test_which_parameters_have_to_be_known(self):
        """Of a*b*i only the product is seen, of c*d*i^2 too: one of each pair. Any two of the four would not do."""
        self.write("open.toml", RL_CIRCUIT.replace("u - R*i", "u - a*b*i - c*d*i^2").replace("R = { unit = \"ohm\", initial = 1 }", "a = { initial = 1 }\nb = { initial = 1 }\nc = { initial = 1 }\nd = { initial = 1 }").replace('unit = "V"', "").replace('unit = "A"', ""))
        _, err = self.algest("check", "open.toml", exit_code=1)
        self.assertIn("declare 2 of a, b, c, d, e.g. a and c under [constants]", err)
        self.write("open.toml", RL_CIRCUIT.replace("u - R*i", "u - R*k*i").replace("R = {", 'k = { unit = "1", initial = 1 }\nR = {'))
        _, err = self.algest("check", "open.toml", exit_code=1)
        self.assertIn("declare one of k, R under [constants]", err)   # L is seen

    def test_a_parameter_that_no_row_sees_is_answered_with_no(self):
        # kappa = 1 annihilates the constant that c adds
        self.write("blind.toml", RL_CIRCUIT.replace("u - R*i", "u - R*i - c").replace(
            "[[equation]]", 'c = { unit = "V" }\n\n[[equation]]') + "kappa = 1\n")
        _, err = self.algest("check", "blind.toml", exit_code=1)
        self.assertRegex(err, r"blind\.toml:\d+:\d+: not identifiable: ")
        self.assertEqual(self.algest_json("check", "blind.toml", exit_code=1)["error"][0]["severity"], "not identifiable")
        self.algest("check", "blind.toml", "nothing.toml", exit_code=2)


class Derive(CommandLine):
    def test_formats(self):
        text, _ = self.algest("derive", "rl.toml")
        self.assertIn("coil", text)
        latex, _ = self.algest("derive", "rl.toml", "--format", "latex")
        self.assertIn("\\", latex)
        value = self.algest_json("derive", "rl.toml")
        self.assertEqual(value["name"], "rl")
        self.assertEqual([p["name"] for p in value["parameters"]], ["R", "L"])
        terms = [t for e in value["equations"] for r in e["rows"] for t in r["terms"]]
        self.assertFalse(any("weights" in t for t in terms))
        self.write("two.toml", RL_CIRCUIT + "[estimator]\nform = 2\n")
        text, _ = self.algest("derive", "two.toml")
        self.assertIn("Pi = d^(1+p-1)/ds^(1+p-1)", text)
        self.assertIn("i = 1, p = 2:  2 Y^(1) + s Y^(2)", text)       # two derivatives of s Y
        self.assertEqual(self.algest_json("derive", "two.toml")["equations"][0]["form"], 2)
        value = self.algest_json("derive", "rl.toml", "--weights")
        terms = [t for e in value["equations"] for r in e["rows"] for t in r["terms"]]
        self.assertTrue(all(len(t["weights"]) == 51 for t in terms))     # 0.05 s at 1 ms


    def test_the_unit_of_a_perturbation_is_one_of_its_equation(self):
        """J*der(w) is in kg.m^2.rad/s^2, as UDUNITS has it m2.kg.s-2.rad; K*i says N.m."""
        self.write("load.toml", """\
name = "load"
[sampling]
period = 1e-3
window = 0.1
[signals]
i = { unit = "A" }
w = { unit = "rad/s" }
[constants]
K = { value = 0.06, unit = "N.m/A" }
[parameters]
J = { unit = "kg.m^2", initial = 2e-4 }
[[equation]]
ode = "J*der(w) = K*i"
kappa = 2
perturbation = "load"
""")
        out, _ = self.algest("derive", "load.toml", "--format", "json")
        self.assertEqual([(p["name"], p["unit"]) for p in json.loads(out)["equations"][0]["perturbation"]], [("load1", "N.m"), ("load2", "N.m/s")])


class Generate(CommandLine):
    FILES = ["rl/rl.hpp", "rl/rl.md", "rl/rl_tables.hpp"]

    def test_writes_into_generated_unless_told_otherwise(self):
        out, err = self.algest("generate", "rl.toml")
        self.assertEqual(out, "")
        self.assertEqual(self.files(), ["coil.csv"] + [f"generated/{f}" for f in self.FILES] + ["rl.toml"])
        for file in self.FILES:
            self.assertIn(f"wrote generated/{file}\n", err)
        value = self.algest_json("generate", "rl.toml", "-o", "a/b")
        self.assertEqual(sorted(value["models"][0]["written"]), [f"a/b/{f}" for f in self.FILES])
        self.assertEqual((value["models"][0]["model"], value["models"][0]["name"]), ("rl.toml", "rl"))
        for file in self.FILES:
            self.assertEqual((self.folder / "generated" / file).read_bytes(), (self.folder / "a/b" / file).read_bytes())

    def test_says_what_each_engine_costs(self):
        def costs(window, *options):
            self.write("sized.toml", RL_CIRCUIT.replace("window = 0.05", f"window = {window}"))
            [model] = self.algest_json("generate", "sized.toml", *options)["models"]
            return {cost["engine"]: cost for cost in model["cost"]}, [cost["engine"] for cost in model["cost"]]
        short, order = costs(0.05)
        long, _ = costs(5)
        self.assertEqual(order, ["fir", "moments"])
        self.assertEqual(costs(5, "--engine", "moments")[1], ["moments", "fir"])
        # two rows of three functionals each, a product and a sum for each of 51 samples, and for the 16 that rounding is measured by (dot_sizes)
        self.assertEqual(short["fir"]["operations"], 2 * 6 * (51 + 16))
        self.assertEqual(long["fir"]["operations"], 2 * 6 * (5001 + 16))
        self.assertEqual(short["fir"]["tables"] * 5001, long["fir"]["tables"] * 51)
        for what in ("operations", "tables"):
            self.assertEqual(short["moments"][what], long["moments"][what])
        self.assertLess(long["moments"]["memory"], long["fir"]["memory"] / 1.9)   # each sample once, not twice
        _, err = self.algest("generate", "sized.toml")
        self.assertRegex(err, "engine fir: 60204 operations a sample, [0-9]+ bytes of memory, [0-9]+ of tables; moments: ")

    def test_a_model_that_moments_cannot_serve_is_generated_with_fir(self):
        self.write("simpson.toml", RL_CIRCUIT + '[estimator]\nquadrature = "simpson"\n')
        _, err = self.algest("generate", "simpson.toml", "--engine", "moments")
        self.assertIn("engine fir instead of moments: Simpson's weights alternate", err)
        self.assertIn("engine fir", (self.folder / "generated/rl/rl.hpp").read_text())

    def test_models_without_polynomial_kernels_fall_back_to_fir_too(self):
        averages = (SOURCE / "models/pmsm_sensorless.toml").read_text()
        self.write("asking.toml", averages.replace("[estimator]\n", '[estimator]\nengine = "moments"\n'))
        asked = ("servo", "pmsm_sensorless", "drive_train")   # derivatives, averages, discrete
        for arguments, fallen in ((["asking.toml"], 1), (["rl.toml", *(SOURCE / f"models/{name}.toml" for name in asked), "--engine", "moments"], 3)):
            _, err = self.algest("generate", *arguments)
            self.assertEqual(err.count("engine fir instead of moments: only the annihilator has polynomial kernels on windows"), fallen)
        self.assertIn("engine fir", (self.folder / "generated/servo/servo.hpp").read_text())
        self.assertIn("engine moments", (self.folder / "generated/rl/rl.hpp").read_text())
        self.write("growing.toml", averages.replace("[sampling]\n", "[sampling]\ngrowing = true\n"))
        _, err = self.algest("generate", "growing.toml", exit_code=2)
        self.assertIn("growing windows are for the annihilator", err)

    def test_where_no_noise_is_declared(self):
        """A step declares noise of step/sqrt(12): the same estimator as with that noise, to rounding."""
        _, err = self.algest("generate", "rl.toml", "-o", "out")
        self.assertIn("rl.toml: note: no signal declares its noise", err)
        deviations = []
        for declared in ("noise = 1e-3", "resolution = 3.4641016151377546e-3"):
            self.write("noisy.toml", RL_CIRCUIT.replace('i = { unit = "A" }', f'i = {{ unit = "A", {declared} }}'))
            _, err = self.algest("generate", "noisy.toml", "-o", "out")
            self.assertNotIn("no signal declares its noise", err)
            deviations.append([p["sd"] for p in self.algest_json("replay", "noisy.toml", "coil.csv")["parameters"]])
        for a, b in zip(*deviations):
            self.assertAlmostEqual(a / b, 1, delta=1e-12)   # 12 digits of the root of 12

    def test_robust_in_single_precision_says_what_it_refuses(self):
        robust = RL_CIRCUIT + '[estimator]\nsolve = "robust"\n'
        self.write("robust.toml", robust)
        self.assertIn("a condition above 92 singular", self.algest("generate", "robust.toml", "-o", "out", "--scalar", "float")[1])
        self.assertNotIn("above 92", self.algest("generate", "robust.toml", "-o", "out")[1])
        self.write("robust.toml", robust + "condition_limit = 300\n")
        self.assertNotIn("above 92", self.algest("generate", "robust.toml", "-o", "out", "--scalar", "float")[1])

    def test_check_writes_nothing_and_shows_the_difference(self):
        out, _ = self.algest("generate", "rl.toml", "--check", exit_code=1)
        self.assertIn("rl.hpp", out)
        self.assertEqual(self.files(), ["coil.csv", "rl.toml"])

        self.algest("generate", "rl.toml")
        self.assertEqual(self.algest("generate", "rl.toml", "--check")[0], "")
        self.assertEqual(self.algest_json("generate", "rl.toml", "--check")["models"][0]["differences"], [])

        header = self.folder / "generated/rl/rl.hpp"
        before = header.read_text()
        header.write_text(before + "// an edit\n")
        out, _ = self.algest("generate", "rl.toml", "--check", exit_code=1)
        self.assertIn("-// an edit", out)
        self.assertEqual(header.read_text(), before + "// an edit\n")
        value = self.algest_json("generate", "rl.toml", "--check", exit_code=1)
        self.assertEqual([d["path"] for d in value["models"][0]["differences"]], ["generated/rl/rl.hpp"])

    def test_check_shows_a_last_line_without_end_as_diff_does(self):
        self.algest("generate", "rl.toml")
        for file in self.FILES:
            path = self.folder / "generated" / file
            whole = path.read_bytes()
            path.write_bytes(whole[:-1])
            out, _ = self.algest("generate", "rl.toml", "--check", exit_code=1)
            if file.endswith("_tables.hpp"):
                self.assertIn("0 rows of weights changed", out)
                self.assertIn("1 other lines changed", out)
            else:
                with open(self.folder / "whole", "wb") as copy:
                    copy.write(whole)
                diff = subprocess.run(["diff", "-u", path, self.folder / "whole"], stdout=subprocess.PIPE).stdout.decode()
                self.assertIn("\\ No newline at end of file", diff)
                self.assertEqual(out.splitlines()[2:], diff.splitlines()[2:])
            path.write_bytes(whole)

    def test_options_reach_the_estimator(self):
        self.algest("generate", "rl.toml", "--scalar", "float")
        self.assertIn("float", (self.folder / "generated/rl/rl.hpp").read_text())
        self.algest("generate", "rl.toml", "--check", "--scalar", "double", exit_code=1)

    def test_a_model_that_fails_leaves_nothing_and_the_others_are_written(self):
        self.write("broken.toml", RL_CIRCUIT.replace('"rl"', '"broken"').replace("u - R*i", "u - R*("))
        self.algest("generate", "broken.toml", "rl.toml", exit_code=2)
        self.assertEqual(self.files(), ["broken.toml", "coil.csv"] + [f"generated/{f}" for f in self.FILES] + ["rl.toml"])

    def test_two_models_of_one_name_are_refused(self):
        self.write("again.toml", RL_CIRCUIT)
        _, err = self.algest("generate", "rl.toml", "again.toml", exit_code=2)
        self.assertRegex(err, r"again\.toml: error: .*`rl`.*rl\.toml")
        self.assertEqual(self.files(), ["again.toml", "coil.csv", "rl.toml"])

    def test_a_folder_that_cannot_be_written_leaves_nothing(self):
        self.write("taken", "a file where the folder should be")
        _, err = self.algest("generate", "rl.toml", "-o", "taken", exit_code=2)
        self.assertIn("taken", err)
        (self.folder / "out/rl/rl.md").mkdir(parents=True)
        self.algest("generate", "rl.toml", "-o", "out", exit_code=2)
        self.assertEqual(self.files(), ["coil.csv", "rl.toml", "taken"])


class Replay(CommandLine):
    def test_json(self):
        value = self.algest_json("replay", "rl.toml", "coil.csv")
        self.assertEqual(list(value), ["model", "recording", "samples", "period_s", "parameters", "status", "condition", "notes"])
        self.assertEqual((value["model"], value["recording"]), ("rl.toml", "coil.csv"))
        self.assertEqual((value["samples"], value["period_s"]), (200, 0.001))
        self.assertEqual(value["status"], {"filling": 50, "ok": 150, "singular": 0, "rejected": 0})   # 51 samples fill 0.05 s
        for parameter, (name, unit, true_value) in zip(value["parameters"], (("R", "ohm", R), ("L", "H", L))):
            self.assertEqual(list(parameter), ["name", "unit", "last", "median", "sd", "bias"])
            self.assertEqual((parameter["name"], parameter["unit"], parameter["sd"]), (name, unit, None))
            self.assertAlmostEqual(parameter["last"] / true_value, 1, delta=1e-3)
            self.assertAlmostEqual(parameter["median"] / true_value, 1, delta=1e-3)
        self.assertGreaterEqual(value["condition"]["last"], 1)

    def test_text_for_people_has_the_units(self):
        out, _ = self.algest("replay", "rl.toml", "coil.csv")
        self.assertRegex(out, r"(?m)^R +[0-9.]+ +[0-9.]+  ohm$")
        self.assertRegex(out, r"(?m)^L +[0-9.]+ +[0-9.]+  H$")
        self.assertIn("filling 50, ok 150, singular 0, rejected 0", out)

    def test_csv(self):
        out, err = self.algest("replay", "rl.toml", "coil.csv", "-o", "e.csv")
        self.assertIn("wrote e.csv", err)
        lines = (self.folder / "e.csv").read_text().splitlines()
        self.assertEqual(lines[0], "t [s],status,condition,R [ohm],L [H]")
        self.assertEqual(len(lines), 201)
        self.assertEqual(lines[1], "0,filling,,1,1")
        self.assertTrue(lines[51].startswith("0.05,ok,"))
        value = self.algest_json("replay", "rl.toml", "coil.csv")
        last = lines[-1].split(",")
        self.assertEqual([float(last[3]), float(last[4])], [p["last"] for p in value["parameters"]])
        self.assertEqual(float(last[2]), value["condition"]["last"])

    def test_standard_deviations_where_noise_is_declared(self):
        found, biases = [], []
        for noise in ("1e-3", "2e-3"):
            self.write("noisy.toml", RL_CIRCUIT.replace('i = { unit = "A" }', f'i = {{ unit = "A", noise = {noise} }}') + "[estimator]\ndeviation_limit = 0\n")   # however large
            value = self.algest_json("replay", "noisy.toml", "coil.csv", "-o", "e.csv")
            rows = [line.split(",") for line in (self.folder / "e.csv").read_text().splitlines()]
            self.assertEqual(rows[0][3:], ["R [ohm]", "L [H]", "sd(R) [ohm]", "sd(L) [H]"])
            self.assertEqual(rows[1][5:], ["", ""])          # no estimate, no deviation
            self.assertTrue(all(row[5] for row in rows[51:]))    # fewer than 500 samples: all of them
            found.append([p["sd"] for p in value["parameters"]])
            self.assertEqual([float(cell) for cell in rows[-1][5:]], found[-1])
            alone = self.algest_json("replay", "noisy.toml", "coil.csv")     # without a CSV: that of the last estimate
            self.assertEqual([p["sd"] for p in alone["parameters"]], found[-1])
            out, _ = self.algest("replay", "noisy.toml", "coil.csv")
            self.assertRegex(out, r"(?m)^parameter +last +sd +bias +median")
            biases.append([p["bias"] for p in value["parameters"]])
        for one, two in zip(*found):     # twice the noise: linear, but for the rounding of 1e-3 itself
            self.assertGreater(one, 0)
            self.assertAlmostEqual(two / one, 2, delta=1e-9)
        for one, two in zip(*biases):    # of second order in the noise
            self.assertAlmostEqual(two / one, 4, delta=1e-9)

    def test_a_stretch(self):
        value = self.algest_json("replay", "rl.toml", "coil.csv", "--from", "0.1", "--to", "0.16")
        self.assertEqual(value["samples"], 61)
        self.assertEqual(value["status"]["ok"], 11)
        self.algest("replay", "rl.toml", "coil.csv", "--from", "-5", "--to", "1e9")
        for stretch in (["--from", "0.16", "--to", "0.1"], ["--from", "5"], ["--to", "0.02"], ["--from", "nan"]):
            _, err = self.algest("replay", "rl.toml", "coil.csv", "-o", "e.csv", *stretch, exit_code=2)
            self.assertIn("--from", err)
        self.assertEqual(self.files(), ["coil.csv", "rl.toml"])

    def test_other_units_and_columns_make_no_difference(self):
        expected = self.algest_json("replay", "rl.toml", "coil.csv")
        rows = [(i * 1000, 0, t * 1000, u / 1000) for t, u, i in coil_rows(200)]
        self.write("other.csv", b"\xef\xbb\xbf" + csv(rows, "i [mA],x [counts; 8192 per rev],t [ms],u [kV]", "\r\n").encode())
        found = self.algest_json("replay", "rl.toml", "other.csv")
        for a, b in zip(expected["parameters"], found["parameters"]):
            self.assertAlmostEqual(b["median"] / a["median"], 1, delta=1e-9)

    def test_degrees_are_no_turns(self):
        """An angular speed in degrees is converted and not warned of; one in Hz is, since UDUNITS takes a turn for a radian."""
        model = RL_CIRCUIT.replace("[parameters]", 'w = { unit = "rad/s" }\n[parameters]').replace("u - R*i", "u - R*i - k*w").replace("[[equation]]", 'k = { unit = "V.s/rad", initial = 1 }\n[[equation]]')
        self.write("turning.toml", model)
        for unit, warned in (("\u00b0/s", False), ("degree/s", False), ("Hz", True)):
            self.write("turning.csv", csv([(*row, row[1] + row[0]) for row in coil_rows(200)], HEADER + f",w [{unit}]"))
            _, err = self.algest("replay", "turning.toml", "turning.csv")
            self.assertEqual("read as an angular speed" in err, warned, unit)

    def test_a_current_that_bends_between_samples(self):
        """docs/controller.md: L/R = 1.4 periods. Over a period L (i1 - i0) = T (u - R (i0 + i1)/2) holds for lines with L' = R T/2 coth(T R/(2 L)) in L's place."""
        period, resistance = 1e-3, 2.0
        inductance = 1.4 * period * resistance
        x = period * resistance / (2 * inductance)
        decay, i, rows = math.exp(-2 * x), 0.0, []
        for k in range(400):
            u = 3 * math.sin(0.31 * k) + 2 * math.sin(0.047 * k)
            rows.append((k / 1000, u, i))
            i = decay * i + (1 - decay) * u / resistance
        self.write("fast.csv", csv(rows))
        self.write("fast.toml", RL_CIRCUIT.replace('u = { unit = "V" }', 'u = { unit = "V", hold = "zoh" }'))
        found = {p["name"]: p["median"] for p in self.algest_json("replay", "fast.toml", "fast.csv")["parameters"]}
        # Fifty periods a window: the kernel bends by (1/50)^2 within one, times the few percent at stake.
        self.assertAlmostEqual(found["L"] / inductance, x / math.tanh(x), delta=2e-3)
        self.assertAlmostEqual(x / math.tanh(x), 1.042, delta=1e-3)
        self.assertAlmostEqual(found["R"] / resistance, 1, delta=2e-3)

    def test_an_output_that_would_destroy_an_input_is_refused(self):
        for name in ("coil.csv", "rl.toml"):
            before = (self.folder / name).read_bytes()
            self.algest("replay", "rl.toml", "coil.csv", "-o", f"./{name}", exit_code=2)
            self.assertEqual((self.folder / name).read_bytes(), before)

    def test_an_output_that_cannot_be_written_is_an_error_and_no_result_is_printed(self):
        out, err = self.algest("replay", "rl.toml", "coil.csv", "-o", "no/folder.csv", exit_code=2)
        self.assertEqual(out, "")
        self.assertIn("no/folder.csv: error: cannot be written", err)

    def test_failures_of_model_and_recording_are_shown_together(self):
        value = self.algest_json("replay", "nothing.toml", "nothing.csv", exit_code=2)
        self.assertEqual([e["file"] for e in value["error"]], ["nothing.csv", "nothing.toml"])


if __name__ == "__main__":
    unittest.main()
