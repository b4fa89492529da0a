# SPDX-License-Identifier: GPL-3.0-or-later
"""A DC motor simulated here, by a simulator of its own, with dry friction hidden or nothing: what discover says of it."""
import json
import math
import random
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST

MODEL = """# my motor
name = "bench_motor"

[sampling]
period = 1e-3   # s

[signals]
u = { unit = "V", hold = "zoh" }
i = { unit = "A", noise = 0.005, initial = 0 }
w = { unit = "rad/s", noise = 0.1, initial = 0 }

[constants]
L = { value = 0.002, unit = "H" }
K = { value = 0.05, unit = "N.m/A" }

[parameters]
R = { initial = 1.2, unit = "ohm", min = 0 }
J = { initial = 3e-4, unit = "kg.m^2", min = 0 }
b = { initial = 1e-4, unit = "N.m.s/rad", min = 0 }   # bearing

[[equation]]
name = "voltage balance"
ode = "L*der(i) = u - R*i - K*w"

[[equation]]
name = "torque balance"
ode = "J*der(w) = K*i - b*w"
"""
TC = 0.01   # N.m, hidden


def recording(friction, seed):
    """Runge-Kutta with 20 steps a sample; R = 1, J = 2.5e-4, b = 2e-4; steps of voltage both ways every 0.12 s."""
    random.seed(seed)
    R, L, K, J, b = 1.0, 0.002, 0.05, 2.5e-4, 2e-4
    i = w = u = 0.0
    lines = ["t [s],u [V],i [A],w [rad/s]"]

    def rate(i, w):
        return (u - R * i - K * w) / L, (K * i - b * w - friction * math.tanh(w / 0.02)) / J

    for k in range(5000):
        if k % 120 == 0:
            u = random.uniform(-8, 8)
        lines.append(f"{k * 1e-3:.3f},{u:.6f},{i + random.gauss(0, 0.005):.6f},{w + random.gauss(0, 0.1):.5f}")
        h = 1e-3 / 20
        for _ in range(20):
            a1 = rate(i, w)
            a2 = rate(i + h / 2 * a1[0], w + h / 2 * a1[1])
            a3 = rate(i + h / 2 * a2[0], w + h / 2 * a2[1])
            a4 = rate(i + h * a3[0], w + h * a3[1])
            i += h / 6 * (a1[0] + 2 * a2[0] + 2 * a3[0] + a4[0])
            w += h / 6 * (a1[1] + 2 * a2[1] + 2 * a3[1] + a4[1])
    return "\n".join(lines) + "\n"


class HiddenEffect(unittest.TestCase):
    def discover(self, folder, friction, *more):
        (folder / "motor.toml").write_text(MODEL)
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

    def test_nothing_is_named_where_nothing_is_hidden(self):
        with tempfile.TemporaryDirectory() as name:
            found = self.discover(Path(name), 0.0)
            self.assertEqual((found["verdict"], found["effects"], found["model"]), ("none", [], None))

    def test_a_user_teaches_an_effect_by_adding_a_file(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "effects").mkdir()
            (folder / "effects" / "seal.toml").write_text(
                'name = "seal_friction"\nsummary = "friction of my seal"\n[enters]\nunits = ["N.m"]\n[roles]\nspeed = "speed"\n'
                '[rewrite]\nkind = "add_term"\nterm = "-Tseal*sgn({speed})"\n[[parameter]]\nname = "Tseal"\nunit = "{equation}"\nmin = 0\n')
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
