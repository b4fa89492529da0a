# SPDX-License-Identifier: GPL-3.0-or-later
"""--report of replay and simulate, opened in a browser: nothing overlaps or is cut, every axis has its unit, nothing comes from elsewhere."""
import html
import math
import os
import re
import unittest

from command_line import RL_CIRCUIT, CommandLine, coil_rows, csv
from environment import BUILD
from figures import faults, measured, screenshot
from pages import formulas, page_faults, words_of

PICTURES = BUILD / "tests" / "report"
# Texts of a figure that are neither a number nor the label of an axis.
PLAIN = {"free run", "detail: the tinted part, where simulated is off most"}
NOISY = RL_CIRCUIT.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 1e-3 }')
# A coil behind a filter that nothing measures.
HIDDEN = RL_CIRCUIT.replace('i = { unit = "A" }', 'i = { unit = "A" }\nv = { unit = "V" }').replace(
    "[parameters]", '[constants]\nT = { value = 0.01, unit = "s" }\n\n[parameters]').replace(
    'ode = "L*der(i) = u - R*i"', 'ode = "L*der(i) = v - R*i"\n\n[[equation]]\nname = "filter"\node = "T*der(v) = u - v"')
HEADINGS = {"replay": ["Estimates", "Doubts", "Estimates over time", "Status and condition", "Measured and simulated", "Model and derivation", "Command"],
            "simulate": ["Measured and simulated", "Parameters", "Model", "Command"]}


def headings(text):
    return re.findall(r"<h2>(.*?)</h2>", text)


