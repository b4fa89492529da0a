# SPDX-License-Identifier: GPL-3.0-or-later
"""Every weight that is emitted or shown is the double (float) nearest to the exact integral, taken from the definition of the
functional (definition.py) interval by interval: all models of models/, and small ones of many shapes."""
import json
import math
import re
import subprocess
import tempfile
import tomllib
import unittest
from fractions import Fraction
from pathlib import Path

from definition import bits, definition, moment, nearest_double, nearest_float, polynomial, value, weights
from environment import ALGEST, SOURCE

MODELS = [path for path in sorted((SOURCE / "models").glob("*.toml")) if "functional =" not in path.read_text() and "[discrete]" not in path.read_text()]   # of windows: derivatives have no kernels, discrete.md's have test_discrete_weights
NEAREST = {"double": nearest_double, "float": nearest_float}
LEAST_NORMAL = {"double": 2.0 ** -1022, "float": 2.0 ** -126}

# By hand from the equations of the models: what stands before each functional, up to a common factor of the row.
COEFFICIENTS = {
    "dc_motor": {"transfer": {("a2", "y", 2): 1, ("a1", "y", 1): 1, ("b0", "u", 0): -1, (None, "y", 3): -1}},
    "rl_circuit": {"voltage balance": {("Gamma1", "v", 0): -1, ("Gamma2", "i", 0): 1, (None, "i", 1): -1}},
    "pendulum": {"torque balance": {("gravity", "sin(theta)", 0): -1, ("damping", "theta", 1): 1, (None, "theta", 2): -1}},
    "positioning_axis": {"force balance": {("Gamma1", "1", 0): 1, ("Gamma2", "q", 1): 1, ("Gamma3", "sgn(der(q))", 0): 1,
                                           ("Gamma4", "force", 0): -1, (None, "q", 2): -1}},
    "magnetic_bearing": {"force balance z": {("Gamma1", "q1/(gap + Z)^2", 0): 1, ("Gamma2", "q2/(gap + s*Y - c*Z)^2", 0): Fraction(-1, 2),
                                             ("Gamma3", "q3/(gap - s*Y - c*Z)^2", 0): Fraction(-1, 2), (None, "Z", 2): -1}},
    "pmsm_electrical": {"d axis": {("Gamma1", "v_d", 0): -1, ("Gamma2", "i_d", 0): 1, (None, "i_d", 1): -1, (None, "omega*i_q", 0): 50},
                        "q axis": {("Gamma1", "v_q", 0): -1, ("Gamma2", "i_q", 0): 1, ("Gamma3", "omega", 0): 1, (None, "i_q", 1): -1,
                                   (None, "omega*i_d", 0): -50}},
}


class Model:
    """What a model file says about windows and holds, read without algest."""

    def __init__(self, text):
        file = tomllib.loads(text, parse_float=Fraction)
        self.name = file["name"]
        self.window = Fraction(file["sampling"]["window"])
        intervals = self.window / Fraction(file["sampling"]["period"])
        assert intervals.denominator == 1
        self.intervals = intervals.numerator
        self.holds = {name: entry.get("hold", "linear") for name, entry in file["signals"].items()}
        self.quadrature = file.get("estimator", {}).get("quadrature", "exact")

    def kind(self, signal):
        """zoh if all that the signal is made of is held; the constant 1 and what contains a derivative are not."""
        made_of = [self.holds[word] for word in re.findall(r"[A-Za-z_]\w*", signal) if word in self.holds]
        if made_of and set(made_of) == {"zoh"} and "der(" not in signal:
            return "zoh"
        return "linear" if self.quadrature == "exact" else self.quadrature


