# SPDX-License-Identifier: GPL-3.0-or-later
"""What `derive --format json` makes of sound models: which way was taken, the unknowns and their inverse, every kernel. The
answers are worked out by hand; kernels come from the closed form of errata.md, not from the program."""
import json
import random
import unittest
from fractions import Fraction
from math import comb, factorial

from model_case import ModelCase, complaints, value

HEAD = 'name = "m"\n[sampling]\nperiod = 0.001\nwindow = 0.02\n'


def model(signals, constants, parameters, *equations):
    """Signals and parameters by name; constants as {name: value}; equations as an ode, or as (ode, further keys)."""
    text = HEAD + "[signals]\n" + "".join(f"{name} = {{}}\n" for name in signals.split())
    text += "[constants]\n" + "".join(f"{name} = {{ value = {value} }}\n" for name, value in constants.items())
    text += "[parameters]\n" + "".join(f"{name} = {{}}\n" for name in parameters.split())
    for equation in equations:
        ode, keys = equation if isinstance(equation, tuple) else (equation, "")
        text += f'[[equation]]\node = "{ode}"\n{keys}\n'
    return text


def transfer(text, signals="y u w"):
    return HEAD + "[signals]\n" + "".join(f"{name} = {{}}\n" for name in signals.split()) + "[transfer]\n" + text


def kernel(i, p, n, kappa):
    """Coefficients of F_(i,p) in sigma, lowest power first, on a window of length 1, oldest sample at 0 (errata.md: c_ij, gamma)."""
    out = [Fraction(0)] * (kappa + 2 * n + p + 1)
    for j in range(max(0, n - i), kappa + n + 1):
        c = Fraction(comb(kappa + n, j) * factorial(kappa + i), factorial(i + j - n))
        gamma = kappa + 2 * n + p - i - j - 1
        for k in range(gamma + 1):     # (1 - sigma)^gamma (-sigma)^j / gamma!
            out[k + j] += c * comb(gamma, k) * (-1) ** (k + j) / factorial(gamma)
    while out and out[-1] == 0:
        out.pop()
    return out


class Case:
    """equations: [(n, kappa, divided by or None, rows p, {unknown or None: [(coefficient, signal, derivative)]})]; unknowns are
    named by what they mean. A coefficient is that of the equation brought to the form sum = 0; the known side of a row has
    the opposite sign."""

    def __init__(self, name, text, equations, parameters):
        self.name, self.text, self.equations, self.parameters = name, text, equations, parameters


def linear(text, n, terms, name, parameters, kappa=0, rows=None):
    """One equation in which every parameter is an unknown itself."""
    return Case(name, text, [(n, kappa, None, rows or list(range(1, len(parameters) + 1)), terms)], {p: p for p in parameters})


COIL = [(1, 0, "L", [1, 2], {None: [(1, "i", 1)], "1/L": [(-1, "v", 0)], "R/L": [(1, "i", 0)]})]

