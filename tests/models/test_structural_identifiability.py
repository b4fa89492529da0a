# SPDX-License-Identifier: GPL-3.0-or-later
"""`check --identifiability`: verdicts as they were published, for models with a paper, a page or an example to name; and what it refuses."""
import json
import unittest

from environment import SOURCE
from model_case import ModelCase, complaints

HEAD = 'format = 1\nname = "m"\n'

# Where several models come from.
COMPARTMENTS = "Bellman, Astrom 1970, Math. Biosci. 7:329; Cobelli, DiStefano 1980, Am. J. Physiol. 239:R7, two compartments"
CONSTRAINED = "Cobelli, Lepschy, Romanin Jacur 1979, Math. Biosci. 44:1, almost closed mammillary and catenary systems"
DONG = "Dong, Goodbrake, Harrington, Pogudin 2023, SIAM J. Appl. Algebra Geom. 7:194; the verdicts in their StructuralIdentifiability.jl, test/identifiability.jl"


def model(signals, parameters, equations):
    """Signals and parameters by their names, equations as "ode" or as "ode | kappa"."""
    text = HEAD + "[signals]\n" + "".join(f"{s} = {{}}\n" for s in signals.split()) + "[parameters]\n" + "".join(f"{p} = {{ min = 0 }}\n" for p in parameters.split())
    for equation in equations:
        ode, _, kappa = equation.partition("|")
        text += f'[[equation]]\node = "{ode.strip()}"\n' + (f"kappa = {kappa.strip()}\n" if kappa else "")
    return text