class Tables:
    """NAME_tables.hpp as a compiler and a reader of its comments see it."""

    def __init__(self, text):
        found = re.search(r"constexpr (double|float) weights\[(\d+)\] = \{\n(.*?)\n\};", text, re.S)
        self.scalar, count, body = found[1], int(found[2]), found[3]
        self.tables = []       # (name, kernel as in the comment, literals)
        for line in body.splitlines():
            if not line.strip():
                continue
            head = re.fullmatch(r"\s*// table (\d+): (\w+); kernel (.*) in sigma, lowest power first", line)
            if head:
                assert int(head[1]) == len(self.tables)
                self.tables.append((head[2], [Fraction(c) for c in head[3].split()], []))
            else:
                self.tables[-1][2].extend(re.findall(r"[^\s,]+", line))
        assert count == sum(len(literals) for _, _, literals in self.tables)
        self.functionals = []  # (table or None, first term, terms, text)
        body = re.search(r"Functional functionals\[\d+\] = \{\n(.*?)\n\};", text, re.S)[1]
        for table, first, terms, comment in re.findall(r"\{ (\w+), \d+, (\d+), (\d+) \},\s*// (.*)", body):
            self.functionals.append((None if table == "no_table" else int(table), int(first), int(terms), comment))
        body = re.search(r"terms\[\d+\] = \{\n(.*?)\n\};", text, re.S)[1]
        self.terms = [(int(row), int(column), self.number(literal))
                      for row, column, literal in re.findall(r"\{ (\d+), (\d+), (\S+) \},", body)]
        assert len(self.terms) == sum(terms for _, _, terms, _ in self.functionals) == len(re.findall(r"\{", body))

    def number(self, literal):
        suffix = "f" if self.scalar == "float" else ""
        match = re.fullmatch(r"(-?0x[01](?:\.[0-9a-f]+)?p[+-]\d+)" + suffix, literal)
        assert match, literal
        return float.fromhex(match[1])