class Reports(CommandLine):
    def setUp(self):
        super().setUp()
        PICTURES.mkdir(parents=True, exist_ok=True)
        self.write("noisy.toml", NOISY)
        # 1 s, no voltage and no current in the middle: singular there; one current beyond any limit: rejected
        rows = [(t, u, i) if k < 400 or k >= 600 else (t, 0.0, 0.0) for k, (t, u, i) in enumerate(coil_rows(1000))]
        self.write("limited.toml", NOISY.replace("noise = 1e-3", "noise = 1e-3, max = 100"))
        rows[800] = (rows[800][0], rows[800][1], 1000.0)
        self.write("holes.csv", csv(rows))

    def page(self, *words, **options):
        """The page that a command writes, and what was said."""
        _, said = self.algest(*words, "--report", "page.html", **options)
        return self.folder / "page.html", said

    def check_page(self, command, page, figures):
        text = page.read_text(encoding="utf-8")
        self.assertEqual(page_faults(text), [])
        self.assertEqual(headings(text), HEADINGS[command])
        self.assertEqual(len(measured(page)["figures"]), figures)
        for width in (1100, 500):
            self.assertEqual(faults(page, PLAIN, width), [])
        screenshot(page, PICTURES / f"{command}.png")
        return text

    def test_a_long_command_is_not_cut(self):
        folder = self.folder / ("a_folder_of_some_depth/" * 5)
        folder.mkdir(parents=True)
        for command in ("replay", "simulate"):
            self.algest(command, "rl.toml", "coil.csv", "-o", folder / "values.csv", "--report", folder / "page.html")
            for width in (1100, 500):
                self.assertEqual(faults(folder / "page.html", PLAIN, width), [])

    def test_the_poles_of_a_discrete_model(self):
        self.write("poles.toml", """format = 1
name = "poles"
[sampling]
period = 0.01
window = 1.2
[signals]
u = { unit = "V", hold = "zoh" }
y = { unit = "rad/s" }
[discrete]
domain = "q"
n = 2
skip = 3
extra = 6
[estimator]
functional = "discrete"
""")
        # Poles at -4 and -15 rad/s, gain 3; steps of 1 V, superposed.
        def step(t):
            return 0.0 if t < 0 else 3 * (1 - (15 * math.exp(-4 * t) - 4 * math.exp(-15 * t)) / 11)
        rows = ["t [s],u [V],y [rad/s]"]
        for k in range(300):
            t = k / 100
            rows.append(f"{t:.2f},{1 if k % 80 < 40 else -1},{step(t) + 2 * sum((-1) ** j * step(t - 0.4 * j) for j in range(1, 8))!r}")
        self.write("poles.csv", "\n".join(rows) + "\n")
        page, _ = self.page("replay", "poles.toml", "poles.csv")
        text = page.read_text(encoding="utf-8")
        self.assertEqual(page_faults(text), [])
        table = re.search(r'<table id="poles">.*?</table>', text, re.S)[0]
        self.assertIn("pole, real part [rad/s]", table)
        found = re.findall(r'<tr><td class="n">([^<]*)</td><td class="n">([^<]*)</td>', table)
        self.assertEqual([round(float(real.replace("\u2212", "-")), 3) for real, _ in found], [-4.0, -15.0])
        for width in (1100, 500):
            self.assertEqual(faults(page, PLAIN, width), [])
        self.algest("replay", "rl.toml", "coil.csv", "--report", "none.html")
        self.assertNotIn('id="poles"', (self.folder / "none.html").read_text(encoding="utf-8"))

    def test_replay(self):
        page, said = self.page("replay", "limited.toml", "holes.csv")
        self.assertIn("wrote page.html", said)
        text = self.check_page("replay", page, 4)    # R, L, condition, i
        value = self.algest_json("replay", "limited.toml", "holes.csv")
        for status in ("filling", "ok", "singular", "rejected"):
            count = value["status"][status]
            self.assertGreater(count, 0, status)
            self.assertRegex(text, rf'<td>{status}</td><td class="n">{count}</td>')
        last, sd = value["parameters"][0]["last"], value["parameters"][0]["sd"]
        found = re.search(r"<td>R</td><td class=\"n\">([\d.]+)&nbsp;&plusmn;&nbsp;([\d.]+)</td>.*<td>ohm</td>", text)
        self.assertAlmostEqual(float(found[1]), last, delta=0.6 * float(found[2]))    # rounded to a digit or two of sd
        self.assertAlmostEqual(float(found[2]) / sd, 1, delta=0.05)                  # two digits: 0.5/10
        self.assertIn("<pre>algest replay limited.toml holes.csv --report page.html</pre>", text)

    def doubts(self, page):
        return page.read_text(encoding="utf-8").split("<h2>Doubts</h2>")[1].split("</section>")[0]

    def test_what_is_said_is_on_the_page(self):
        """Every note of the JSON is a doubt of the page; where nothing is said it says that."""
        self.write("tight.toml", NOISY.replace('unit = "ohm", initial = 1', 'unit = "ohm", initial = 1, max = 1.5'))   # it has 2
        notes = self.algest_json("replay", "tight.toml", "coil.csv")["notes"]
        self.assertTrue(any("beyond its min or max" in n for n in notes), notes)
        page, said = self.page("replay", "tight.toml", "coil.csv")
        self.assertEqual([html.unescape(d) for d in re.findall(r"<li>(.*)</li>", self.doubts(page))], notes)
        page, _ = self.page("replay", "noisy.toml", "coil.csv")
        self.assertIn("None was noted.", self.doubts(page))
        self.write("idle.csv", csv([(k / 1000, 0.0, 0.0) for k in range(200)]))
        page, _ = self.page("replay", "noisy.toml", "idle.csv")
        self.assertIn("algest design noisy.toml idle.csv", self.doubts(page))

    def test_simulate(self):
        self.write("hidden.toml", HIDDEN)
        page, _ = self.page("simulate", "hidden.toml", "coil.csv", "--set", "R=2", "--set", "L=0.05")
        text = self.check_page("simulate", page, 2)
        value = self.algest_json("simulate", "hidden.toml", "coil.csv", "--set", "R=2", "--set", "L=0.05")
        error = value["outputs"][0]
        found = re.search(r'<td>i</td><td class="n">([\d.]+)</td><td class="n">-</td><td>A</td><td class="n">([\d.]+)</td>', text)
        self.assertAlmostEqual(float(found[1]) / error["rmse"], 1, delta=0.005)    # three digits
        self.assertAlmostEqual(float(found[2]) / error["nrmse"], 1, delta=0.005)
        self.assertIn("Nothing measures this signal.", text)
        self.assertIn("<td>R</td><td class=\"n\">2</td><td>ohm</td><td>the command line</td>", text)
        self.assertIn("<td>u</td><td>V</td><td>replayed, linear between samples</td>", text)

    def test_a_run_that_diverges_still_makes_its_page(self):
        self.write("wild.toml", RL_CIRCUIT.replace("u - R*i", "u + 1000*R*i"))
        page, _ = self.page("simulate", "wild.toml", "coil.csv", exit_code=1)
        self.assertIn("The free run diverges after", page.read_text(encoding="utf-8"))

    def test_the_mathematics_is_that_of_derive(self):
        page, _ = self.page("replay", "rl.toml", "coil.csv")
        said = [words_of(f) for f in formulas(page.read_text(encoding="utf-8"))]
        self.assertEqual(said[0], "Li\u2032=v\u2212Ri".replace("v", "u"))
        self.assertIn("\u03931=1L\u03932=RLR=\u03932\u03931L=1\u03931", said)              # the fractions 1/L, R/L, Gamma2/Gamma1, 1/Gamma1
        # 000: the kernel of F_0 at n = 1, p = 1 is s (s - 1), that of F_1 its derivative with the other sign
        kernels = said[-1]
        self.assertIn("k0,1(\u03c3)=\u03c32\u2212\u03c3", kernels)
        self.assertIn("k1,1(\u03c3)=\u22122\u03c3+1", kernels)

    def test_the_same_arguments_give_the_same_bytes(self):
        for command in ("replay", "simulate"):
            page, _ = self.page(command, "rl.toml", "coil.csv")
            kept = page.read_bytes()
            self.assertEqual(self.page(command, "rl.toml", "coil.csv")[0].read_bytes(), kept)
            self.assertNotIn(str(self.folder).encode(), kept)

    def test_without_gnuplot_the_page_says_so(self):
        for command in ("replay", "simulate"):
            page, said = self.page(command, "rl.toml", "coil.csv", env={**os.environ, "PATH": "/nowhere"})
            self.assertIn("gnuplot: warning: is not installed: the report has no figures", said)
            text = page.read_text(encoding="utf-8")
            self.assertIn('id="no-figures"', text)
            self.assertNotIn("<svg", text)
            self.assertEqual(headings(text), HEADINGS[command])

    def test_where_nothing_is_estimated_or_simulated_the_page_says_why(self):
        self.write("idle.csv", csv([(k / 1000, 0.0, 0.0) for k in range(200)]))
        page, _ = self.page("replay", "rl.toml", "idle.csv")
        text = page.read_text(encoding="utf-8")
        self.assertEqual(page_faults(text), [])
        self.assertIn("Nothing was estimated", text)
        self.assertIn("No free run: no sample has status ok.", text)

    def test_a_page_does_not_take_the_place_of_what_is_read(self):
        for command in ("replay", "simulate"):
            self.algest(command, "rl.toml", "coil.csv", "--report", "coil.csv", exit_code=2)
            self.algest(command, "rl.toml", "coil.csv", "-o", "x", "--report", "x", exit_code=2)


if __name__ == "__main__":
    unittest.main()