# name: source, signals, parameters, equations, hidden signals, {parameter: values that fit; 0: not identifiable}, combinations that are determined
PUBLISHED = {
    "two compartments, two leaks": (COMPARTMENTS, "x1 x2 u", "k01 k02 k12 k21", ["der(x1) = -(k01 + k21)*x1 + k12*x2 + u", "der(x2) = k21*x1 - (k02 + k12)*x2"], "x2",
                                    {"k01": 0, "k02": 0, "k12": 0, "k21": 0}, ["k01 + k21", "k02 + k12", "k12*k21"]),
    "two compartments, one leak": (COMPARTMENTS, "x1 x2 u", "k01 k12 k21", ["der(x1) = -(k01 + k21)*x1 + k12*x2 + u", "der(x2) = k21*x1 - k12*x2"], "x2",
                                   {"k01": 1, "k12": 1, "k21": 1}, []),
    "mammillary, leak in the centre": (CONSTRAINED, "x1 x2 x3 u", "k01 k12 k21 k13 k31", [
        "der(x1) = -(k01 + k21 + k31)*x1 + k12*x2 + k13*x3 + u", "der(x2) = k21*x1 - k12*x2", "der(x3) = k31*x1 - k13*x3"], "x2,x3",
        {"k01": 1, "k12": 2, "k21": 2, "k13": 2, "k31": 2}, []),   # (n - 1)! solutions: the outer compartments change places
    "catenary, leak at the input": (CONSTRAINED, "x1 x2 x3 u", "k01 k12 k21 k23 k32", [
        "der(x1) = -(k01 + k21)*x1 + k12*x2 + u", "der(x2) = k21*x1 - (k12 + k32)*x2 + k23*x3", "der(x3) = k32*x2 - k23*x3"], "x2,x3",
        {"k01": 1, "k12": 1, "k21": 1, "k23": 1, "k32": 1}, []),
    "flip-flop absorption": ("Bateman's function; Garrett 1994, J. Pharmacokinet. Biopharm. 22:103: absorption and elimination may change places, with another volume", "x1 x2 y u", "ka ke V", [
        "der(x1) = -ka*x1 + u", "der(x2) = ka*x1 - ke*x2", "y = x2/V"], "x1,x2", {"ka": 2, "ke": 2, "V": 2}, []),
    "products of states": ("Lecourtier, Lamnabhi-Lagarrigue, Walter 1987, CDC, p. 2144; as in the docs of StructuralIdentifiability.jl: p1 + p3, p1*p3 and p2*p4 are identifiable",
                           "x1 x2 x3 u", "p1 p2 p3 p4", ["der(x1) = -p1*x1 + p2*u", "der(x2) = -p3*x2 + p4*u", "der(x3) = -(p1 + p3)*x3 + (p4*x1 + p2*x2)*u"], "x1,x2",
                           {"p1": 2, "p2": 0, "p3": 2, "p4": 0}, ["p2*p4"]),
    "square of a hidden state": ("Ljung, Glad 1994, Automatica 30:265: the input makes theta globally identifiable", "x1 x2 u", "theta", [
        "der(x1) = theta*x2^2", "der(x2) = u"], "x2", {"theta": 1}, []),
    "HIV, viral load alone": ("Wu, Zhu, Miao, Perelson 2008, Bull. Math. Biol. 70:785, abstract: four parameters and the product of N and lambda", "T I V", "lambda rho k delta N c", [
        "der(T) = lambda - rho*T - k*V*T", "der(I) = k*V*T - delta*I", "der(V) = N*delta*I - c*V"], "T,I",
        {"lambda": 0, "rho": 1, "k": 1, "delta": 2, "N": 0, "c": 2}, ["lambda*N"]),
    "two compartments and a source": ("the same package, README: a01 + a12 and a01*a12 are identifiable", "x1 x2 x3 u", "a01 a21 a12 b", [
        "der(x1) = -(a01 + a21)*x1 + a12*x2 + u", "der(x2) = a21*x1 - a12*x2 - x3/b", "der(x3) = x3"], "x1,x3", {"a01": 2, "a21": 1, "a12": 2, "b": 0}, []),
    "two compartments without input": (DONG, "x0 x1", "a01 a21 a12", ["der(x0) = -(a01 + a21)*x0 + a12*x1", "der(x1) = a21*x0 - a12*x1"], "x1",
                                       {"a01": 0, "a21": 0, "a12": 0}, ["a01*a12", "a01 + a21 + a12"]),
    "prey of a predator": (DONG, "x0 x1 u", "a b c d", ["der(x0) = a*x0 - b*x0*x1 + u", "der(x1) = c*x1 + d*x0*x1"], "x1", {"a": 1, "b": 0, "c": 1, "d": 1}, []),
    "cholera": (DONG + "; Eisenberg, Robertson, Tien 2013, J. Theor. Biol. 324:84", "S I W R y", "mu bi bw a xi gam k", [
        "der(S) = mu - bi*S*I - bw*S*W - mu*S + a*R", "der(I) = bw*S*W + bi*S*I - (gam + mu)*I", "der(W) = xi*(I - W)", "der(R) = gam*I - (mu + a)*R", "y = k*I"], "S,I,W,R",
        {"mu": 1, "bi": 1, "bw": 1, "a": 1, "xi": 1, "gam": 1, "k": 1}, []),
    "Goodwin's oscillator": (DONG, "x1 x2 x3 x4", "b c alpha beta gama delta sigma", [
        "der(x1) = -b*x1 + 1/(c + x4)", "der(x2) = alpha*x1 - beta*x2", "der(x3) = gama*x2 - delta*x3", "der(x4) = sigma*x4*(gama*x2 - delta*x3)/x3"], "x2,x3,x4",
        {"b": 1, "c": 1, "alpha": 0, "beta": 2, "gama": 0, "delta": 2, "sigma": 1}, []),
    "cascade without input": (DONG, "x1 x2", "a1 a2 a21", ["der(x1) = -a1*x1 + a21*x2", "der(x2) = -a2*x2 - a21*x2"], "x2", {"a1": 2, "a2": 0, "a21": 0}, ["a2 + a21"]),
    "cascade": (DONG, "x1 x2 u", "a1 a2 a21", ["der(x1) = -a1*x1 + a21*x2", "der(x2) = -a2*x2 - a21*x2 + u"], "x2", {"a1": 2, "a2": 2, "a21": 1}, []),
}
# Models whose number of solutions is not reached: their verdict may fall back to "locally", never to another.
OUT_OF_REACH = {"cholera", "Goodwin's oscillator"}

