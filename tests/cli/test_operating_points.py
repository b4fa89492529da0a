# SPDX-License-Identifier: GPL-3.0-or-later
"""replay of operating points: what it finds, the table of candidates, and what it says where the data do not suffice. A linear machine with two
constants that enter as a, a^2 and b^2; its averages are computed here."""
from fractions import Fraction

from command_line import CommandLine
import unittest

MODEL = """\
format = 1
name = "points"
[sampling]
period = 0.01
window = 0.08
[signals]
x = { unit = "V", steady = 0.001 }
w = { unit = "V" }
y = { unit = "V^2" }
[parameters]
a = { unit = "V", initial = 1 }
b = { unit = "1", initial = 1 }
[[equation]]
name = "balance"
ode = "y = 2*a*x - a^2 + b^2*w^2"
[estimator]
functional = "average"
solve = "elimination"
"""

A, B = Fraction(3, 2), Fraction(1, 2)


def recording(points, hold=8):
    rows = ["t [s],x [V],w [V],y [V^2]"]
    for x, w in points:
        y = 2 * A * x - A * A + B * B * w * w
        for _ in range(hold):
            rows.append(f"{(len(rows) - 1) / 100:.2f},{float(x)!r},{float(w)!r},{float(y)!r}")
    return "\n".join(rows) + "\n"


class OperatingPoints(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("points.toml", MODEL)

    def test_the_parameters_and_the_candidates(self):
        self.write("run.csv", recording([(0, 1), (1, 2), (2, 5), (4, 3)]))
        found = self.algest_json("replay", "points.toml", "run.csv")
        self.assertEqual(found["operating_points"], 4)
        last = {p["name"]: p["last"] for p in found["parameters"]}
        self.assertAlmostEqual(last["a"], float(A), delta=1e-12)
        self.assertAlmostEqual(last["b"], float(B), delta=1e-12)
        standings = [c["standing"] for c in found["candidates"]]
        self.assertEqual(standings[0], "best")
        self.assertEqual(standings.count("best"), 1)
        self.assertLessEqual(set(standings), {"best", "extremum", "unreal", "spurious"})
        self.assertEqual(found["missing"], [])
        self.assertAlmostEqual(found["candidates"][0]["values"]["a"], float(A), delta=1e-12)
        text, _ = self.algest("replay", "points.toml", "run.csv")
        self.assertIn("4 operating points", text)
        self.assertIn("balance: a = 1.5, squared error", text)
        self.assertIn(": the estimate\n", text)

    def test_one_value_of_w_leaves_b_open_as_long_as_w_is_zero(self):
        self.write("run.csv", recording([(1, 2), (1, 2), (1, 2)]))
        found = self.algest_json("replay", "points.toml", "run.csv")
        self.assertEqual(found["status"]["ok"], 0)
        self.assertGreater(found["status"]["singular"], 0)
        missing = "not identifiable from these data: needs a second value of x, w, y, the same at all of 3 operating points"
        self.assertEqual(found["missing"], [missing])
        _, err = self.algest("replay", "points.toml", "run.csv")
        self.assertIn(missing, err)

    def test_what_noise_alone_tells_apart_is_named(self):
        """y = a x + c at one x, which scatters within its tolerance: a line through one point."""
        linear = (MODEL.replace('a = { unit = "V", initial = 1 }', 'a = { unit = "V", initial = 1 }\nc = { unit = "V^2", initial = 1 }').replace('b = { unit = "1", initial = 1 }\n', "")
                  .replace('"y = 2*a*x - a^2 + b^2*w^2"', '"y = a*x + c"').replace('w = { unit = "V" }\n', "").replace('"elimination"', '"least_squares"'))
        self.write("linear.toml", linear)

        def rows(xs):
            out = ["t [s],x [V],y [V^2]"]
            for x in xs:
                out += [f"{(len(out) - 1 + k) / 100:.2f},{x!r},{1.5 * x + 0.5!r}" for k in range(8)]
            return "\n".join(out) + "\n"

        self.write("run.csv", rows([1.0, 1.0004, 0.9997, 1.0002]))
        found = self.algest_json("replay", "linear.toml", "run.csv")
        self.assertEqual(found["status"]["ok"], 0)
        self.assertEqual(found["missing"], ["not identifiable from these data: a, c: needs a second value of x, y, the same at all of 4 operating points"])
        self.write("run.csv", rows([1.0, 1.5, 2.0]))
        found = self.algest_json("replay", "linear.toml", "run.csv")
        self.assertAlmostEqual(found["parameters"][0]["last"], 1.5, delta=1e-12)
        # nobody asked whether the means are exact
        self.write("linear.toml", linear.replace('solve = "least_squares"', 'solve = "least_squares"\nuncertainty = false'))
        self.write("run.csv", rows([1.0, 1.0004, 0.9997, 1.0002]))
        self.assertGreater(self.algest_json("replay", "linear.toml", "run.csv")["status"]["ok"], 0)

    def test_nothing_steady(self):
        rows = ["t [s],x [V],w [V],y [V^2]"] + [f"{k / 100:.2f},{k / 100!r},1,1" for k in range(60)]
        self.write("run.csv", "\n".join(rows) + "\n")
        found = self.algest_json("replay", "points.toml", "run.csv")
        self.assertEqual((found["operating_points"], found["status"]["ok"]), (0, 0))
        _, err = self.algest("replay", "points.toml", "run.csv")
        self.assertIn("no steady stretch of 8 samples was found", err)

    def test_a_signal_computed_from_others_cannot_be_simulated(self):
        self.write("computed.toml", MODEL.replace('w = { unit = "V" }', 'v = { unit = "V" }\nw = { unit = "V", formula = "2*v" }'))
        self.write("run.csv", recording([(0, 1), (1, 2)]).replace("w [V]", "v [V]"))
        _, err = self.algest("simulate", "computed.toml", "run.csv", exit_code=2)
        self.assertIn("computed.toml:9:1: error: 'w' is computed by a formula", err)


if __name__ == "__main__":
    unittest.main()
