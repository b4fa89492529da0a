# SPDX-License-Identifier: GPL-3.0-or-later
"""Effects that are more than a term: each kind of rewrite, taught by the file that docs/discover.md shows and found in a recording made here
by a simulator of its own. A file with the name of one of the library's takes its place, so that it is the file beside the model that acts."""
import math
import random
import re
import tempfile
import unittest
from pathlib import Path

from environment import SOURCE
from gap.discovery import discover, names, show, values
from gap.hidden_plants import MOTOR, run

PAGE = (SOURCE / "docs/discover.md").read_text(encoding="utf-8")
TAUGHT = {re.search(r'kind = "(\w+)"', text)[1]: text for text in re.findall(r"```toml-rewrite\n(.*?)```", PAGE, flags=re.DOTALL)}

# A mass behind a spring whose other end is moved; half of the play is 2 mm.
PUSHED = """\
name = "pushed"
[sampling]
period = 1e-3
[signals]
r = { unit = "m", hold = "zoh" }
x = { unit = "m", noise = 2e-5, initial = 0 }   # of the mass
[constants]
m = { value = 1, unit = "kg" }
[parameters]
k = { unit = "N/m", initial = 300, min = 0 }
c = { unit = "N.s/m", initial = 3, min = 0 }
[[equation]]
name = "force balance"
ode = "m*der(x,2) = k*(r - x) - c*der(x)"
"""
PLAY = 2e-3


def pushed():
    dice = random.Random(3)
    pull = lambda z: z - PLAY if z > PLAY else z + PLAY if z < -PLAY else 0.0
    return run(lambda s, r: [s[1], 400.0 * pull(r - s[0]) - 4.0 * s[1]], [0.0, 0.0], lambda k: dice.uniform(-0.02, 0.02) if k % 150 == 0 else None,
               lambda s: (s[0] + dice.gauss(0, 2e-5),), "t [s],r [m],x [m]", 4000)


def motor(lag=0.0, delay=0):
    """R = 1, L = 0.002, K = 0.05, J = 2.5e-4, b = 2e-4; what reaches the winding lags, or comes `delay` samples late."""
    dice = random.Random(5)
    commands = [0.0]

    def command(k):
        commands.append(dice.uniform(-8, 8) if k % 120 == 0 else commands[-1])
        return commands[-1]

    def rate(s, u):
        reached = s[2] if lag else commands[max(len(commands) - 1 - delay, 1)]
        return [(reached - s[0] - 0.05 * s[1]) / 0.002, (0.05 * s[0] - 2e-4 * s[1]) / 2.5e-4, (u - s[2]) / (lag or 1.0)]

    return run(rate, [0.0, 0.0, 0.0], command, lambda s: (s[0] + dice.gauss(0, 0.005), s[1] + dice.gauss(0, 0.1)), "t [s],u [V],i [A],w [rad/s]", 4000)


