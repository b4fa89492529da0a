# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows as `algest derive --format json` gives them hold exactly on exact data: polynomials with arbitrary initial conditions that
solve a random equation. Windows of length T != 1, anywhere in time; perturbations up to the order that kappa says, and one more."""
import json
import random
import re
import subprocess
import tempfile
import unittest
from fractions import Fraction
from math import comb, factorial
from pathlib import Path

from definition import definition, moment
from environment import ALGEST


class Polynomial:
    """In time, coefficients lowest power first; with the operations that a signal's formula needs."""

    def __init__(self, *coefficients):
        self.c = [Fraction(x) for x in coefficients]

    def __add__(self, other):
        other = other if isinstance(other, Polynomial) else Polynomial(other)
        size = max(len(self.c), len(other.c))
        return Polynomial(*((self.c[k] if k < len(self.c) else 0) + (other.c[k] if k < len(other.c) else 0) for k in range(size)))

    def __mul__(self, other):
        other = other if isinstance(other, Polynomial) else Polynomial(other)
        out = [Fraction(0)] * max(len(self.c) + len(other.c) - 1, 1)
        for a, x in enumerate(self.c):
            for b, y in enumerate(other.c):
                out[a + b] += x * y
        return Polynomial(*out)

    def __pow__(self, exponent):
        out = Polynomial(1)
        for _ in range(int(exponent)):
            out = out * self
        return out

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        return self + other * -1

    def derivative(self, order):
        p = self
        for _ in range(order):
            p = Polynomial(*(k * p.c[k] for k in range(1, len(p.c))))
        return p

    def in_window(self, start, length):
        """f(start + length sigma) as coefficients in sigma."""
        out = [Fraction(0)] * len(self.c)
        for k, x in enumerate(self.c):
            for q in range(k + 1):
                out[q] += x * comb(k, q) * start ** (k - q) * length ** q
        return out


def exact(text, names):
    """A formula of whole numbers, quotients, powers and names, in exact numbers."""
    return eval(re.sub(r"(?<![\w.])\d+", r"Fraction(\g<0>)", text.replace("^", "**")), {"Fraction": Fraction, **names})


def fraction(chance, sizes=9):
    """Not zero."""
    return Fraction(chance.choice([-1, 1]) * chance.randint(1, sizes), chance.randint(1, sizes))


def any_polynomial(chance, degree):
    return Polynomial(*(fraction(chance) for _ in range(degree + 1)))


def perturbation(coefficients):
    """sum of c_l t^(l-1)/(l-1)!, l = 1, 2, ..."""
    return Polynomial(*(c / factorial(k) for k, c in enumerate(coefficients)))


def apply(kernel, f, start, length):
    """The integral over [0,1] of kernel(sigma) f(start + length sigma)."""
    coefficients = f.in_window(start, length)
    return sum((k * c / (a + b + 1) for a, k in enumerate(kernel) for b, c in enumerate(coefficients)), Fraction(0))


