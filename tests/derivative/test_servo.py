# SPDX-License-Identifier: GPL-3.0-or-later
"""models/servo.toml: a pendulum on a servo. Simulated ones whose truth is known, what no data can tell, and the recordings of a real one beside what
its makers published."""
import math
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, SHARED, SOURCE
from recordings import replay, runge_kutta, values

MODEL = SOURCE / "models/servo.toml"
PERIOD = 5e-3
R = 4.02
TRUE = {"kt": 0.387, "J": 0.0067, "mgl": 0.48, "Fc": 0.03, "mu": 0.02}
# Published for the motor, with 0.49 kg at 0.1 m: kt and R as they are, J and m g l by these.
LOAD = 0.49 * 9.81 * 0.1
PUBLISHED = {"kt": 0.387, "R": 4.02, "J": 0.0018 + 0.49 * 0.1 ** 2, "mgl": LOAD}
RECORDINGS = {"lift_and_drop": ("--to", 1.995), "sin_sin": (), "sin_time_square": (), "up_and_down": ()}   # from 2 s on the first has its motor off


def known_load(folder):
    """The model where the load is known in place of the resistance."""
    text = MODEL.read_text()
    lines = [line for line in text.splitlines() if not line.startswith(("R = ", "mgl = "))]
    at = lines.index("[parameters]")
    lines[at:at + 1] = [f'mgl = {{ value = {LOAD!r}, unit = "N.m" }}', "", "[parameters]", 'R = { unit = "ohm", initial = 4 }']
    path = folder / "known_load.toml"
    path.write_text("\n".join(lines))
    return path


def everything_unknown(folder):
    text = "\n".join(line for line in MODEL.read_text().splitlines() if not line.startswith("R = "))
    path = folder / "everything_unknown.toml"
    path.write_text(text.replace("[parameters]", '[parameters]\nR = { unit = "ohm" }'))
    return path


def write_servo(path, volts, samples=1200):
    """A servo that always moves, its speed exact and 4 samples late, its angle exact."""
    x, history = [0.0, 0.0], []
    for k in range(samples):
        history.append((k * PERIOD, x[0], x[1], volts(k * PERIOD)))
        for j in range(50):
            v = volts(k * PERIOD + j * PERIOD / 50)

            def slope(y, v=v):
                sign = math.copysign(1.0, y[1])
                torque = TRUE["kt"] / R * (v - TRUE["kt"] * y[1]) - TRUE["mgl"] * math.sin(y[0]) - (TRUE["Fc"] + TRUE["mu"] * abs(math.sin(y[0]))) * sign
                return [y[1], torque / TRUE["J"]]
            x = runge_kutta(slope, x, PERIOD / 50)
    with open(path, "w", encoding="utf-8") as file:
        file.write("t [s],position [rad],speed [rad/s],motor_voltage [V]\n")
        for k in range(4, samples):
            file.write(f"{(k - 4) * PERIOD:.3f},{history[k][1]!r},{history[k - 4][2]!r},{history[k][3]!r}\n")