class Weights(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def algest(self, *words):
        result = subprocess.run([str(word) for word in (ALGEST, *words)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, f"{words}\n{result.stdout}{result.stderr}")
        return result.stdout

    def check_model(self, text, scalars=("double", "float"), chosen=None):
        """Tables for each scalar, and the derivation. `chosen`: of these samples only. How many weights were denormal."""
        model = Model(text)
        (self.folder / "model.toml").write_text(text)
        derived = json.loads(self.algest("derive", "model.toml", "--format", "json", "--weights"))
        self.check_derivation(model, derived, chosen)
        denormal = dict.fromkeys(scalars, 0)
        for scalar in scalars:
            self.algest("generate", "model.toml", "-o", "out", "--scalar", scalar)
            tables = Tables((self.folder / "out" / model.name / f"{model.name}_tables.hpp").read_text())
            self.assertEqual(tables.scalar, scalar)
            denormal[scalar] = self.check_tables(model, tables, chosen)
            self.check_terms(model, tables, derived)
        return denormal

    def check_tables(self, model, tables, chosen):
        denormal = 0
        for name, kernel, literals in tables.tables:
            n, kappa, i, p, kind = re.fullmatch(r"n(\d+)_kappa(\d+)_F_(\d+)_(\d+)_(\w+)", name).groups()
            n, kappa, i, p = int(n), int(kappa), int(i), int(p)
            self.assertEqual(kernel, polynomial(definition(n, kappa, i, p)), name)
            self.assertEqual(len(literals), model.intervals + 1, name)
            numerators, denominator = weights(n, kappa, i, p, model.intervals, kind, chosen)
            for m, numerator in zip(range(model.intervals + 1) if chosen is None else chosen, numerators):
                found, wanted = tables.number(literals[m]), NEAREST[tables.scalar](numerator, denominator)
                if bits(found) != bits(wanted):
                    self.fail(f"{model.name}, {tables.scalar}, {name}, weight {m}: {literals[m]} instead of {wanted.hex()}")
                denormal += 0 < abs(wanted) < LEAST_NORMAL[tables.scalar]
        return denormal

    def coefficient(self, model, equation, row, term):
        """What the kernel of a term is a multiple of the functional's own by; its name is what it says it is."""
        own = polynomial(definition(equation["n"], equation["kappa"], term["derivative"], row["p"]))
        given = [Fraction(c) for c in term["kernel"]]
        factor = given[-1] / own[-1]
        self.assertEqual(given, [factor * c for c in own], f"{model.name}: {term['signal']}, {term['derivative']}")
        return factor

    def check_derivation(self, model, derived, chosen):
        self.assertEqual(derived["name"], model.name)
        for equation in derived["equations"]:
            for row in equation["rows"]:
                factors = {}
                for term in row["terms"]:
                    factor = self.coefficient(model, equation, row, term)
                    factors[term["parameter"], term["signal"], term["derivative"]] = factor
                    self.assertEqual(len(term["weights"]), model.intervals + 1)
                    numerators, denominator = weights(equation["n"], equation["kappa"], term["derivative"], row["p"], model.intervals,
                                                      model.kind(term["signal"]), chosen)
                    above, below = factor.numerator, denominator * factor.denominator
                    for m, numerator in zip(range(model.intervals + 1) if chosen is None else chosen, numerators):
                        wanted = nearest_double(numerator * above, below)
                        if bits(float.fromhex(term["weights"][m])) != bits(wanted):
                            self.fail(f"{model.name}, row {row['p']}, {term['signal']}, weight {m}: {term['weights'][m]} "
                                      f"instead of {wanted.hex()}")
                by_hand = COEFFICIENTS.get(model.name, {}).get(equation["name"])
                if by_hand is not None:
                    self.assertEqual(set(factors), set(by_hand))
                    self.assertEqual(len({factors[key] / Fraction(by_hand[key]) for key in factors}), 1, f"{model.name}: {factors}")

    def check_terms(self, model, tables, derived):
        """The factor of each term is c T^-derivative times a power of two (and the integral of the kernel, for the constant 1),
        rounded once; all terms of a row have the same power of two."""
        rows = [(equation, row) for equation in derived["equations"] for row in equation["rows"]]
        columns = [u["name"] for u in derived["unknowns"]] + [None]
        scales, seen = {}, 0
        for table, first, count, comment in tables.functionals:
            if table is None:
                self.assertEqual(comment, "of the constant 1")
                signal = "1"
            else:
                name, signal = comment.split(" of ", 1)
                self.assertEqual(name, tables.tables[table][0])
            for row, column, factor in tables.terms[first:first + count]:
                equation, json_row = rows[row]
                if table is None:
                    derivatives = {0}
                else:
                    n, kappa, i, p, kind = re.fullmatch(r"n(\d+)_kappa(\d+)_F_(\d+)_(\d+)_(\w+)", name).groups()
                    self.assertEqual((int(n), int(kappa), int(p), kind),
                                     (equation["n"], equation["kappa"], json_row["p"], model.kind(signal)))
                    derivatives = {int(i)}
                term, = [t for t in json_row["terms"]
                         if (t["parameter"], t["signal"]) == (columns[column], signal) and t["derivative"] in derivatives]
                exact = self.coefficient(model, equation, json_row, term) / model.window ** term["derivative"]
                if table is None:
                    numerators, denominator = weights(equation["n"], equation["kappa"], 0, json_row["p"], model.intervals, model.kind("1"))
                    exact *= Fraction(sum(numerators), denominator)
                scale = Fraction(2) ** round(math.log2(Fraction(factor) / exact))
                wanted = exact * scale
                self.assertEqual(bits(factor), bits(NEAREST[tables.scalar](wanted.numerator, wanted.denominator)), comment)
                scales.setdefault(row, set()).add(scale)
                seen += 1
        self.assertEqual(seen, sum(len(row["terms"]) for _, row in rows))
        for row, found in scales.items():
            self.assertEqual(len(found), 1, f"row {row}")

    def test_the_definition_itself(self):
        """Nothing of algest: the weights that the others are compared with have the moments that they must have."""
        for n, kappa, i, p, intervals in [(1, 0, 0, 1, 2), (2, 1, 2, 3, 7), (3, 0, 1, 2, 8), (5, 2, 4, 6, 3)]:
            terms = definition(n, kappa, i, p)
            for kind in ("zoh", "linear"):
                numerators, denominator = weights(n, kappa, i, p, intervals, kind)
                self.assertEqual(Fraction(sum(numerators), denominator), moment(terms, 0))       # both hold a constant exactly
            ramp = sum(m * Fraction(w, denominator) for m, w in enumerate(numerators)) / intervals   # linear, this too
            self.assertEqual(ramp, moment(terms, 1))
            # The same integral by Newton-Cotes with as many nodes as the degree needs, from values of the kernel alone.
            degree = len(polynomial(terms)) + 1
            nodes = [Fraction(k, degree) for k in range(degree + 1)]
            for m in range(intervals):
                area = Fraction(0)
                for k, node in enumerate(nodes):
                    cardinal = [Fraction(1)]
                    for other in (x for x in nodes if x != node):
                        cardinal = [(a - other * b) / (node - other) for a, b in zip([Fraction(0)] + cardinal, cardinal + [Fraction(0)])]
                    area += value(terms, (m + node) / intervals) * sum(c / (q + 1) for q, c in enumerate(cardinal)) / intervals
                numerators, denominator = weights(n, kappa, i, p, intervals, "zoh")
                self.assertEqual(Fraction(numerators[m], denominator), area)

    def test_the_models(self):
        self.assertGreaterEqual(len(MODELS), 6)
        for path in MODELS:
            with self.subTest(path.name):
                self.check_model(path.read_text())

    def test_orders_holds_and_quadratures(self):
        shapes = [(2, "exact"), (3, "exact"), (7, "trapezoid"), (8, "simpson"), (2, "simpson"), (51, "exact"), (30, "simpson"), (2, "trapezoid")]
        count = 0
        for n in range(1, 6):
            for kappa in range(3):
                for holds in (("linear", "zoh"), ("zoh", "linear"), ("linear", "linear")):
                    intervals, quadrature = shapes[count % len(shapes)]
                    m = n if count % 2 == 0 else 0
                    count += 1
                    names = [f"a{i}" for i in range(n)] + [f"b{i}" for i in range(m + 1)]
                    with self.subTest(n=n, kappa=kappa, m=m, holds=holds, intervals=intervals, quadrature=quadrature):
                        self.check_model(
                            f'format = 1\nname = "shape"\n[sampling]\nperiod = "3/70"\nwindow = "{Fraction(3, 70) * intervals}"\n'
                            f'[signals]\ny = {{ hold = "{holds[0]}" }}\nu = {{ hold = "{holds[1]}" }}\n'
                            f'[transfer]\nn = {n}\nm = {m}\nkappa = {kappa}\nunknowns = {json.dumps(names)}\n'
                            f'[estimator]\nquadrature = "{quadrature}"\n')
        self.assertEqual(count, 45)

    def one_parameter(self, n, kappa, p, period, intervals, hold="linear"):
        return (f'format = 1\nname = "steep"\n[sampling]\nperiod = "{period}"\nwindow = "{period * intervals}"\n[signals]\ny = {{ hold = "{hold}" }}\n'
                f'[parameters]\na = {{}}\n[[equation]]\nname = "steep"\node = "der(y,{n}) = a*y"\nkappa = {kappa}\nrows = [{p}]\n')

    def test_denormal_floats(self):
        # Towards the newest sample F_0 falls as (1-sigma)^(n+p-1)/(n+p-1)!: through the denormals (2^-149 to 2^-126) down to 0,
        # for an exponent of 24 over a good part of the window.
        for n, kappa, p, hold in [(5, 2, 20, "linear"), (3, 0, 22, "zoh")]:
            denormal = self.check_model(self.one_parameter(n, kappa, p, Fraction(1, 1000), 2000, hold))
            self.assertGreater(denormal["float"], 100)

    def test_denormal_doubles(self):
        # The steepest kernel that a model may ask for; its ends and some of the middle, since degree 71 takes Python its time.
        # Only the newest few are below 2^-1022.
        intervals = 60000
        chosen = tuple(range(40)) + tuple(range(1000, intervals, 4001)) + tuple(range(intervals - 200, intervals + 1))
        denormal = self.check_model(self.one_parameter(12, 8, 40, Fraction(1, 1000), intervals), chosen=chosen)
        self.assertGreater(denormal["double"], 0)


if __name__ == "__main__":
    unittest.main()