CASES = [
    Case("coil: on a tie divided", model("v i", {}, "R L", "L*der(i) = v - R*i"), COIL, {"R": "(R/L)/(1/L)", "L": "1/(1/L)"}),
    Case("coil, divided as written", model("v i", {}, "R L", "der(i) = v/L - R*i/L"), COIL, {"R": "(R/L)/(1/L)", "L": "1/(1/L)"}),
    Case("permanent-magnet motor (000, 21 to 28)",
         model("v_d v_q i_d i_q omega", {"n_p": 50}, "R L K", ("L*der(i_d) = v_d - R*i_d + n_p*L*omega*i_q", "rows = 2"),
               ("L*der(i_q) = v_q - R*i_q - n_p*L*omega*i_d - K*omega", "rows = 1")),
         [(1, 0, "L", [1, 2], {None: [(1, "i_d", 1), (-50, "omega*i_q", 0)], "1/L": [(-1, "v_d", 0)], "R/L": [(1, "i_d", 0)]}),
          (1, 0, "L", [1], {None: [(1, "i_q", 1), (50, "omega*i_d", 0)], "1/L": [(-1, "v_q", 0)], "R/L": [(1, "i_q", 0)], "K/L": [(1, "omega", 0)]})],
         {"R": "(R/L)/(1/L)", "L": "1/(1/L)", "K": "(K/L)/(1/L)"}),
    Case("permanent-magnet motor, rows by default in turn",
         model("v_d v_q i_d i_q omega", {"n_p": 50}, "R L K", "L*der(i_d) = v_d - R*i_d + n_p*L*omega*i_q",
               "L*der(i_q) = v_q - R*i_q - n_p*L*omega*i_d - K*omega"),
         [(1, 0, "L", [1, 2], {None: [(1, "i_d", 1), (-50, "omega*i_q", 0)], "1/L": [(-1, "v_d", 0)], "R/L": [(1, "i_d", 0)]}),
          (1, 0, "L", [1], {None: [(1, "i_q", 1), (50, "omega*i_d", 0)], "1/L": [(-1, "v_q", 0)], "R/L": [(1, "i_q", 0)], "K/L": [(1, "omega", 0)]})],
         {"R": "(R/L)/(1/L)", "L": "1/(1/L)", "K": "(K/L)/(1/L)"}),
    # Divided it would need 7: 1/J1 b1/J1 k/J1 d/J1 b2/J2 k/J2 d/J2.
    Case("two masses and a shaft: as written",
         model("T w1 w2 q1 q2", {}, "J1 J2 b1 b2 k d", "J1*der(w1) = T - b1*w1 - k*(q1 - q2) - d*(w1 - w2)", "J2*der(w2) = k*(q1 - q2) + d*(w1 - w2) - b2*w2"),
         [(1, 0, None, [1, 2, 3], {None: [(-1, "T", 0)], "J1": [(1, "w1", 1)], "b1": [(1, "w1", 0)], "k": [(1, "q1", 0), (-1, "q2", 0)], "d": [(1, "w1", 0), (-1, "w2", 0)]}),
          (1, 0, None, [1, 2, 3], {None: [], "J2": [(1, "w2", 1)], "b2": [(1, "w2", 0)], "k": [(-1, "q1", 0), (1, "q2", 0)], "d": [(-1, "w1", 0), (1, "w2", 0)]})],
         {p: p for p in "J1 J2 b1 b2 k d".split()}),
    Case("leading coefficient a sum with a known part",
         model("u th", {"m": 2, "l": 0.5, "g": 10}, "J b", "(J + m*l^2)*der(th,2) = u - b*der(th) - m*g*l*sin(th)"),
         [(2, 0, "J + 1/2", [1, 2], {None: [(1, "th", 2)], "1/(J + 1/2)": [(-1, "u", 0), (10, "sin(th)", 0)], "b/(J + 1/2)": [(1, "th", 1)]})],
         {"J": "(1 - (1/(J + 1/2))/2)/(1/(J + 1/2))", "b": "(b/(J + 1/2))/(1/(J + 1/2))"}),
    Case("leading coefficient a sum of parameters",
         model("u th", {"l": 0.5, "g": 10}, "J m b", "(J + m*l^2)*der(th,2) = u - b*der(th) - m*g*l*sin(th)"),
         [(2, 0, "J + m/4", [1, 2, 3], {None: [(1, "th", 2)], "1/(J + m/4)": [(-1, "u", 0)], "b/(J + m/4)": [(1, "th", 1)], "m/(J + m/4)": [(5, "sin(th)", 0)]})],
         {"J": "(1 - (m/(J + m/4))/4)/(1/(J + m/4))", "m": "(m/(J + m/4))/(1/(J + m/4))", "b": "(b/(J + m/4))/(1/(J + m/4))"}),
    Case("known leading coefficient",
         model("x F", {"m": 2}, "k c", "m*der(x,2) = F - k*x - c*der(x)"),
         [(2, 0, "2", [1, 2], {None: [(1, "x", 2), (Fraction(-1, 2), "F", 0)], "k/2": [(1, "x", 0)], "c/2": [(1, "x", 1)]})],
         {"k": "2*(k/2)", "c": "2*(c/2)"}),
    linear(model("x F", {}, "k c", "der(x,2) = F - k*x - c*der(x)"), 2,
           {None: [(1, "x", 2), (-1, "F", 0)], "k": [(1, "x", 0)], "c": [(1, "x", 1)]}, "leading coefficient 1", ["k", "c"]),
    Case("magnetic bearing (000, 35)",
         model("Z Y q1 q2 q3", {"mass": 4, "gap": 5e-4, "c": 0.5, "s": 0.8}, "p1 p2 p3",
               ("mass*der(Z,2) = -p1*q1/(gap + Z)^2 + p2*c*q2/(gap + s*Y - c*Z)^2 + p3*c*q3/(gap - s*Y - c*Z)^2", "kappa = 1\nrows = 3")),
         [(2, 1, "4", [1, 2, 3], {None: [(1, "Z", 2)], "p1/4": [(1, "q1/(gap + Z)^2", 0)], "p2/4": [(Fraction(-1, 2), "q2/(gap + s*Y - c*Z)^2", 0)],
                                  "p3/4": [(Fraction(-1, 2), "q3/(gap - s*Y - c*Z)^2", 0)]})],
         {"p1": "4*(p1/4)", "p2": "4*(p2/4)", "p3": "4*(p3/4)"}),
    Case("positioning axis: a derivative inside a sign",
         model("q force", {}, "M Fv Fc offset", "M*der(q,2) + Fv*der(q) + Fc*sgn(der(q)) + offset = force"),
         [(2, 0, "M", [1, 2, 3, 4], {None: [(1, "q", 2)], "Fv/M": [(1, "q", 1)], "Fc/M": [(1, "sgn(der(q))", 0)], "offset/M": [(1, "1", 0)], "1/M": [(-1, "force", 0)]})],
         {"M": "1/(1/M)", "Fv": "(Fv/M)/(1/M)", "Fc": "(Fc/M)/(1/M)", "offset": "(offset/M)/(1/M)"}),
    Case("products and functions of signals",
         model("u i w th", {}, "J k b", "J*der(w) = u + k*i*sin(th) - b*abs(w)*w"),
         [(1, 0, "J", [1, 2, 3], {None: [(1, "w", 1)], "1/J": [(-1, "u", 0)], "k/J": [(-1, "i*sin(th)", 0)], "b/J": [(1, "abs(w)*w", 0)]})],
         {"J": "1/(1/J)", "k": "(k/J)/(1/J)", "b": "(b/J)/(1/J)"}),
    Case("parameters in denominators",
         model("u x", {}, "R C", "der(x) = (u - x/R)/C"),
         [(1, 0, "R*C", [1, 2], {None: [(1, "x", 1)], "1/C": [(-1, "u", 0)], "1/(R*C)": [(1, "x", 0)]})],
         {"R": "(1/C)/(1/(R*C))", "C": "1/(1/C)"}),
    Case("a product of parameters",
         model("u x", {}, "a b", "der(x) = a*b*x + a*u"),
         [(1, 0, None, [1, 2], {None: [(1, "x", 1)], "a*b": [(-1, "x", 0)], "a": [(-1, "u", 0)]})], {"a": "a", "b": "(a*b)/a"}),
    Case("sum and difference of parameters",
         model("u x", {}, "a b", "der(x) = (a + b)*x + (a - b)*u"),
         [(1, 0, None, [1, 2], {None: [(1, "x", 1)], "a + b": [(-1, "x", 0), (-1, "u", 0)], "b": [(2, "u", 0)]})], {"a": "(a + b) - b", "b": "b"}),
    Case("one equation tells what another needs",
         model("u x y", {}, "a b", "a*der(x) = b*u", "der(y) = a*x"),
         [(1, 0, "a", [1], {None: [(1, "x", 1)], "b/a": [(-1, "u", 0)]}), (1, 0, None, [1], {None: [(1, "y", 1)], "a": [(-1, "x", 0)]})],
         {"a": "a", "b": "(b/a)*a"}),
    Case("equations of different order and kappa share parameters",
         model("u x y", {}, "a b", ("der(x,2) = a*x + b*u", "kappa = 1"), "der(y) = a*u"),
         [(2, 1, None, [1], {None: [(1, "x", 2)], "a": [(-1, "x", 0)], "b": [(-1, "u", 0)]}), (1, 0, None, [1], {None: [(1, "y", 1)], "a": [(-1, "u", 0)]})],
         {"a": "a", "b": "b"}),
    Case("an equation without unknowns is left to simulation",
         model("u th w", {}, "a b", "der(th) = w", "der(w) = a*w + b*u"),
         [(1, 0, None, [1, 2], {None: [(1, "w", 1)], "a": [(-1, "w", 0)], "b": [(-1, "u", 0)]})], {"a": "a", "b": "b"}),
    linear(model("u x", {}, "a b", "x = a*u + b*sin(u)"), 0, {None: [(1, "x", 0)], "a": [(-1, "u", 0)], "b": [(-1, "sin(u)", 0)]}, "no derivative at all", ["a", "b"]),
    linear(model("u x", {}, "a b", ("der(x) = a*u + b*x + 5", "kappa = 1")), 1, {None: [(1, "x", 1)], "a": [(-1, "u", 0)], "b": [(-1, "x", 0)]},
           "kappa 1 erases a known constant", ["a", "b"], kappa=1),
    linear(model("u x", {}, "a b", "der(x) = a*u + b + 5"), 1, {None: [(1, "x", 1), (-5, "1", 0)], "a": [(-1, "u", 0)], "b": [(-1, "1", 0)]},
           "kappa 0 keeps constants", ["a", "b"]),
    linear(model("u x", {}, "a b", "der(x) = a*(x + 1)^2 - b*u"), 1, {None: [(1, "x", 1)], "a": [(-1, "x^2", 0), (-2, "x", 0), (-1, "1", 0)], "b": [(1, "u", 0)]},
           "a square is multiplied out", ["a", "b"]),
    linear(model("u x", {"n": 2}, "a b", "der(x) = a*x^(n - 1) + 0.1*b*u^n + 1e-3*u"), 1,
           {None: [(1, "x", 1), (Fraction(-1, 1000), "u", 0)], "a": [(-1, "x", 0)], "b": [(Fraction(-1, 10), "u^2", 0)]}, "decimals are exact, exponents may be constants", ["a", "b"]),
    linear(model("u x", {}, "a", "der(x) = a*u/(x*(2 + u))"), 1, {None: [(1, "x", 1)], "a": [(-1, "u/(x*(2 + u))", 0)]}, "signals in denominators", ["a"]),
    linear(model("u x", {}, "a b", ("der(x) = a*x + b*u", "rows = [2, 4]")), 1, {None: [(1, "x", 1)], "a": [(-1, "x", 0)], "b": [(-1, "u", 0)]}, "a list of rows", ["a", "b"], rows=[2, 4]),
    linear(model("u x", {}, "a b", ("der(x) = a*x + b*u", "rows = 4")), 1, {None: [(1, "x", 1)], "a": [(-1, "x", 0)], "b": [(-1, "u", 0)]}, "more rows than unknowns", ["a", "b"], rows=[1, 2, 3, 4]),
    linear(model("u x", {}, "a b", ("der(x) = a*x + b*u", "kappa = 3")), 1, {None: [(1, "x", 1)], "a": [(-1, "x", 0)], "b": [(-1, "u", 0)]}, "kappa 3", ["a", "b"], kappa=3),
    linear(model("u x", {}, "a b", "der(x) = a*u + b*(a - a + x)^2*(u - u)^0"), 1, {None: [(1, "x", 1)], "a": [(-1, "u", 0)], "b": [(-1, "x^2", 0)]}, "powers of 0 and what cancels", ["a", "b"]),
    linear(transfer('n = 1\nunknowns = ["a0"]\n[[transfer.input]]\nsignal = "u"\nunknowns = ["b0"]\n[[transfer.input]]\nsignal = "w"\nm = 1\nunknowns = ["c0"]\nknown = { c1 = -3 }\n'), 1,
           {None: [(1, "y", 1), (3, "w", 1)], "a0": [(1, "y", 0)], "b0": [(-1, "u", 0)], "c0": [(-1, "w", 0)]}, "two inputs", ["a0", "b0", "c0"]),
    linear(transfer('n = 2\nm = 2\nunknowns = ["a0", "a1", "b0", "b1", "b2"]\n'), 2,
           {None: [(1, "y", 2)], "a0": [(1, "y", 0)], "a1": [(1, "y", 1)], "b0": [(-1, "u", 0)], "b1": [(-1, "u", 1)], "b2": [(-1, "u", 2)]},
           "m = n", ["a0", "a1", "b0", "b1", "b2"]),
    linear(transfer('n = 2\nunknowns = ["b0"]\nknown = { a0 = 3, a1 = "1/3" }\n'), 2,
           {None: [(1, "y", 2), (Fraction(1, 3), "y", 1), (3, "y", 0)], "b0": [(-1, "u", 0)]}, "all coefficients known but one", ["b0"]),
    linear(transfer('n = 1\noutput = "w"\ninput = "y"\nunknowns = ["a0", "d0"]\n'), 1,
           {None: [(1, "w", 1)], "a0": [(1, "w", 0)], "d0": [(-1, "y", 0)]}, "other names of output, input and coefficient", ["a0", "d0"]),
    Case("unknown coefficient of the highest derivative",
         transfer('n = 1\nunknowns = ["a0", "a1"]\nknown = { b0 = 2 }\n'),
         [(1, 0, "a1", [1, 2], {None: [(1, "y", 1)], "a0/a1": [(1, "y", 0)], "1/a1": [(-2, "u", 0)]})], {"a0": "(a0/a1)/(1/a1)", "a1": "1/(1/a1)"}),
    Case("known coefficient of the highest derivative",
         transfer('n = 1\nunknowns = ["a0", "b0"]\nknown = { a1 = 4 }\n'),
         [(1, 0, "4", [1, 2], {None: [(1, "y", 1)], "a0/4": [(1, "y", 0)], "b0/4": [(-1, "u", 0)]})], {"a0": "4*(a0/4)", "b0": "4*(b0/4)"}),
]
for _n in range(1, 6):     # the third-order DC motor of 003 among them
    _names = [f"a{_i}" for _i in range(_n)] + ["b0"]
    CASES.append(linear(transfer(f"n = {_n}\nunknowns = {_names}\nkappa = {_n % 3}\n".replace("'", '"')), _n,
                        {None: [(1, "y", _n)], **{f"a{_i}": [(1, "y", _i)] for _i in range(_n)}, "b0": [(-1, "u", 0)]},
                        f"transfer of order {_n}", _names, kappa=_n % 3))