class Servo(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_simulated_servo(self):
        recording = self.folder / "run.csv"
        write_servo(recording, lambda t: 4.0 * math.sin(2 * math.pi * (0.5 + 0.15 * t) * t))
        code, answer, said = replay(MODEL, recording, "--batch")
        self.assertEqual(code, 0, said)
        for name, value in values(answer, "value").items():
            # friction turns over within a sample, and the derivative's parabola does not follow: 2 percent of the largest torques
            self.assertLess(abs(value / TRUE[name] - 1), 0.02 if name in ("kt", "mgl") else 0.1, name)

        late = self.folder / "without_lag.toml"
        late.write_text(MODEL.read_text().replace(", lag = 4", ""))
        _, answer, _ = replay(late, recording, "--batch")
        self.assertGreater(abs(values(answer, "value")["kt"] / TRUE["kt"] - 1), 0.1)   # the lag mixes inertia into kt

        code, answer, said = replay(known_load(self.folder), recording, "--batch")
        self.assertEqual(code, 0, said)
        self.assertAlmostEqual(values(answer, "value")["R"], R * LOAD / TRUE["mgl"], delta=0.02 * R)

    def test_one_of_them_has_to_be_known(self):
        result = subprocess.run([ALGEST, "check", everything_unknown(self.folder)], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("the 6 parameters R, kt, J, mgl, Fc, mu enter only through kt, R*J/kt, R*mgl/kt, R*Fc/kt, R*mu/kt; declare one of R, J, mgl, Fc, mu under [constants]", result.stderr)

    def test_a_load_that_is_only_ever_lifted(self):
        recording = self.folder / "run.csv"
        write_servo(recording, lambda t: 1.0 + 1.2 * t, samples=500)
        code, answer, said = replay(MODEL, recording, "--batch")
        self.assertEqual(code, 1, said)
        found = values(answer, "value")
        self.assertIsNone(found["mgl"])
        self.assertIsNone(found["mu"])
        confused = [c for c in answer["confused"] if not c["hardly"]]
        self.assertEqual([c["unknowns"] for c in confused], [["mgl/kt", "mu/kt"]])
        self.assertIn("cannot be told apart", confused[0]["text"])
        self.assertIn("determined is mgl/kt + mu/kt = ", confused[0]["text"])

    def test_the_recordings(self):
        if not (SHARED / "recordings").is_dir():
            self.skipTest(f"there are no recordings under {SHARED}")
        table = {}
        for name, stretch in RECORDINGS.items():
            recording = SHARED / f"recordings/servo_{name}.csv"
            for known, model in (("R", MODEL), ("load", known_load(self.folder))):
                code, answer, said = replay(model, recording, "--batch", *stretch)
                self.assertIn(code, (0, 1), said)
                table[name, known] = (code, values(answer, "value"), values(answer, "sd"), answer["confused"])
                for parameter in answer["parameters"]:
                    value, sd = parameter["value"], parameter["sd"]
                    published = PUBLISHED.get(parameter["name"])
                    print(f"{name:16} {known:4} known  {parameter['name']:4} " + (f"{value:9.4g} sd {sd:8.2g}" if value is not None else "        -            ") +
                          f" {parameter['unit']:8}" + (f" published {published:.4g}" if published else ""))
                for confused in answer["confused"]:
                    print(f"{name:16} {known:4} known  {'hardly' if confused['hardly'] else 'not'} identifiable: {confused['text']}")

        # The one recording that moves fast enough tells kt, and J beside a known load.
        _, value, sd, confused = table["sin_time_square", "load"]
        self.assertEqual(confused, [])
        self.assertLess(abs(value["kt"] / PUBLISHED["kt"] - 1), 0.05)
        self.assertLess(abs(value["J"] / PUBLISHED["J"] - 1), 0.1)
        self.assertGreater(value["Fc"], 3 * sd["Fc"])
        # A back-EMF constant that comes out below zero, within two deviations of it, is marked.
        code, answer, said = replay(known_load(self.folder), SHARED / "recordings/servo_lift_and_drop.csv", "--batch", *RECORDINGS["lift_and_drop"])
        doubts = {p["name"]: p["doubt"] for p in answer["parameters"]}
        self.assertRegex(doubts["kt"], r"kt = -0\.147 is 1\.9 of its standard deviations and hardly told from zero, and contradicts min = 0")
        # The same combination R/kt mgl, whichever of the two is known.
        _, with_r, _, _ = table["sin_time_square", "R"]
        self.assertAlmostEqual(R / with_r["kt"] * with_r["mgl"], value["R"] / value["kt"] * LOAD, delta=1e-9)
        # Those that only ever lift cannot tell gravity from the friction that it causes.
        for name in ("lift_and_drop", "up_and_down"):
            _, _, _, confused = table[name, "R"]
            self.assertTrue(any({"mgl/kt", "mu/kt"} <= set(c["unknowns"]) for c in confused), name)


if __name__ == "__main__":
    unittest.main()