class RowIdentity(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.chance = random.Random(20260105)

    def derive(self, text):
        path = self.folder / "model.toml"
        path.write_text(text)
        result = subprocess.run([ALGEST, "derive", path, "--format", "json"], stdin=subprocess.DEVNULL, capture_output=True,
                                text=True, timeout=60)
        self.assertEqual(result.returncode, 0, f"{text}\n{result.stdout}{result.stderr}")
        return json.loads(result.stdout)

    def residuals(self, derived, signals, parameters, start, length):
        """Unknown side minus known side of every row: {(equation, p): exact number}."""
        lumped = {u["name"]: exact(u["meaning"], parameters) for u in derived["unknowns"]}
        out = {}
        for equation in derived["equations"]:
            for row in equation["rows"]:
                total = Fraction(0)
                for term in row["terms"]:
                    f = exact(term["signal"], signals)
                    f = f if isinstance(f, Polynomial) else Polynomial(f)
                    functional = apply([Fraction(c) for c in term["kernel"]], f, start, length) / length ** term["derivative"]
                    total += -functional if term["parameter"] is None else lumped[term["parameter"]] * functional
                out[equation["name"], row["p"]] = total
        # ... and the physical parameters come back from the lumped ones
        for p in derived["parameters"]:
            self.assertEqual(exact(p["from"], lumped), parameters[p["name"]], f"{p['name']} = {p['from']}")
        return out

    def head(self, length, intervals, signals, estimator=""):
        lines = ['format = 1', 'name = "identity"', '[sampling]', f'period = "{length / intervals}"', f'window = "{length}"', '[signals]']
        return "\n".join(lines + [f"{s} = {{}}" for s in signals]) + "\n" + estimator

    def window(self):
        start = Fraction(self.chance.randint(-9, 9), self.chance.randint(1, 5))
        length = self.chance.choice([Fraction(1, 3), Fraction(7, 2), Fraction(1, 50), Fraction(20), Fraction(1)])
        return start, length

    def test_transfer_equations(self):
        checked = 0
        for n in range(1, 6):
            for kappa in range(4):
                for m in sorted({0, self.chance.randint(0, n), n}):
                    with self.subTest(n=n, kappa=kappa, m=m):
                        checked += self.one_transfer(n, kappa, m)
        self.assertGreater(checked, 100)   # rows: 20 orders, at least 2 values of m, more than two rows each on average

    def one_transfer(self, n, kappa, m):
        chance = self.chance
        a = {f"a{i}": fraction(chance) for i in range(n + 1)}
        b = {f"b{i}": fraction(chance) for i in range(m + 1)}
        if chance.random() < 0.5:
            a[f"a{n}"] = Fraction(1)
        unknown = {name for name in [*a, *b] if chance.random() < 0.7 and not (name == f"a{n}" and a[name] == 1)}
        if chance.random() < 0.3:
            unknown -= set(b)
        unknown = unknown or {"a0"}
        start, length = self.window()

        def listed(coefficients):
            known = ", ".join(f'{k} = "{v}"' for k, v in coefficients.items() if k not in unknown)
            names = [k for k in coefficients if k in unknown]
            return f"unknowns = {json.dumps(names)}\nknown = {{ {known} }}\n"

        # w is measured as well, enters as it is, and takes up what makes the equation true
        text = (self.head(length, 40, ["y", "u", "w"]) + f'[transfer]\nn = {n}\nkappa = {kappa}\n' + listed(a) +
                f'[[transfer.input]]\nsignal = "u"\nm = {m}\n' + listed(b) +
                '[[transfer.input]]\nsignal = "w"\nm = 0\nknown = { w0 = 1 }\n')
        derived = self.derive(text)
        y, u = any_polynomial(chance, n + kappa + 3), any_polynomial(chance, m + kappa + 2)
        left = sum((a[f"a{i}"] * y.derivative(i) for i in range(n + 1)), Polynomial(0))
        right = sum((b[f"b{i}"] * u.derivative(i) for i in range(m + 1)), Polynomial(0))
        parameters = {k: v for k, v in {**a, **b}.items() if k in unknown}

        def residuals(perturbing):
            return self.residuals(derived, {"y": y, "u": u, "w": left - right - perturbation(perturbing)}, parameters, start, length)

        erased = [fraction(chance) for _ in range(kappa)]
        rows = residuals(erased)
        self.assertGreaterEqual(len(rows), len(parameters))
        self.assertEqual(set(rows.values()), {0}, text)

        # One term more is not erased: what is left is its coefficient times F_0[(T sigma)^kappa / kappa!], which no choice of
        # where the window starts changes. Its sign and size depend on which side the terms stand on and what was divided by.
        survivor = fraction(chance)
        scales = set()
        for (_, p), rest in residuals(erased + [survivor]).items():
            scales.add(rest / (survivor * length ** kappa * moment(definition(n, kappa, 0, p), kappa) / factorial(kappa)))
        self.assertEqual(len(scales), 1)
        divisor = derived["equations"][0]["divided_by"]
        self.assertEqual(abs(scales.pop()), 1 if divisor is None else abs(1 / exact(divisor, parameters)))
        return len(rows)

    def check(self, text, signals, parameters, start, length, broken):
        """All rows hold; with `broken`, the same signals but for one, none does."""
        derived = self.derive(text)
        rows = self.residuals(derived, signals, parameters, start, length)
        self.assertEqual(set(rows.values()), {0}, text)
        for name, rest in self.residuals(derived, {**signals, **broken}, parameters, start, length).items():
            self.assertNotEqual(rest, 0, name)
        return derived

    def test_division_by_the_leading_coefficient(self):
        chance = self.chance
        for kappa in range(3):
            start, length = self.window()
            R, L = abs(fraction(chance)), abs(fraction(chance))
            i = any_polynomial(chance, 5)
            v = L * i.derivative(1) + R * i + perturbation([fraction(chance) for _ in range(kappa)])
            text = (self.head(length, 9, ["i", "v"]) + '[parameters]\nR = {}\nL = {}\n' +
                    f'[[equation]]\nname = "coil"\node = "L*der(i) = v - R*i"\nkappa = {kappa}\n')
            derived = self.check(text, {"i": i, "v": v}, {"R": R, "L": L}, start, length, {"v": v + Polynomial(*[0] * kappa, 1)})
            self.assertEqual(derived["equations"][0]["divided_by"], "L")

    def test_products_of_signals(self):
        chance = self.chance
        for kappa in range(3):
            start, length = self.window()
            names = {k: fraction(chance) for k in ("a", "b", "k", "M")}
            y, u = any_polynomial(chance, 3), any_polynomial(chance, 2)
            w = (names["M"] * y.derivative(3) + names["a"] * y * y * u + names["b"] * y.derivative(1) + Fraction(5, 2) * y * u
                 - names["k"] * u * u * u - perturbation([fraction(chance) for _ in range(kappa)]))
            text = (self.head(length, 30, ["y", "u", "w"]) + "[constants]\nc = { value = 2.5 }\n[parameters]\n" +
                    "".join(f"{k} = {{}}\n" for k in names) +
                    f'[[equation]]\nname = "products"\node = "M*der(y,3) + a*y^2*u + b*der(y) + c*u*y = k*u^3 + w"\nkappa = {kappa}\n')
            self.check(text, {"y": y, "u": u, "w": w}, names, start, length, {"y": y + Polynomial(*[0] * (kappa + 3), 1)})

    def test_equations_that_share_parameters(self):
        chance = self.chance
        start, length = self.window()
        R, L, K, n_p = abs(fraction(chance)), abs(fraction(chance)), abs(fraction(chance)), Fraction(50)
        i_d, i_q, omega = any_polynomial(chance, 4), any_polynomial(chance, 3), any_polynomial(chance, 2)
        v_d = L * i_d.derivative(1) + R * i_d - n_p * L * omega * i_q
        v_q = L * i_q.derivative(1) + R * i_q + n_p * L * omega * i_d + K * omega + perturbation([fraction(chance)])
        text = (self.head(length, 25, ["v_d", "v_q", "i_d", "i_q", "omega"]) +
                '[constants]\nn_p = { value = 50 }\n[parameters]\nR = {}\nL = {}\nK = {}\n'
                '[[equation]]\nname = "d"\node = "L*der(i_d) = v_d - R*i_d + n_p*L*omega*i_q"\nrows = [1, 3]\n'
                '[[equation]]\nname = "q"\node = "L*der(i_q) = v_q - R*i_q - n_p*L*omega*i_d - K*omega"\nrows = 2\nkappa = 1\n'
                '[estimator]\nsolve = "least_squares"\n')
        signals = {"v_d": v_d, "v_q": v_q, "i_d": i_d, "i_q": i_q, "omega": omega}
        derived = self.check(text, signals, {"R": R, "L": L, "K": K}, start, length, {"i_d": i_d + 1, "i_q": i_q + Polynomial(0, 1)})
        self.assertEqual([(e["name"], e["n"], e["kappa"], [r["p"] for r in e["rows"]]) for e in derived["equations"]],
                         [("d", 1, 0, [1, 3]), ("q", 1, 1, [1, 2])])

    def test_an_unknown_offset(self):
        """A constant among the terms is the signal 1, and kappa = 0 keeps it."""
        chance = self.chance
        start, length = self.window()
        M, offset = fraction(chance), fraction(chance)
        q = any_polynomial(chance, 5)
        force = M * q.derivative(2) + offset
        text = (self.head(length, 25, ["q", "force"]) + '[parameters]\nM = {}\noffset = {}\n'
                '[[equation]]\nname = "axis"\node = "M*der(q,2) + offset = force"\n')
        self.check(text, {"q": q, "force": force}, {"M": M, "offset": offset}, start, length, {"force": force + Polynomial(0, 1)})


if __name__ == "__main__":
    unittest.main()