# The same of models that need no paper: what the answer is can be read off the equations.
OWN = {
    "RL circuit": ("i v", "R L", ["L*der(i) = v - R*i"], "", {"R": 1, "L": 1}, []),
    "motor, current and speed": ("i w v", "R L K J b", ["L*der(i) = v - R*i - K*w", "J*der(w) = K*i - b*w"], "", {"R": 1, "L": 1, "K": 1, "J": 1, "b": 1}, []),
    "motor, current alone": ("i w v", "R L K J b", ["L*der(i) = v - R*i - K*w", "J*der(w) = K*i - b*w"], "w", {"R": 1, "L": 1, "K": 0, "J": 0, "b": 0}, ["b/J", "J/K^2"]),
    "two masses, one measured": ("p q F", "m1 m2 k d", ["m1*der(p,2) = F - k*(p - q) - d*(der(p) - der(q))", "m2*der(q,2) = k*(p - q) + d*(der(p) - der(q))"], "q",
                                 {"m1": 1, "m2": 1, "k": 1, "d": 1}, []),
    "offset beside an unknown constant": ("x u", "a offset", ["der(x) = a*u + offset | 1"], "", {"a": 1, "offset": 0}, []),
    "ramp beside an unknown constant": ("x u t", "a r", ["der(x) = a*u + r*t | 1", "der(t) = 1"], "", {"a": 1, "r": 1}, []),
    "dry friction and an offset": ("q F", "M Fv Fc off", ["M*der(q,2) + Fv*der(q) + Fc*sgn(der(q)) + off = F"], "", {"M": 1, "Fv": 1, "Fc": 1, "off": 1}, []),
    "a square": ("x u", "a", ["der(x) = a^2*u"], "", {"a": 2}, []),
    "sine and cosine": ("x u", "a b", ["der(x) = a*sin(u)^2 + b*cos(u)^2 - b + a*cos(u)^2"], "", {"a": 1, "b": 1}, []),
    "a sine squared and its rest": ("x u", "a b c", ["der(x) = a*sin(u)^2 + b*cos(u)^2 + c"], "", {"a": 0, "b": 0, "c": 0}, ["a - b", "a + c"]),
    "lateness of an input": ("w u", "T g tau", ["T*der(w) = g*delay(u, tau) - w"], "", {"T": 1, "g": 1, "tau": 1}, []),
    "two latenesses of one input": ("w u", "g tau rho", ["der(w) = g*delay(u, tau) + g*delay(u, rho)"], "", {"g": 1, "tau": None, "rho": None}, []),
    "exponent": ("w u", "a n", ["der(w) = u - a*w^n"], "", {"a": None, "n": None}, []),
    "diode": ("q F i", "Is nV", ["der(q) = F - i", "i = Is*(exp(q/nV) - 1)"], "", {"Is": None, "nV": None}, []),
    "kinematics ties two terms": ("x y u", "a b c", ["der(x) = y", "der(y) = a*u - b*y - c*der(x)"], "", {"a": 1, "b": 0, "c": 0}, ["b + c"]),
    "a spare parameter": ("x u", "a spare", ["der(x) = a*u"], "", {"a": 1, "spare": 0}, []),
    "a root that is a constant": ("x u", "a b", ["der(x) = sqrt(3)/2*a*u - b*x"], "", {"a": 1, "b": 1}, []),   # 3 has no root modulo 2^31 - 1
    "roots of parameters": ("x u", "a b", ["der(x) = sqrt(a)*u - sqrt(a + b)*x"], "", {"a": None, "b": None}, []),
    "differences of levels": ("h k l", "a b c", ["der(h) = -a*sqrt(h - k)", "der(k) = a*sqrt(h - k) - b*sqrt(k - l)", "der(l) = b*sqrt(k - l) - c*sqrt(l)"], "", {"a": 1, "b": 1, "c": 1}, []),
    "a ratio and its inverse": ("x y u", "a b", ["der(x) = a/b*u", "der(y) = b/a*u"], "", {"a": 0, "b": 0}, ["b/a"]),
}


