# SPDX-License-Identifier: GPL-3.0-or-later
"""Sound models whose parameters no data can tell apart: exit 1, the parameters named, nothing written. The mark ▸ stands where
the complaint belongs."""
import unittest

from model_case import ModelCase, complaints, without_marks

HEAD = """\
name = "m"
[sampling]
period = 0.001
window = 0.02
[signals]
x = {}
y = {}
u = {}
"""


def model(parameters, *equations):
    """Parameters as TOML lines, equations as their TOML lines."""
    return HEAD + "[parameters]\n" + "\n".join(parameters) + "\n" + "".join("[[equation]]\n" + equation + "\n" for equation in equations)


# name, text, for each mark the words that its complaint must hold
CASES = [
    ("offset under kappa = 1", model(["a = {}", "▸offset = {}"], 'ode = "der(x) = a*u + offset"\nkappa = 1'), [["'offset'", "kappa >= 1 erases"]]),
    ("offset times a constant under kappa = 2", model(["a = {}", "▸offset = {}"], 'ode = "der(x) = a*u + 3*sqrt(2)*offset"\nkappa = 2'), [["'offset'"]]),
    ("friction that cannot change its sign, under kappa = 1", model(["m = {}", "▸Tc = {}"], 'ode = "m*der(x) = u - Tc*sgn(2*x)"\nkappa = 1').replace("x = {}", "x = { min = 0.1 }"), [["'Tc'", "kappa >= 1 erases"]]),
    ("friction that cannot change its sign beside a load", model(["m = {}", "Tc = {}", "T0 = {}"], 'ode = ▸"m*der(x) = u - Tc*sgn(-x) - T0"').replace("x = {}", "x = { max = -3 }"), [["m, Tc, T0", "1/m"]]),
    ("parameter in no equation", model(["a = {}", "▸spare = {}"], 'ode = "der(x) = a*u"'), [["'spare'", "stands in no equation"]]),
    ("parameter that cancels", model(["a = {}", "▸b = {}"], 'ode = "der(x) = a*u + b*x - x*b"'), [["'b'"]]),
    ("parameter times zero", model(["a = {}", "▸b = {}"], 'ode = "der(x) = a*u + 0*b*x"'), [["'b'"]]),
    ("two parameters in no equation", model(["▸b = {}", "a = {}", "▸c = {}"], 'ode = "der(x) = a*u"'), [["'b'"], ["'c'"]]),
    ("a sum of two", model(["a = {}", "b = {}"], 'ode = ▸"der(x) = (a + b)*u"'), [["a, b", "a + b"]]),
    ("a sum of two beside a third", model(["a = {}", "b = {}", "c = {}"], 'ode = ▸"der(x) = a*u + b*u + c*x"'), [["a, b, c", "a + b"]]),
    ("a product of two", model(["a = {}", "b = {}"], 'ode = ▸"der(x) = a*b*u"'), [["a, b", "a*b"]]),
    ("a quotient of two", model(["a = {}", "b = {}"], 'ode = ▸"a*der(x) = b*u"'), [["a, b", "b/a"]]),
    ("all terms share a factor", model(["J = {}", "b = {}", "k = {}"], 'ode = ▸"J*der(x) = b*u + k*y"'), [["J, b, k", "b/J", "k/J"]]),
    ("two equations, one product", model(["a = {}", "b = {}"], 'ode = ▸"der(x) = a*b*u"', 'ode = "der(y) = 2*a*b*u"'), [["a, b", "a*b"]]),
    ("ratios that depend on each other", model(["a = {}", "b = {}", "c = {}"], 'ode = ▸"a*der(x) = b*y + c*u"', 'ode = "b*der(y) = c*u"'), [["a, b, c", "b/a", "c/a", "c/b"]]),
    ("a ratio and its inverse", model(["a = {}", "b = {}"], 'ode = ▸"der(x) = a/b*u"', 'ode = "der(y) = b/a*u"'), [["a, b", "a/b", "b/a"]]),
    ("a sum and its square", model(["a = {}", "b = {}"], 'ode = ▸"der(x) = (a + b)*u"', 'ode = "der(y) = (a + b)^2*u"'), [["a, b", "a + b"]]),
    ("products of signals alone, their constant erased", model(["a = {}", "b = {}"], 'ode = "a*der(x) = (2 + 2*a)*u + u"\nkappa = 1', 'ode = ▸"1000*a + b*u/y*(y - u) = 2 + b"\nkappa = 1'), [["b"]]),
    ("the second of two equations", model(["a = {}", "b = {}", "c = {}"], 'ode = "der(x) = a*u"', 'ode = ▸"der(y) = b*c*u"'), [["b, c", "b*c"]]),
    *[(f"two spellings of one signal: {ode}", model(["a = {}", "b = {}"], f'ode = ▸"der(x) = {ode}"'), [["a, b", f"enter only through {seen};"]]) for ode, seen in [
        ("a*sin(u + y) + b*sin(y + u)", "a + b"), ("a*sin(2*u) + b*sin(u + u)", "a + b"), ("a*sin(u*y) + b*sin(y*u)", "a + b"),
        ("a*sin((u + y)^2) + b*sin(u^2 + 2*u*y + y^2)", "a + b"), ("a*exp(-u/y) + b*exp(-(u*y^-1))", "a + b"), ("a*exp(0.1*u) + b*exp(u/10)", "a + b"),
        ("a*sin(cos(u + y)) + b*sin(cos(y + u))", "a + b"), ("a*max(u, y) + b*max(y, u)", "a + b"), ("a*sqrt(u + y) + b*(y + u)^(1/2)", "a + b"),
        ("a*y/(u + 1) + b*y/(1 + u)", "a + b"), ("a*y/(2*u + 2) + b*y/(1 + u)", "a + 2*b"), ("a*sin(u) + b*sin(-u)", "a - b"), ("a*cos(u - y) + b*cos(y - u)", "a + b"),
        ("a*tan(u - y) + b*tan(y - u)", "a - b"), ("a*abs(3*u) + b*abs(-u)", "3*a + b"), ("a*sgn(der(y)) + b*sgn(-2*der(y))", "a - b")]],
    ("a known part that a parameter takes up", model(["a = {}", "b = {}", "c = {}", "d = {}", "e = {}"], 'ode = ▸"2*e*der(x) = e*u + (1 + c)*y"', 'ode = "a*der(y) = d*u + e*x"',
                                                     'ode = "b*der(u) = a*x + e*y + 3*d*u"'), [["a, b, c, d, e"]]),
    ("kinematics ties two terms together", model(["a = {}", "b = {}", "c = {}"], 'ode = "der(x) = y"', 'ode = ▸"der(y) = a*u - b*y - c*der(x)"'), [["b, c cannot be told apart"]]),
    ("kinematics differentiated once", model(["a = {}", "b = {}", "c = {}"], 'ode = "der(x) = 2*y + 1"', 'ode = ▸"a*der(x,2) = u - b*der(y) - c*x"'), [["a, b cannot be told apart"]]),
    ("one signal is known by two others", model(["a = {}", "b = {}", "c = {}"], 'ode = "y = u - 3*x"', 'ode = ▸"der(x) = a*u + b*y + c*x"'), [["a, b, c cannot be told apart"]]),
    ("one signal is known by its square", model(["a = {}", "b = {}"], 'ode = "y = sin(u)*u"', 'ode = ▸"der(x) = a*u*sin(u) + b*y"'), [["a, b cannot be told apart"]]),
    ("function of what cancels", model(["a = {}", "▸b = {}"], 'ode = "der(x) = a*u + b*sin(u - u)"'), [["'b'"]]),
    ("inductance in a steady state", HEAD.replace("u = {}", "u = { steady = 1 }") + '[parameters]\nR = {}\n▸L = {}\n[[equation]]\node = "u = R*x + L*der(x)"\n[estimator]\nfunctional = "average"\nsolve = "elimination"\n',
     [["parameter 'L'"]]),
    ("a product under elimination", model(["a = {}", "b = {}"], 'ode = ▸"der(x) = a*b*u"') + '[estimator]\nsolve = "elimination"\n', [["a, b cannot be told apart"]]),
    ("parameter that the transfer equation does not name",
     HEAD + "[parameters]\n▸spare = {}\n[transfer]\nn = 1\nunknowns = [\"a0\", \"b0\"]\n", [["'spare'"]]),
]