class Derivations(ModelCase):
    def derive(self, text):
        self.write(text.encode())
        code, out, err, seconds = self.run_algest("derive", "m.toml", "--format", "json")
        self.assertEqual(code, 0, err)
        self.assertLess(seconds, 1.0)
        self.assertEqual(self.run_algest("check", "m.toml")[0], 0)
        return json.loads(out), err

    def same(self, text, wanted, numbers):
        self.assertEqual(value(text, numbers), value(wanted, numbers), f"{text} is not {wanted}")

    def examine(self, case, answer):
        draw = random.Random(case.name)
        for _ in range(3):
            numbers = {p: Fraction(draw.randint(2, 10 ** 6), draw.randint(1, 10 ** 3)) for p in case.parameters}
            # Unknowns: by meaning, each of those wanted exactly once.
            wanted = {key for _, _, _, _, terms in case.equations for key in terms if key is not None}
            self.assertEqual(len(answer["unknowns"]), len(wanted), answer["unknowns"])
            name_of = {}
            for unknown in answer["unknowns"]:
                matching = [key for key in wanted if value(key, numbers) == value(unknown["meaning"], numbers)]
                self.assertEqual(len(matching), 1, unknown)
                name_of[matching[0]] = unknown["name"]
            # Parameters: the inverse map is exact, and the one that was worked out.
            self.assertEqual([parameter["name"] for parameter in answer["parameters"]], list(case.parameters))
            lumped = {unknown["name"]: value(unknown["meaning"], numbers) for unknown in answer["unknowns"]}
            for parameter in answer["parameters"]:
                self.assertEqual(value(parameter["from"], lumped), numbers[parameter["name"]], parameter)
            free = {name: Fraction(draw.randint(2, 10 ** 6), 7) for name in lumped}
            for parameter in answer["parameters"]:
                inverse = case.parameters[parameter["name"]]
                for key in sorted(name_of, key=len, reverse=True):
                    inverse = inverse.replace(f"({key})", name_of[key])
                self.assertEqual(value(parameter["from"], free), value(inverse, free), f"{parameter['from']} is not {inverse}")
            for equation, (_, _, divided_by, _, _) in zip(answer["equations"], case.equations):
                if divided_by is None:
                    self.assertIsNone(equation["divided_by"])
                else:
                    self.assertIsNotNone(equation["divided_by"])
                    self.same(equation["divided_by"], divided_by, numbers)
        # Rows.
        self.assertEqual(len(answer["equations"]), len(case.equations))
        for equation, (n, kappa, _, rows, terms) in zip(answer["equations"], case.equations):
            self.assertEqual((equation["n"], equation["kappa"], [row["p"] for row in equation["rows"]]), (n, kappa, rows))
            for row in equation["rows"]:
                found = sorted((str(term["parameter"]), term["signal"], term["derivative"], [Fraction(c) for c in term["kernel"]]) for term in row["terms"])
                expected = sorted((str(name_of.get(key)), signal, derivative,
                                   [(1 if key is not None else -1) * c * Fraction(factor) for c in kernel(derivative, row["p"], n, kappa)])
                                  for key, list_of in terms.items() for factor, signal, derivative in list_of)
                self.assertEqual(found, expected)

    def test_derivations_are_those_worked_out_by_hand(self):
        for case in CASES:
            with self.subTest(case.name):
                self.examine(case, self.derive(case.text)[0])

    def test_the_closed_form_of_this_test_is_right_where_it_is_short(self):
        self.assertEqual(kernel(0, 1, 1, 0), [0, -1, 1])                    # RL circuit: -sigma (1 - sigma)
        self.assertEqual(kernel(1, 1, 1, 0), [1, -2])
        self.assertEqual(kernel(0, 1, 2, 0), [0, 0, Fraction(1, 2), -1, Fraction(1, 2)])   # sigma^2 (1 - sigma)^2 / 2

    def test_an_equation_without_unknowns_is_named(self):
        self.write(model("u th w", {}, "a b", ("der(th) = w", 'name = "kinematics"'), "der(w) = a*w + b*u").encode())
        self.assertIn("'kinematics' has no unknowns", self.run_algest("generate", "m.toml", "-o", "out")[2])

    def test_units_of_transfer_coefficients_follow_from_the_signals(self):
        head = HEAD + '[signals]\ny = { unit = "rad" }\nu = { unit = "V" }\nw = { unit = "-" }\n[transfer]\nn = 2\n'
        answer, err = self.derive(head + 'm = 1\nunknowns = ["a0", "a1", "b0", "b1"]\n')
        self.assertEqual([(p["name"], p["unit"]) for p in answer["parameters"]], [("a0", "1/s^2"), ("a1", "1/s"), ("b0", "rad/(V.s^2)"), ("b1", "rad/(V.s)")])
        self.assertEqual(complaints(err, "warning"), [])
        answer, _ = self.derive(head + 'input = "w"\nunknowns = ["a0", "a1", "c0"]\n')
        self.assertEqual(answer["parameters"][2]["unit"], "rad/s^2")
        answer, _ = self.derive(head + 'unknowns = ["a0"]\noutput = "w"\n[[transfer.input]]\nsignal = "u"\nunknowns = ["b0"]\n'.replace("n = 2", "n = 1") + "known = { b1 = 0 }\nm = 1\n[transfer.known]\na1 = 0\n")
        self.assertEqual([p["unit"] for p in answer["parameters"]], ["1/s^2", "1/(V.s^2)"])

    def test_known_coefficients_of_a_transfer_equation_carry_their_units(self):
        answer, _ = self.derive(HEAD + '[signals]\ny = { unit = "rad" }\nu = { unit = "V" }\n[transfer]\nn = 2\nunknowns = ["b0"]\nknown = { a0 = 1, a1 = 2.5 }\n')
        self.assertEqual([p["name"] for p in answer["parameters"]], ["b0"])

    def test_parameters_of_a_transfer_equation_may_be_declared(self):
        answer, _ = self.derive(HEAD + '[signals]\ny = { unit = "rad" }\nu = { unit = "V" }\n[parameters]\na0 = { unit = "1/s", initial = 3 }\n[transfer]\nn = 1\nunknowns = ["a0", "b0"]\n')
        self.assertEqual([(p["name"], p["unit"]) for p in answer["parameters"]], [("a0", "1/s"), ("b0", "rad/(V.s)")])

    def test_dimensions_that_fit(self):
        for ode in ("k*x^2 = F*x", "k*x^(1 + 1) = F*x", "F = k*sqrt(x^2)", "F = k*(x^3)^(1/3)", "F = k*max(x, -x)*sgn(x)", "F = k*x*exp(x/gap)*cos(2*x/gap)",
                    "F = k*x + 0", "F + k*x = 0", "F = k*abs(x)^two/gap"):
            with self.subTest(ode):
                text = (HEAD + '[signals]\nx = { unit = "m" }\nF = { unit = "N" }\n[constants]\ngap = { value = 3, unit = "m" }\ntwo = { value = 2, unit = "1" }\n'
                        f'[parameters]\nk = {{ unit = "N/m" }}\n[[equation]]\node = "{ode}"\n')
                _, err = self.derive(text)
                self.assertEqual(complaints(err, "warning"), [])


    def test_long_formulas_are_quick(self):
        for ode in ("der(x) = a*x" + " + sqrt(2)*u" * 600,
                    "der(x) = a*x" + "".join(f" + sqrt({k})" for k in range(2, 1000)),
                    "".join(f"sqrt({k}) + " for k in range(2, 1000)) + "der(x) = a*x",
                    "der(x) = a*x" + "".join(f" + {k}/{k + 1}" for k in range(1, 900)),
                    "der(x) = a*x*" + "*".join(["u"] * 1900),
                    "der(x) = " + " + ".join(f"a*sin({k}*u)" for k in range(500)),
                    "der(x) = a*" + "(" * 99 + "x" + ")" * 99,
                    "der(x) = a*x + (1 + u + x + u*x)^10*a"):
            with self.subTest(ode[:40]):
                self.derive(model("u x", {}, "a", ode))


if __name__ == "__main__":
    unittest.main()