class Structural(ModelCase):
    def ask(self, signals, parameters, equations, hidden):
        self.write(model(signals, parameters, equations).encode())
        words = ["check", "m.toml", "--identifiability", "--json"] + (["--hidden", hidden] if hidden else [])
        code, out, err, seconds = self.run_algest(*words)
        self.assertEqual(complaints(err), [], err)
        self.assertLess(seconds, 10.0)
        return code, json.loads(out)["models"][0]

    def compare(self, code, answer, values, combinations, out_of_reach=False):
        found = {p["name"]: p for p in answer["identifiability"]["parameters"]}
        self.assertEqual(set(found), set(values))
        for name, fit in values.items():
            verdict = "not" if fit == 0 else "globally" if fit == 1 else "locally"
            if out_of_reach and found[name]["values"] is None and verdict != "not":
                verdict = "locally"
                fit = None
            self.assertEqual((found[name]["verdict"], found[name]["values"]), (verdict, fit or None), name)
        self.assertEqual(code, 0 if all(fit != 0 for fit in values.values()) else 1)
        self.assertEqual(answer["ok"], code == 0)
        if not out_of_reach:
            self.assertEqual([c["name"] for c in answer["identifiability"]["combinations"]], combinations)

    def test_published_verdicts(self):
        self.assertGreaterEqual(len(set(PUBLISHED) - OUT_OF_REACH), 10)
        for name, (_, signals, parameters, equations, hidden, values, combinations) in PUBLISHED.items():
            with self.subTest(name):
                code, answer = self.ask(signals, parameters, equations, hidden)
                self.compare(code, answer, values, combinations, name in OUT_OF_REACH)

    def test_verdicts_that_the_equations_show(self):
        for name, (signals, parameters, equations, hidden, values, combinations) in OWN.items():
            with self.subTest(name):
                code, answer = self.ask(signals, parameters, equations, hidden)
                self.compare(code, answer, values, combinations)

    def test_many_square_roots(self):
        """One random number in two has a root modulo a prime: ten tanks in a row need more than luck, and the same bytes each time."""
        for tanks in (7, 10):
            names = [f"h{k}" for k in range(tanks)]
            flows = ["u"] + [f"a{k}*sqrt(h{k})" for k in range(tanks)]
            equations = [f"der(h{k}) = {flows[k]} - {flows[k + 1]}" for k in range(tanks)]
            with self.subTest(tanks=tanks):
                code, answer = self.ask("u " + " ".join(names), " ".join(f"a{k}" for k in range(tanks)), equations, "")
                self.compare(code, answer, {f"a{k}": 1 for k in range(tanks)}, [])
                answers = {self.run_algest("check", "m.toml", "--identifiability", "--json")[1] for _ in range(20)}
                self.assertEqual(len(answers), 1)

    def test_what_is_said_of_a_parameter_that_is_open(self):
        code, answer = self.ask("x1 x2 u", "k01 k02 k12 k21", PUBLISHED["two compartments, two leaks"][3], "x2")
        structure = answer["identifiability"]
        self.assertEqual((structure["measured"], structure["inputs"], structure["hidden"]), (["x1"], ["u"], ["x2"]))
        self.assertEqual(structure["parameters"][2], {"name": "k12", "verdict": "not", "values": None, "seen_in": ["k02 + k12", "k12*k21"]})
        self.assertEqual(structure["combinations"][0], {"name": "k01 + k21", "verdict": "globally", "values": 1})
        _, out, _, _ = self.run_algest("check", "m.toml", "--identifiability", "--hidden", "x2")
        self.assertIn("m.toml: not identifiable\n  measured: x1; inputs: u; hidden: x2\n", out)
        self.assertIn("seen only in k02 + k12, k12*k21", out)

    def test_seen_together_and_not_at_all(self):
        self.ask("y u", "a b spare", ["der(y) = -y + log(a*u) + b"], "")   # log(a) + b is seen, which is no quotient of polynomials
        _, out, _, _ = self.run_algest("check", "m.toml", "--identifiability")
        self.assertRegex(out, r"a +not +seen only together with others\n +b +not +seen only together with others\n +spare +not +the measured signals say nothing of it\n")

    def test_the_product_of_measurements_counts(self):
        equations = PUBLISHED["HIV, viral load alone"][3]
        code, answer = self.ask("T I V", "lambda rho k delta N c", equations, "I")   # cells measured too: only delta and c change places
        self.compare(code, answer, {"lambda": 1, "rho": 1, "k": 1, "delta": 2, "N": 2, "c": 2}, [])

    def test_what_is_refused(self):
        good = model("x z u", "a", ["der(x) = a*u", "der(z) = x"])
        for words, wanted in ((["--hidden", "v"], "is not a signal"), (["--hidden", "u"], "no equation moves it"), (["--hidden"], "--hidden"), (["--hidden", "zz"], "did you mean z?")):
            with self.subTest(words=words):
                self.write(good.encode())
                code, out, err, _ = self.run_algest("check", "m.toml", "--identifiability", *words)
                self.assertEqual((code, out), (2, ""), err)
                self.assertIn(wanted, err)
        self.assertEqual(self.run_algest("check", "m.toml", "--hidden", "x")[0], 2)   # needs --identifiability
        for equations, wanted in ((["der(x) = a*u/0"], "error"), (["der(x) = a*u/(x - x)"], "divides by zero"), (["der(x) = a*u", "x = 2*u", "x = 2*u + 1"], "says nothing about a signal"),
                                  (["der(x) = a*x^2 + a*u^2", "x^2 + u^2 = 1"], "and x stands in another equation too"), (["der(x) = a*u", "x^2 + u^2 = 1"], "the verdict is open"),
                                  (["der(x) = a*sqrt(u) + sqrt(-u)"], "no point was found"), (["der(x) = a*u", "der(z)^2 = x"], "cannot be solved"), (["(x + z + u + a)^32*der(x) = (x + z + u + 1)^32*u + z"], "more than"), (["der(x) = a*u + q"], "unknown name")):
            with self.subTest(equations=equations):
                self.write(model("x z u", "a", equations).encode())
                words = ["--hidden", "z"] if "z" in "".join(equations) else []
                code, out, err, seconds = self.run_algest("check", "m.toml", "--identifiability", *words)
                self.assertEqual((code, out), (2, ""), err)
                self.assertIn(wanted, err)
                self.assertLess(seconds, 10.0)

    def test_a_constraint_that_cannot_be_solved(self):
        """On the circle x^2 + y^2 = 1 only a - b and b + c are determined: no verdict may come from x and y as if they were free."""
        self.write(model("x y", "a b c", ["der(x) = a*x^2 + b*y^2 + c", "x^2 + y^2 = 1"]).encode())
        code, out, err, _ = self.run_algest("check", "m.toml", "--identifiability")
        self.assertEqual((code, out), (2, ""), err)
        self.assertRegex(err, r"m\.toml:\d+:\d+: error: the verdict is open: equation .* is linear in no signal that it could be solved for, and x stands in another equation too")

    def test_several_models_and_the_same_bytes_again(self):
        paths = sorted(str(path) for path in (SOURCE / "models").glob("*.toml"))
        first = self.run_algest("check", *paths, "--identifiability", "--json")
        self.assertEqual(first[0], 0, first[2])
        for answer in json.loads(first[1])["models"]:
            for p in answer["identifiability"]["parameters"]:
                expected = ("locally", 2) if p["name"] == "K" and "sensorless" in answer["model"] else ("globally", 1)   # 002 (48): K enters by its square
                self.assertEqual((p["verdict"], p["values"]), expected, (answer["model"], p))
        self.assertEqual(self.run_algest("check", *paths, "--identifiability", "--json")[1], first[1])


if __name__ == "__main__":
    unittest.main()