class Unidentifiable(ModelCase):
    def test_each_is_answered_with_no(self):
        for name, text, words in CASES:
            content, places = without_marks(text)
            self.write(content)
            for command in (("check", "m.toml"), ("derive", "m.toml"), ("generate", "m.toml", "-o", "out")):
                with self.subTest(name, command=command[0]):
                    code, out, err, seconds = self.run_algest(*command)
                    self.assertEqual(code, 1, out + err)
                    self.assertEqual(complaints(err), [])
                    found = complaints(err, "not identifiable")
                    self.assertEqual([place[:2] for place in found], places, err)
                    for (_, _, text_found), wanted in zip(found, words):
                        for word in wanted:
                            self.assertIn(word, text_found)
                    self.assertEqual(out, "")
                    self.assertLess(seconds, 1.0)
                    self.assertEqual(self.entries(), ["m.toml"])

    def test_replay_answers_the_same(self):
        self.write(("t [s],x,y,u\n" + "".join(f"{k / 1000},{k % 7},{k % 5},{k % 3}\n" for k in range(100))).encode(), "r.csv")
        for text, wanted in ((model(["a = {}"], 'ode = "der(x) = a*u"'), 0), (model(["a = {}", "b = {}"], 'ode = "der(x) = a*b*u"'), 1),
                             (model(["a = {}", "b = {}"], 'ode = "y = 2*u"', 'ode = "der(x) = a*y + b*u"'), 1), (model(["a = {}"], 'ode = "der(x) = a*z"'), 2)):
            self.write(text.encode())
            code, _, err, _ = self.run_algest("replay", "m.toml", "r.csv")
            self.assertEqual(code, wanted, err)

    def test_functions_that_differ_are_told_apart(self):
        for ode in ("a*sin(u) + b*sin(2*u)", "a*exp(u) + b*exp(-u)", "a*max(u, y) + b*min(u, y)", "a*sqrt(u) + b*sqrt(u + 1)", "a*u^y + b*y^u",
                    "a*abs(u) + b*u", "a*sgn(u) + b*sgn(u + 1)", "a*cos(u + y) + b*cos(u - y)", "a/(u + y) + b/(u - y)", "a*log(u*y) + b*log(u/y)"):
            with self.subTest(ode):
                self.write(model(["a = {}", "b = {}"], f'ode = "der(x) = {ode}"').encode())
                self.assertEqual(self.run_algest("check", "m.toml")[0], 0)

    def test_equations_without_unknowns_that_tie_nothing(self):
        for tie, ode in (("der(x) = y", "der(y) = a*u - b*y - c*x"), ("der(x) = y", "a*der(x,2) = u - b*y - c*x"), ("y = u - 3*x", "der(x) = a*u + b*y + c"),
                         ("der(x) = y + sin(u)", "der(y) = a*der(x) + b*y + c*u"), ("y = u", "der(x) = a*u^2 + b*y + c")):
            with self.subTest(tie):
                self.write(model(["a = {}", "b = {}", "c = {}"], f'ode = "{tie}"', f'ode = "{ode}"').encode())
                self.assertEqual(self.run_algest("check", "m.toml")[0], 0)

    def test_bad_input_outweighs_it(self):
        content, _ = without_marks(model(["a = {}", "spare = {}"], 'ode = "der(x) = a*nowhere"'))
        self.write(content)
        self.assertEqual(self.run_algest("check", "m.toml")[0], 2)

    def test_check_answers_with_the_worst_of_several(self):
        self.write(model(["a = {}"], 'ode = "der(x) = a*u"').encode(), "good.toml")
        self.write(model(["a = {}", "spare = {}"], 'ode = "der(x) = a*u"').encode(), "no.toml")
        self.write(b"nonsense", "bad.toml")
        for models, wanted in ((("good.toml",), 0), (("no.toml", "good.toml"), 1), (("bad.toml", "no.toml", "good.toml"), 2)):
            self.assertEqual(self.run_algest("check", *models)[0], wanted)


if __name__ == "__main__":
    unittest.main()
