# SPDX-License-Identifier: GPL-3.0-or-later
"""What discover says of a motor with dry friction hidden, or nothing."""
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST
from hidden_motor import MODEL, TC, recording

SEAL = """\
name = "seal_friction"
summary = "friction of my seal"
[enters]
units = ["N.m"]
[roles]
speed = "speed"
[rewrite]
kind = "add_term"
term = "-Tseal*sgn({speed})"
[[parameter]]
name = "Tseal"
unit = "{equation}"
min = 0
"""


class HiddenEffect(unittest.TestCase):
    def discover(self, folder, friction, *more, model=MODEL):
        (folder / "motor.toml").write_text(model)
        (folder / "run.csv").write_text(recording(friction, 7))
        done = subprocess.run([ALGEST, "discover", folder / "motor.toml", folder / "run.csv", "-o", folder / "found", "--json", *more],
                              text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_friction_is_named_written_into_the_model_and_estimated_on_line(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            found = self.discover(folder, TC)
            self.assertEqual(found["verdict"], "named")
            self.assertEqual([e["name"] for e in found["effects"]], ["coulomb_friction"])
            self.assertEqual(found["effects"][0]["equation"], "torque balance")
            self.assertAlmostEqual(found["effects"][0]["parameters"][0]["value"], TC, delta=0.05 * TC)   # the bar
            where = max(found["where"], key=lambda w: w["share"])
            self.assertEqual((where["equation"], where["region"]), ("torque balance", "follows the sign of w"))
            self.assertGreater(where["share"], 0.9)   # the other equation holds nothing but noise
            for output in found["outputs"]:
                self.assertLess(output["nrmse_after"], 1.2 * output["noise_floor"], output)
                self.assertGreater(output["nrmse_before"], 2 * output["nrmse_after"], output)
            amended = Path(found["model"]).read_text()
            for line in MODEL.splitlines():   # every line stands, the equation is longer
                self.assertIn(line.rstrip('"'), amended)
            subprocess.run(["patch", "-s", folder / "motor.toml", found["patch"]], check=True)
            self.assertEqual((folder / "motor.toml").read_text(), amended)
            # On line: least squares of the amended model's rows sees the new parameter.
            online = amended.replace("period = 1e-3   # s", "period = 1e-3\nwindow = 0.03") + '\n[estimator]\nsolve = "least_squares"\n'
            (folder / "online.toml").write_text(online)
            replay = subprocess.run([ALGEST, "replay", folder / "online.toml", folder / "run.csv", "--json"], text=True, capture_output=True)
            self.assertEqual(replay.returncode, 0, replay.stderr)
            values = {p["name"]: p["last"] for p in json.loads(replay.stdout)["parameters"]}
            self.assertAlmostEqual(values["Tc"], TC, delta=0.1 * TC)   # noisy speed inside sgn() at low speed: a bias of some percent

    def test_a_model_in_multiples_of_si_units_gets_its_term_in_them(self):
        model = MODEL
        for old, new in (('[parameters]', 'Kt = { value = 50, unit = "mN.m/A" }\n\n[parameters]'), ('K*i - b*w', 'Kt*i - b*w'),
                         ('J = { initial = 3e-4, unit = "kg.m^2"', 'J = { initial = 0.3, unit = "mN.m.s^2/rad"'),
                         ('b = { initial = 1e-4, unit = "N.m.s/rad"', 'b = { initial = 0.1, unit = "mN.m.s/rad"')):
            self.assertIn(old, model)
            model = model.replace(old, new)
        with tempfile.TemporaryDirectory() as name:
            found = self.discover(Path(name), TC, model=model)
            self.assertEqual([e["name"] for e in found["effects"]], ["coulomb_friction"])
            friction = found["effects"][0]["parameters"][0]
            self.assertEqual(friction["unit"], "mN.m")
            self.assertAlmostEqual(friction["value"], 1000 * TC, delta=0.05 * 1000 * TC)   # as above

    def test_nothing_is_named_where_nothing_is_hidden(self):
        with tempfile.TemporaryDirectory() as name:
            found = self.discover(Path(name), 0.0)
            self.assertEqual((found["verdict"], found["effects"], found["model"]), ("none", [], None))

    def test_a_later_run_takes_back_what_an_earlier_one_wrote(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.discover(folder, TC)
            self.assertTrue((folder / "found" / "motor.patch").exists())
            self.discover(folder, 0.0)
            self.assertEqual(sorted(p.name for p in (folder / "found").iterdir()), ["after.csv", "before.csv", "report.html"])

    def test_only_what_is_named_is_applied(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            found = self.discover(folder, TC, "--apply")
            self.assertEqual((folder / "motor.toml").read_text(), Path(found["model"]).read_text())
            (folder / "effects").mkdir()
            (folder / "effects" / "seal.toml").write_text(SEAL)
            found = self.discover(folder, TC, "--apply")
            self.assertEqual(found["verdict"], "ambiguous")
            self.assertEqual((folder / "motor.toml").read_text(), MODEL)

    def test_a_folder_that_cannot_be_is_refused_before_the_search(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "motor.toml").write_text(MODEL)
            (folder / "run.csv").write_text(recording(TC, 7))
            done = subprocess.run([ALGEST, "discover", folder / "motor.toml", folder / "run.csv", "-o", folder / "run.csv" / "found"], text=True, capture_output=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("choose another one for -o", done.stderr)

    def test_a_declared_sensor_without_a_column(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "motor.toml").write_text(MODEL)
            (folder / "run.csv").write_text(recording(TC, 7).replace("w [rad/s]", "omega [rad/s]", 1))
            for command in (["discover", "motor.toml", "run.csv", "-o", "found"], ["simulate", "motor.toml", "run.csv"]):
                done = subprocess.run([ALGEST, *command], cwd=folder, text=True, capture_output=True)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn("'w' is declared as measured, but the recording has no column 'w'; there are", done.stderr)
                self.assertFalse((folder / "found").exists())

    def test_a_user_teaches_an_effect_by_adding_a_file(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "effects").mkdir()
            (folder / "effects" / "seal.toml").write_text(SEAL)
            found = self.discover(folder, TC)
            # The same term as coulomb_friction: the data cannot tell the two apart, and discover says so.
            self.assertEqual(found["verdict"], "ambiguous")
            self.assertEqual(sorted(sum(found["alternatives"], [])), ["coulomb_friction", "seal_friction"])

    def test_bad_stretches(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "motor.toml").write_text(MODEL)
            (folder / "run.csv").write_text(recording(0.0, 1))
            for option in (["--train", "5"], ["--train", "4:1"], ["--test", "a:b"], ["--train", "0:0.02"]):
                done = subprocess.run([ALGEST, "discover", folder / "motor.toml", folder / "run.csv", "-o", folder / "found", *option], text=True, capture_output=True)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertFalse((folder / "found").exists())


if __name__ == "__main__":
    unittest.main()