class Rewrites(unittest.TestCase):
    def discover(self, model, recording, kind=None, library=None):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            (folder / "m.toml").write_text(model, encoding="utf-8")
            (folder / "m.csv").write_text(recording, encoding="utf-8")
            if kind:
                (folder / "effects").mkdir()
                (folder / "effects/e.toml").write_text(re.sub(r'name = "\w+"', f'name = "{library}"', TAUGHT[kind], count=1), encoding="utf-8")
            found = discover(folder / "m.toml", folder / "m.csv", folder / "out")
            show(str(kind), found)
            amended = Path(found["model"]).read_text(encoding="utf-8") if found["model"] else ""
            return found, amended

    def at_the_floor(self, found):
        for o in found["outputs"]:
            self.assertLess(o["nrmse_after"] / o["noise_floor"], 1.2, o)   # the bar of the open cases

    def test_what_is_replaced(self):
        found, amended = self.discover(PUSHED, pushed(), "replace", "backlash")
        self.assertEqual((found["verdict"], names(found)), ("named", ["backlash"]))
        self.assertAlmostEqual(values(found)["play"], PLAY, delta=0.05 * PLAY)   # the bar of the open cases for strengths
        self.at_the_floor(found)
        # The rest of the line, and the comment of another, are as they were; a scanned number is a constant.
        self.assertIn('ode = "m*der(x,2) = k*(max((r-x) - play,0) + min((r-x) + play,0)) - c*der(x)"\n', amended)
        self.assertIn("initial = 0 }   # of the mass\n", amended)
        self.assertRegex(amended, r'\[constants\]\nm = .*\nplay = \{ value = 0.00\d+, unit = "m" \} ')

    def test_a_state_is_added(self):
        found, amended = self.discover(MOTOR.format(name="m"), motor(lag=5e-3), "add_state", "actuator_lag")
        self.assertEqual((found["verdict"], names(found)), ("named", ["actuator_lag"]))
        self.assertEqual(found["effects"][0]["equation"], "voltage balance")
        self.assertAlmostEqual(values(found)["tau"], 5e-3, delta=0.05 * 5e-3)
        self.at_the_floor(found)
        self.assertIn('ode = "L*der(i) = opening - R*i - K*w"   # copper, back EMF\n', amended)
        self.assertIn('ode = "tau*der(opening) = u - opening"\n', amended)

    def test_an_input_comes_late(self):
        found, amended = self.discover(MOTOR.format(name="m"), motor(delay=6))
        self.assertEqual((found["verdict"], names(found)), ("named", ["input_delay"]))
        self.assertAlmostEqual(values(found)["dead_time"], 6e-3, delta=0.05 * 6e-3)
        self.at_the_floor(found)
        self.assertIn('ode = "L*der(i) = delay(u, dead_time) - R*i - K*w"   # copper, back EMF\n', amended)

    def test_a_sensor_without_sign_on_a_second_derivative(self):
        text = PUSHED.replace("m*der(x,2) = k*(r - x) - c*der(x)", "m*der(x,2) = k*r - k*x - c*der(x)")
        dice = random.Random(7)
        recording = run(lambda s, r: [s[1], 400.0 * (r - s[0]) - 4.0 * s[1]], [0.0, 0.0], lambda k: dice.uniform(-0.02, 0.02) if k % 150 == 0 else None,
                        lambda s: (abs(s[0] + dice.gauss(0, 2e-5)),), "t [s],r [m],x [m]", 4000)
        found, _ = self.discover(text, recording)
        self.assertEqual((found["verdict"], names(found)), ("named", ["absolute_value_sensor"]))
        self.assertLess(found["outputs"][0]["nrmse_after"], 0.05)

    def test_friction_in_a_force_that_a_sensor_shows(self):
        dice = random.Random(9)
        rows = ["t [s],v [m/s],F [N]"]
        v = 0.0
        for k in range(2000):
            v += 0.05 * (dice.uniform(-1, 1) - v)
            rows.append(f"{k * 1e-2:.9g},{v:.9g},{30 * v + (2.0 if v > 0 else -2.0) + dice.gauss(0, 0.05):.9g}")
        text = """name = "damper"
[sampling]
period = 1e-2
[signals]
v = { unit = "m/s" }
F = { unit = "N", noise = 0.05 }
[parameters]
c = { unit = "N.s/m", initial = 10, min = 0 }
[[equation]]
name = "force"
ode = "F = c*v"
"""
        found, _ = self.discover(text, "\n".join(rows) + "\n")
        self.assertEqual((found["verdict"], names(found)), ("named", ["coulomb_friction"]))
        self.assertLess(abs(values(found)["Tc"] / 2 - 1), 0.02)   # 2000 samples of 0.05 N noise: far below

    def sprung(self, force, seed):
        """A mass of 1 kg on a spring with an element that is not in its model: force(x, v, z) and the rate of what it remembers, z."""
        dice = random.Random(seed)
        pull, rate = force
        recording = run(lambda s, F: [s[1], F - 3.0 * s[1] - 300.0 * s[0] - pull(s[1], s[2]), rate(s[1], s[2])], [0.0, 0.0, 0.0], lambda k: dice.uniform(-12, 12) if k % 150 == 0 else None,
                        lambda s: (s[0] + dice.gauss(0, 2e-5),), "t [s],F [N],x [m]", 6000)
        model = """name = "sprung"
[sampling]
period = 1e-3
[signals]
F = { unit = "N", hold = "zoh" }
x = { unit = "m", noise = 2e-5, initial = 0 }
[constants]
m = { value = 1, unit = "kg" }
[parameters]
k = { unit = "N/m", initial = 250, min = 0 }
c = { unit = "N.s/m", initial = 2, min = 0 }
[[equation]]
name = "force balance"
ode = "m*der(x,2) = F - k*x - c*der(x)"
"""
        found, _ = self.discover(model, recording)
        return found

    def test_a_force_that_remembers(self):
        """Bouc and Wen: 2 N, 4 mm wide, on strokes of 30 mm."""
        loop = (lambda v, z: 2.0 * z, lambda v, z: (v - 0.5 * abs(v) * z - 0.5 * v * abs(z)) / 4e-3)
        found = self.sprung(loop, 11)
        self.assertEqual((found["verdict"], names(found)), ("named", ["hysteresis"]))
        self.assertLess(abs(values(found)["Fh"] / 2.0 - 1), 0.05)   # the bar of the open cases for strengths
        self.assertLess(abs(values(found)["width"] / 4e-3 - 1), 0.05)
        self.at_the_floor(found)

    def test_none_that_remembers_where_nothing_is_hidden(self):
        found = self.sprung((lambda v, z: 0.0, lambda v, z: 0.0), 13)
        self.assertEqual((found["verdict"], names(found)), ("none", []))

    def test_a_weight_that_is_known_is_not_explained_away(self):
        """Waves over the angle add up to the known weight; everything else of the balance at zero, they would leave no residual."""
        dice = random.Random(19)
        recording = run(lambda s, V: [s[1], (0.1 * V - 0.5 * math.sin(s[0]) - 0.02 * s[1] - 0.02 * math.tanh(s[1] / 1e-2)) / 0.01], [0.0, 0.0], lambda k: dice.uniform(-2, 2) if k % 120 == 0 else None,
                        lambda s: (s[0] + dice.gauss(0, 2e-4),), "t [s],V [V],q [rad]", 5000, steps=20)
        model = """name = "lifted"
[sampling]
period = 1e-3
[signals]
V = { unit = "V", hold = "zoh" }
q = { unit = "rad", noise = 2e-4, initial = 0 }
[constants]
mgl = { value = 0.5, unit = "N.m" }
[parameters]
k = { unit = "N.m/V", initial = 0.08, min = 0 }
J = { unit = "kg.m^2", initial = 0.012, min = 0 }
c = { unit = "N.m.s/rad", initial = 0.01, min = 0 }
[[equation]]
name = "torque balance"
ode = "J*der(q,2) = k*V - mgl*sin(q) - c*der(q)"
"""
        found, _ = self.discover(model, recording)
        self.assertEqual((found["verdict"], names(found)), ("named", ["coulomb_friction"]))
        self.assertLess(abs(values(found)["Tc"] / 0.02 - 1), 0.05)
        strength = {e["effect"]: e["strength"] for e in reversed(found["evidence"])}
        self.assertEqual(max(strength, key=strength.get), "coulomb_friction")

    def test_friction_of_a_strut_between_two_bodies(self):
        dice = random.Random(17)
        strut = lambda v: 25.0 * math.tanh(v / 1e-3) + 700.0 * v
        recording = run(lambda s, r: [s[1], (-12000.0 * (s[0] - s[2]) - strut(s[1] - s[3])) / 220.0, s[3], (12000.0 * (s[0] - s[2]) + strut(s[1] - s[3]) - 120000.0 * (s[2] - r)) / 28.0],
                        [0.0] * 4, lambda k: dice.uniform(-0.02, 0.02) if k % 100 == 0 else None, lambda s: (s[0] + dice.gauss(0, 5e-5), s[2] + dice.gauss(0, 5e-5)),
                        "t [s],r [m],xs [m],xu [m]", 5000, period=2e-3)
        model = """name = "car"
[sampling]
period = 2e-3
[signals]
r = { unit = "m", hold = "zoh" }
xs = { unit = "m", noise = 5e-5, initial = 0 }
xu = { unit = "m", noise = 5e-5, initial = 0 }
[constants]
ms = { value = 220, unit = "kg" }
mu = { value = 28, unit = "kg" }
[parameters]
ks = { initial = 10000, unit = "N/m", min = 0 }
kt = { initial = 100000, unit = "N/m", min = 0 }
cs = { initial = 900, unit = "N.s/m", min = 0 }
[[equation]]
name = "body"
ode = "ms*der(xs,2) = -ks*(xs-xu) - cs*(der(xs)-der(xu))"
[[equation]]
name = "wheel"
ode = "mu*der(xu,2) = ks*(xs-xu) + cs*(der(xs)-der(xu)) - kt*(xu-r)"
"""
        found, amended = self.discover(model, recording)
        self.assertEqual((found["verdict"], names(found)), ("named", ["coulomb_friction"]))
        self.assertEqual(found["effects"][0]["equation"], "body, wheel")
        self.assertLess(abs(values(found)["Tc"] / 25.0 - 1), 0.05)
        self.assertIn("- Tc*sgn(der(xs)-der(xu))", amended)
        self.at_the_floor(found)

    def test_a_wrong_constant_and_a_wrong_sensor_are_the_same_without_an_angle(self):
        wrong = MOTOR.format(name="m").replace("K = { value = 0.05,", "K = { value = 0.052,")
        for kind, library in (("transform_signal", "sensor_gain"), ("free_constant", "parameter_error")):
            with self.subTest(kind):
                found, amended = self.discover(wrong, motor(), kind, library)
                self.assertEqual(found["verdict"], "ambiguous")
                self.assertEqual(sorted(found["alternatives"]), [["parameter_error"], ["sensor_gain"]])
                self.assertTrue(any("second sensor" in e for e in found["experiments"]), found["experiments"])
                self.at_the_floor(found)
                places = {"parameter_error": "K", "sensor_gain": "torque balance"}
                self.assertEqual(found["effects"][0]["equation"], places[names(found)[0]])


if __name__ == "__main__":
    unittest.main()
