# SPDX-License-Identifier: GPL-3.0-or-later
"""report.html of discover, opened in a browser: nothing overlaps or is cut, every axis has its unit, nothing comes from elsewhere."""
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, BUILD
from figures import faults, measured, screenshot
from hidden_motor import MODEL, recording
from pages import page_faults

PICTURES = BUILD / "tests" / "report"
HEADINGS = ["Doubts", "Error on the test stretch", "Measured and simulated, test stretch", "Residual of each equation over time",
            "Residual against the signal that explains it", "Where the model was off", "Evidence", "Parameters", "Change to the model", "Next"]
# Texts of a figure that are neither a number nor the label of an axis.
PLAIN = {"test stretch", "detail: the tinted part, where before is off most", "train", "test", "before", "after", "without the added terms, and their law"}


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        PICTURES.mkdir(parents=True, exist_ok=True)
        (cls.folder / "motor.toml").write_text(MODEL)
        for name, friction in (("friction", 0.01), ("nothing", 0.0)):
            (cls.folder / f"{name}.csv").write_text(recording(friction, 7))
        cls.page = cls.discover("friction")
        cls.nothing = cls.discover("nothing")

    @classmethod
    def discover(cls, name, to=None, **options):
        done = subprocess.run([ALGEST, "discover", "motor.toml", f"{name}.csv", "-o", to or name, "--json"], cwd=cls.folder,
                              text=True, capture_output=True, **options)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        cls.said = done.stderr
        return cls.folder / json.loads(done.stdout)["report"]

    def picture(self, page, name):
        for width, look in ((1100, ""), (1100, "dark"), (500, "narrow")):
            screenshot(page, PICTURES / f"{name}{'-' + look if look else ''}.png", width,
                       *(["--blink-settings=preferredColorScheme=0"] if look == "dark" else []))

    def test_figures_are_legible(self):
        for page, figures in ((self.page, 4), (self.nothing, 2)):
            self.assertGreaterEqual(len(measured(page)["figures"]), figures)
            for width in (1100, 500):
                self.assertEqual(faults(page, PLAIN, width), [])
        self.picture(self.page, "friction")
        self.picture(self.nothing, "nothing")

    def test_a_spoilt_figure_is_noticed(self):
        text = self.page.read_text(encoding="utf-8")
        place = re.compile(r'translate\(([\d.]+),([\d.]+)\)')
        first, second = place.findall(text)[:2]
        spoilt = {
            "has no unit": text.replace("w [rad/s]</text>", "w</text>", 1),
            "lies over": text.replace("translate({},{})".format(*second), "translate({},{})".format(*first), 1),
            "is cut": text.replace("translate({},{})".format(*first), "translate(-5,{})".format(first[1]), 1),
            "panels": re.sub(r"<text>error \[[^\]]+\]</text>", "<text>0.5</text>", text, count=1),
            "px wide": text.replace("<h2>Next</h2>", '<h2 style="width: 1500px">Next</h2>'),
        }
        for fault, changed in spoilt.items():
            with self.subTest(fault=fault):
                self.assertNotEqual(changed, text)
                page = self.folder / "spoilt.html"
                page.write_text(changed, encoding="utf-8")
                self.assertTrue(any(fault in f for f in faults(page, PLAIN)), faults(page, PLAIN))

    def test_the_page_stands_alone(self):
        for page in (self.page, self.nothing):
            self.assertEqual(page_faults(page.read_text(encoding="utf-8")), [])

    def test_every_section_is_there(self):
        for page, verdict in ((self.page, "named"), (self.nothing, "none")):
            text = page.read_text(encoding="utf-8")
            self.assertEqual(re.findall(r"<h2>(.*?)</h2>", text), HEADINGS)
            self.assertIn(f"Verdict: {verdict}", text)
        text = self.page.read_text(encoding="utf-8")
        self.assertRegex(text, r"<b>coulomb_friction</b> is missing in &lsquo;torque balance&rsquo;: <code>-Tc\*sgn\(w\)</code>, Tc = ")
        self.assertIn('<span class="added">', text)
        self.assertIn("patch motor.toml &lt; friction/motor.patch", text)

    def test_the_same_recording_gives_the_same_bytes(self):
        kept = self.page.read_bytes()
        self.assertEqual(self.discover("friction").read_bytes(), kept)
        self.assertNotIn(str(self.folder).encode(), kept)

    def test_without_gnuplot_the_page_says_so(self):
        page = self.discover("friction", "plain", env={**os.environ, "PATH": "/nowhere"})
        self.assertIn("gnuplot: warning: is not installed: the report has no figures", self.said)
        self.assertEqual(self.said.count("gnuplot"), 2)   # once, and once as the package that brings it
        text = page.read_text(encoding="utf-8")
        self.assertIn('id="no-figures"', text)
        self.assertNotIn("<svg", text)
        self.assertEqual(re.findall(r"<h2>(.*?)</h2>", text), HEADINGS)


if __name__ == "__main__":
    unittest.main()
