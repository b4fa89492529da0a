# SPDX-License-Identifier: GPL-3.0-or-later
"""[discrete] that is refused: exit 2, at the right line and column, with what would be right. The mark ▸ stands where the complaint belongs."""
import unittest

from model_case import ModelCase, complaints, without_marks

MODEL = """\
format = 1
name = "m"
[sampling]
period = 0.01
window = 1
[signals]
u = { unit = "V" }
y = { unit = "rad/s" }
[discrete]
domain = "q"
n = 2
[estimator]
functional = "discrete"
"""

# What is replaced, by what, and words of the complaint.
REFUSED = [
    ('domain = "q"', 'domain = ▸"s"', ["domain is one of z | q"]),
    ('[discrete]\ndomain = "q"\n', '▸[discrete]\n', ["without domain", 'domain = "q"']),
    ("n = 2\n", "n = ▸0\n", ["'n'", "1 to 12"]),
    ("n = 2\n", "n = 2\nm = ▸3\n", ["larger than n"]),
    ("n = 2\n", "n = 2\nnumerator = ▸2\n", ["larger than m"]),
    ("n = 2\n", "n = 2\nderivatives = ▸1\n", ["initial conditions", "n+1 = 3"]),
    ("n = 2\n", "n = 2\ngamma = ▸1.1\n", ["above 1"]),
    ("n = 2\n", "n = 2\ngamma = ▸0\n", ["gamma", "positive"]),
    ("n = 2\n", "n = 2\nskip = ▸-1\n", ["skip"]),
    ("n = 2\n", "n = 2\nextra = ▸101\n", ["extra"]),
    ("n = 2\n", "n = 2\n▸degree = 3\n", ["degree"]),
    ("n = 2\n", 'n = 2\noutput = ▸"z"\n', ["not a signal"]),
    ("n = 2\n", 'n = 2\ninput = ▸"v"\n', ["not a signal"]),
    ("n = 2\n", "n = 2\nrow_filter = { numerator = ▸[] }\n", ["lists the coefficients"]),
    ("n = 2\n", "n = 2\nrow_filter = { numerator = [1], denominator = ▸[0, 1] }\n", ["begins with 0"]),
    ("n = 2\n", "n = 2\nrow_filter = ▸{ numerator = [0] }\n", ["lets nothing through"]),
    ('[discrete]\ndomain = "q"\nn = 2\n', '▸[discrete]\ndomain = "q"\n', ["without n"]),
    ('[discrete]\ndomain = "q"\nn = 2\n', '▸[discrete]\ndomain = "q"\nn = 2\ninput = "y"\n', ["one signal"]),
    ('[discrete]\ndomain = "q"\nn = 2\n[estimator]', "▸[estimator]", ["without [discrete]"]),
    ('[estimator]\nfunctional = "discrete"', "▸[estimator]", ["functional = \"discrete\""]),
    ('functional = "discrete"', 'functional = "discrete"\nsolve = "robust"', ["no S(t)"]),
    ('functional = "discrete"', 'functional = "discrete"\nuncertainty = true', ["uncertainty"]),
    ("window = 1\n", "window = 1\ngrowing = ▸true\n", ["annihilator"]),
    ("window = 1\n", "window = ▸0.05\n", ["too short", "0.09 s"]),
    ('u = { unit = "V" }\n', 'u = { unit = "V" }\na1 = { unit = "V" }\n', ["unknown of [discrete]", "'a1'"]),
    ("[discrete]\n", "[parameters]\n▸R = { unit = \"ohm\" }\n[discrete]\n", ["[parameters] beside [discrete]"]),
    ("[discrete]\n", "▸[transfer]\nn = 1\nunknowns = [\"a0\", \"b0\"]\n[discrete]\n", ["[transfer] beside [discrete]"]),
    ("window = 1\n", "window = 1\ndecimate = 2\n", ["decimate"]),
]


class Discrete(ModelCase):
    def test_what_is_refused(self):
        for old, new, words in REFUSED:
            self.assertIn(old, MODEL)
            content, marks = without_marks(MODEL.replace(old, new, 1))
            self.write(content)
            for command in ("check", "derive", "generate"):
                with self.subTest(new=new, command=command):
                    code, _, err, _ = self.run_algest(command, "m.toml")
                    self.assertEqual(code, 2, err)
                    found = complaints(err)
                    about = [text for line, column, text in found if not marks or (line, column) == marks[0]]
                    self.assertTrue(any(all(word in text for word in words) for text in about), err)
                    self.assertEqual(self.entries(), ["m.toml"])

    def test_what_is_sound(self):
        for old, new in [("n = 2\n", "n = 2\n"), ('"q"', '"z"'), ("n = 2\n", "n = 12\nm = 12\nnumerator = 0\n"), ("n = 2\n", "n = 1\nm = 1\n"), ("n = 2\n", 'n = 2\ngamma = "2/3"\nskip = 3\nextra = 5\nderivatives = 5\n'),
                         ("n = 2\n", "n = 2\nrow_filter = { numerator = [0.1], denominator = [1, -0.9] }\n"), ('functional = "discrete"', 'functional = "discrete"\nsolve = "least_squares"'),
                         ('functional = "discrete"', 'functional = "discrete"\nengine = "fir"')]:
            with self.subTest(new=new):
                self.write(MODEL.replace(old, new, 1).encode())
                code, _, err, _ = self.run_algest("check", "m.toml", "--strict")
                self.assertEqual(code, 0, err)

    def test_n_derivatives_are_a_warning(self):
        content, marks = without_marks(MODEL.replace("n = 2\n", "n = 2\nderivatives = ▸2\n"))
        self.write(content)
        code, _, err, _ = self.run_algest("check", "m.toml")
        self.assertEqual(code, 0, err)
        (warning,) = complaints(err, "warning")
        self.assertEqual(warning[:2], marks[0])
        self.assertIn("from rest alone", warning[2])

    def test_least_squares_needs_no_window(self):
        self.write(MODEL.replace("window = 1\n", "").replace('functional = "discrete"', 'functional = "discrete"\nsolve = "least_squares"').encode())
        code, out, err, _ = self.run_algest("derive", "m.toml")
        self.assertEqual(code, 0, err)
        self.assertIn("since the last reset", out)


if __name__ == "__main__":
    unittest.main()
