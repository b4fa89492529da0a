# SPDX-License-Identifier: GPL-3.0-or-later
"""Models with functional = "derivative" that are refused: exit 2, at the right line and column (the mark ▸); and what stands in the way of a batch."""
import json
import unittest

from model_case import ModelCase, complaints, without_marks

MODEL = """\
name = "m"
[sampling]
period = 0.001
[signals]
v = { unit = "V" }
i = { unit = "A" }
[parameters]
R = { unit = "ohm" }
L = { unit = "H" }
[[equation]]
ode = "L*der(i) = v - R*i"
[estimator]
functional = "derivative"
solve = "least_squares"
"""

CASES = [
    ("a window", ("period = 0.001", "period = 0.001\nwindow = ▸0.1"), "a window is for integrals"),
    ("decimation", ("▸[sampling]\nperiod = 0.001", "▸[sampling]\nperiod = 0.001\ndecimate = 10"), "decimate is for windows"),
    ("kappa", ('- R*i"', '- R*i"\nkappa = ▸1'), "kappa is for annihilators"),
    ("two rows", ('- R*i"', '- R*i"\nrows = ▸2'), "one row an instant"),
    ("a list of rows", ('- R*i"', '- R*i"\nrows = ▸[1, 2]'), "one row an instant"),
    ("form", ('solve = "least_squares"', 'solve = "least_squares"\nform = ▸2'), "form is for windows"),
    ("quadrature", ('solve = "least_squares"', 'solve = "least_squares"\nquadrature = ▸"simpson"'), "quadrature is for windows"),
    ("engine", ('solve = "least_squares"', 'solve = "least_squares"\nengine = ▸"fir"'), "engine is for windows"),
    ("robust without its time", ('solve = "least_squares"', 'solve = ▸"robust"'), "robust without solve_window"),
    ("no uncertainty of robust rows", ('solve = "least_squares"', 'solve = "robust"\nsolve_window = 0.1\nuncertainty = ▸true'), "not to be had with robust rows"),
    ("second derivative", ('"L*der(i) = v - R*i"', '▸"L*der(i, 2) = der(v) - R*der(i)"'), "has a derivative of order 2"),
    ("too few rows", ('solve = "least_squares"', 'solve = "square"'), "1 row for 2 unknowns"),
    ("a lag that is none", ('i = { unit = "A" }', 'i = { unit = "A", lag = ▸-1 }'), "lag"),
    ("no period", ("period = 0.001\n", ""), "no sampling period"),
]


def texts():
    for name, (old, new), words in CASES:
        plain = old.replace("▸", "")
        assert MODEL.count(plain) == 1, plain
        text = MODEL.replace(plain, new)
        if name == "too few rows":
            text = text.replace('"L*der', '▸"L*der')
        if name == "no period":
            text = text.replace("[sampling]", "▸[sampling]")
        yield name, text, words


class MalformedDerivative(ModelCase):
    def test_what_they_are_made_from_is_sound(self):
        self.write(MODEL.encode())
        self.assertEqual(self.run_algest("check", "m.toml")[:2], (0, "m.toml: ok\n"))
        self.assertEqual(self.run_algest("derive", "m.toml", "--format", "latex")[0], 0)
        code, out, err, _ = self.run_algest("derive", "m.toml", "--format", "json", "--weights")
        self.assertEqual(code, 0, err)
        (row,) = json.loads(out)["equations"][0]["rows"]
        terms = {(t["parameter"], t["signal"]): (t["kernel"], t["weights"], t["derivative"]) for t in row["terms"]}
        self.assertEqual(terms, {("Gamma1", "v"): ([], ["-0x1p+0"], 0), ("Gamma2", "i"): ([], ["0x1p+0"], 0), (None, "der(i)"): ([], ["-0x1p+0"], 0)})

        self.write(MODEL.replace('v = { unit = "V" }', 'v = { unit = "V", hold = "zoh" }').encode())
        (row,) = json.loads(self.run_algest("derive", "m.toml", "--format", "json", "--weights")[1])["equations"][0]["rows"]
        self.assertEqual({t["signal"]: t["weights"] for t in row["terms"]},   # the mean of both sides of the jump
                         {"der(i)": ["0x0p+0", "-0x1p+0"], "i": ["0x0p+0", "0x1p+0"], "v": ["-0x1p-1", "-0x1p-1"]})

    def test_each_is_refused_at_its_place(self):
        for name, text, words in texts():
            content, places = without_marks(text)
            self.write(content)
            with self.subTest(name):
                code, out, err, seconds = self.run_algest("generate", "m.toml", "-o", "out")
                self.assertEqual(code, 2, out + err)
                found = complaints(err)
                self.assertEqual([place[:2] for place in found], places, err)
                self.assertIn(words, err)
                self.assertEqual(self.entries(), ["m.toml"])

    def batch(self, model, rows, *options):
        self.write(model.encode())
        self.write(("t [s],v [V],i [A]\n" + "".join(f"{t},{v},{i}\n" for t, v, i in rows)).encode(), "run.csv")
        return self.run_algest("replay", "m.toml", "run.csv", "--batch", *options)

    def test_what_a_batch_refuses(self):
        even = [(k * 0.001, 1, k % 7) for k in range(20)]
        uneven = even[:10] + [(t + 0.0004, v, i) for t, v, i in even[10:]]
        self.assertEqual(self.batch(MODEL, even)[0], 0)
        self.assertEqual(self.batch(MODEL, uneven)[0], 0)
        held = MODEL.replace('v = { unit = "V" }', 'v = { unit = "V", hold = "zoh" }')
        late = MODEL.replace('i = { unit = "A" }', 'i = { unit = "A", lag = 2 }')
        windowed = MODEL.replace('functional = "derivative"\n', "").replace("period = 0.001", "period = 0.001\nwindow = 0.005")
        back = even[:10] + [(0.0085, 1, 2)] + even[10:]
        for name, model, rows, options, words in (
                ("held, uneven", held, uneven, (), "what a held signal does between them is not known"),
                ("late, uneven", late, uneven, (), "a `lag` counts equal ones"),
                ("of windows", windowed, even, (), "a batch is for rows of single instants"),
                ("time that goes back", MODEL, back, (), "`t` goes back here"),
                ("two samples", MODEL, even[:2], (), "the parabola filter needs 3"),
                ("with -o", MODEL, even, ("-o", "out.csv"), "--batch has one answer")):
            with self.subTest(name):
                code, out, err, _ = self.batch(model, rows, *options)
                self.assertEqual(code, 2, out + err)
                self.assertIn(words, err)

    def test_a_constant_signal_leaves_its_parameter_open(self):
        constant = [(k * 0.001, 6, 2) for k in range(50)]
        code, out, err, _ = self.batch(MODEL, constant)
        self.assertEqual(code, 1, err)   # 1/L*6 - R/L*2 = 0 is all that it says
        self.assertIn("not identifiable from this recording: 1/L and R/L cannot be told apart: i is 0.333 times v throughout; determined is 1/L - 0.3333*R/L = 0", out)
        self.assertRegex(out, r"R +- +- +ohm")

        two = MODEL.replace("[estimator]", '[[equation]]\node = "v = R*i"\n[estimator]')   # linear as written: no division
        code, out, err, _ = self.batch(two, constant)
        self.assertEqual(code, 1, err)
        self.assertIn("not identifiable from this recording: L: what it multiplies, der(i), is zero throughout", out)
        self.assertRegex(out, r"R +3 ")


if __name__ == "__main__":
    unittest.main()
