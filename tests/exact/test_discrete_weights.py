# SPDX-License-Identifier: GPL-3.0-or-later
"""Every weight of a discrete-time estimator is the nearest number of its scalar to the exact one, which is summed up here in whole numbers as
paper 004 writes it (section II): chi(k) times a combination of samples, then sums of sums. Tables come from `derive --format json --weights`."""
import json
import subprocess
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

from environment import ALGEST, SOURCE


def product(*factors):
    out = [Fraction(1)]
    for factor in factors:
        longer = [Fraction(0)] * (len(out) + len(factor) - 1)
        for a, x in enumerate(out):
            for b, y in enumerate(factor):
                longer[a + b] += x * Fraction(y)
        out = longer
    return out


def combinations(domain, n, m, numerator, omega0):
    """By unknown: whether the input's, and what stands at z^0 .. z^n, with the sign of (3) and (9) on the unknown side."""
    minus, plus = [-1, 1], [1, 1]
    out = {}
    if domain == "q":
        for i in range(1, n + 1):
            out[f"A{i}"] = False, [c * omega0**i for c in product(*[minus] * i, *[plus] * (n - i))]
        for i in range(numerator + 1):
            out[f"B{i}"] = True, [-c * omega0**i * 2 ** (n - m) for c in product(*[minus] * i, *[plus] * (m - i))]
        out[None] = False, [-c for c in product(*[plus] * n)]
    else:
        for i in range(n):
            out[f"a{i}"] = False, [Fraction(k == i) for k in range(n + 1)]
        for i in range(numerator + 1):
            out[f"b{i}"] = True, [-c for c in [Fraction(0)] * i + product(*[plus] * (m - numerator))]
        out[None] = False, [-Fraction(k == n) for k in range(n + 1)]
    return {name: (of_input, taps + [Fraction(0)] * (n + 1 - len(taps))) for name, (of_input, taps) in out.items()}


def influence(j, taps, n, derivatives, level, gamma, intervals):
    """What one sample f(j) = 1 gives to the row: chi(k) sum_s taps[s] f(k-n+s), summed `level` times over all earlier k."""
    values = []
    for k in range(intervals + 1):
        chi = 1
        for s in range(derivatives):
            chi *= k - n + s
        s = j - k + n
        values.append(chi * taps[s] if 0 <= s <= n else 0)
    for _ in range(level):
        total, summed = 0, []
        for v in values:
            summed.append(total)
            total = gamma * total + v
        values = summed
    return values[-1]


def nearest(exact):
    """Python divides whole numbers with one rounding."""
    return exact.numerator / exact.denominator


def model(**keys):
    choice = {"domain": '"q"', "n": 3, "m": 2, "numerator": 2, "skip": 1, "extra": 3, "period": 0.05, "window": 1.5, "solve": '"square"'} | keys
    sampling = {k: choice.pop(k) for k in ("period", "window")}
    solve = choice.pop("solve")
    return ('format = 1\nname = "shape"\n[sampling]\n' + "".join(f"{k} = {v}\n" for k, v in sampling.items()) +
            '[signals]\nu = { unit = "V" }\ny = { unit = "m" }\n[discrete]\n' + "".join(f"{k} = {v}\n" for k, v in choice.items()) +
            f'[estimator]\nfunctional = "discrete"\nsolve = {solve}\n')


class DiscreteWeights(unittest.TestCase):
    def derived(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "model.toml"
            path.write_text(text, encoding="utf-8")
            done = subprocess.run([ALGEST, "derive", path, "--format", "json", "--weights"], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def check_rows(self, text, first, last, period, gamma=1, samples=None):
        found = self.derived(text)
        (equation,) = found["equations"]
        n, derivatives, intervals = equation["n"], equation["derivatives"], found["samples"] - 1
        wanted = combinations(found["domain"], n, equation["m"], equation["numerator"], 2 / period)
        self.assertEqual([row["level"] for row in equation["rows"]], list(range(first, last + 1)))
        for row in equation["rows"]:
            ratios = set()
            self.assertEqual([t["parameter"] for t in row["terms"]], list(wanted))
            for term in row["terms"]:
                of_input, taps = wanted[term["parameter"]]
                self.assertEqual(term["signal"] == "u", of_input)
                scale = Fraction(term["scale"])   # what all taps have in common, with the sign of the term
                whole = [int(t / scale) for t in taps]
                self.assertEqual([scale * t for t in whole], taps)
                chosen = samples or range(intervals + 1)
                exact = {j: influence(j, whole, n, derivatives, row["level"], gamma, intervals) for j in chosen}
                weights = [float.fromhex(w) for w in term["weights"]]
                self.assertEqual(len(weights), intervals + 1)
                size = sum(map(abs, weights))
                self.assertTrue(0.5 * (1 - 1e-12) <= size <= 1 + 1e-12, size)
                largest = max(exact, key=lambda j: abs(exact[j]))
                unit = Fraction(weights[largest]) / exact[largest]
                if gamma != 1:   # the common denominator of the powers of gamma is no power of two
                    self.assertTrue(all(abs(Fraction(weights[j]) - unit * exact[j]) <= abs(unit * exact[j]) / 2**50 for j in chosen))
                    continue
                power = Fraction(2) ** round_log2(unit)
                for j in chosen:
                    self.assertEqual(weights[j], nearest(exact[j] * power), (row["level"], term["parameter"], j))
                ratios.add(Fraction(float.fromhex(term["factor"])) * power / scale)
            self.assertLessEqual(len(ratios), 1, "one power of two is left for the whole row")

    def test_q(self):
        self.check_rows(model(), 1, 3 + 2 + 1 + 3, Fraction(1, 20))

    def test_z_with_preset_zeros_and_more_derivatives(self):
        self.check_rows(model(domain='"z"', numerator=1, derivatives=6), 1, 3 + 1 + 1 + 3, Fraction(1, 20))

    def test_preset_zeros_of_q_and_level_0(self):
        self.check_rows(model(numerator=0, m=3, skip=0, extra=0), 0, 3, Fraction(1, 20))

    def test_gamma(self):
        self.check_rows(model(gamma='"3/4"', numerator=0), 1, 3 + 0 + 1 + 3, Fraction(1, 20), Fraction(3, 4))

    def test_the_drive_train(self):
        text = (SOURCE / "models" / "drive_train.toml").read_text(encoding="utf-8")
        self.check_rows(text, 7, 22, Fraction(1, 100), samples=range(0, 136, 9))

    def test_least_squares_is_the_equation_itself(self):
        found = self.derived(model(solve='"least_squares"'))
        (row,) = found["equations"][0]["rows"]
        self.assertEqual(found["samples"], 4)
        for term in row["terms"]:
            _, taps = combinations("q", 3, 2, 2, Fraction(40))[term["parameter"]]
            factor = Fraction(float.fromhex(term["factor"]))
            ratio = {factor * Fraction(float.fromhex(w)) / t for w, t in zip(term["weights"], taps) if t != 0}
            self.assertEqual(len(ratio), 1)
            self.assertEqual([w == "0x0p+0" for w in term["weights"]], [t == 0 for t in taps])


def round_log2(x):
    """The exponent of the power of two nearest to x > 0 in ratio."""
    exponent = x.numerator.bit_length() - x.denominator.bit_length()
    return min((exponent - 1, exponent, exponent + 1), key=lambda e: max(x / Fraction(2) ** e, Fraction(2) ** e / x))


if __name__ == "__main__":
    unittest.main()
