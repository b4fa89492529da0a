# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a closed-loop example as a user would, and reads what it prints, writes and draws."""
import csv
import re
import subprocess
from pathlib import Path

from environment import BUILD, SOURCE, run
from figures import faults, page_of, screenshot

# Texts of the figures that are neither a number nor the label of an axis.
LEGENDS = {"estimate", "truth", "measured", "shaft", "reference", "estimator is fed", "controller is retuned", "i1", "i2", "i3", "λ1", "λ2", "λ3",
           "poles of the machine", "poles found", "zeros found", "machine", "model", "N1", "N2", "open loop", "PI alone", "with notches", "wanted"}


def program(name):
    return BUILD / "examples" / name / f"{name}_example"


class Run:
    """One run of an example. `text`: what it printed; `rows`: {first column: the other columns} of its tables, numbers as numbers."""

    def __init__(self, name, folder, *options):
        self.name = name
        self.csv = Path(folder) / "run.csv"
        self.text = run(program(name), self.csv, *options)
        lines = [re.split(r"\s{2,}", line.strip()) for line in self.text.splitlines()]
        self.rows = {line[0]: [number(word) for word in line[1:]] for line in lines if len(line) > 1}
        retuned = re.search(r"fed from (\S+) s, controller retuned from (\S+) s on", self.text)
        self.fed, self.retuned = map(float, retuned.groups()) if retuned else (None, None)

    def errors(self, parameter):
        """Relative errors of a parameter at all instants with status `ok`."""
        with self.csv.open(newline="", encoding="utf-8") as file:
            ok = [row for row in csv.DictReader(file) if row["status"] == "ok"]
        return [abs(float(row[parameter]) / float(row[f"true {parameter}"]) - 1.0) for row in ok]


def table_of_the_page(name, page="closed-loop.md"):
    """What a page of docs/ shows as printed by an example."""
    page = (SOURCE / "docs" / page).read_text(encoding="utf-8")
    return re.search(rf"```text {name}\n(.*?)```", page, flags=re.DOTALL)[1]


def number(word):
    try:
        return float(word.removesuffix(" %"))
    except ValueError:
        return word


def check_figures(test, run_of, panels):
    """Draws the figures, checks that they are legible, leaves a picture. panels: {file name: number of panels}."""
    folder = run_of.csv.parent
    run("gnuplot", "-e", f"run='{run_of.csv}'; folder='{folder}'", SOURCE / "examples" / run_of.name / "figures.gnuplot")
    test.assertEqual({file.name for file in folder.glob("*.svg")}, set(panels))
    page = page_of({folder / name: count for name, count in panels.items()}, folder / "page.html")
    test.assertEqual(faults(page, LEGENDS), [])
    pictures = BUILD / "tests" / "examples"
    pictures.mkdir(parents=True, exist_ok=True)
    screenshot(page, pictures / f"{run_of.name}.png")


def check_manners(test, name, folder):
    """The same bytes every time; what cannot be written is said, and leaves nothing behind."""
    once, again = Path(folder) / "once.csv", Path(folder) / "again.csv"
    test.assertEqual(run(program(name), once), run(program(name), again))
    test.assertEqual(once.read_bytes(), again.read_bytes())
    for words in ([], [Path(folder) / "nowhere" / "run.csv"], [folder], [once, "sideways"]):
        before = sorted(Path(folder).iterdir())
        done = subprocess.run([str(program(name)), *map(str, words)], text=True, capture_output=True)
        test.assertEqual(done.returncode, 2, words)
        test.assertRegex(done.stderr, "^(usage: |.*cannot write )")
        test.assertEqual(sorted(Path(folder).iterdir()), before)
