# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws of hidden cases by a seed, and the confusion matrix of what discover makes of them.

Half of the draws hide nothing (noise alone, noise of the process, coloured noise). Of all draws a fifth hides what no file of the library says;
the rest hide one effect or two that it does, terms and rewrites alike.
"""
import argparse
import os
import random
import statistics
import subprocess
import tempfile
from collections import Counter, defaultdict
from pathlib import Path

import score
from environment import ALGEST, BUILD, SHARED, SOURCE

NOTHING = ("none", "none_process", "none_coloured")
OUTSIDE_SHARE = 0.2
GROUPS = ("nothing", "outside", "faint", "rivals", "clear")
CLEAR_GAP = 3.0         # of the nominal model over the floor, from which on a name is due


def seed_of_commit():
    """The first digits of the commit's hash; of a copy without history, a fixed number."""
    done = subprocess.run(["git", "-C", str(SOURCE), "rev-parse", "HEAD"], text=True, capture_output=True)
    return int(done.stdout[:12], 16) if done.returncode == 0 else 20261124


def library():
    return {path.stem for path in (SOURCE / "models" / "effects").glob("*.toml")}


def listed(kind):
    program = BUILD / "tests/gap/cases/gap_cases"
    done = subprocess.run([program, "--" + kind], text=True, capture_output=True, check=True)
    return [tuple(line.split()) for line in done.stdout.split("\n") if line]


def effects_of(hidden):
    return [part.split("@")[0] for part in hidden.split("+")]


def is_outside(hidden, held):
    """bouc_wen_hysteresis is the simulator's name of what the library's file hysteresis says."""
    return any(name not in held and name != "one_speed" and not (name == "bouc_wen_hysteresis" and "hysteresis" in held) for name in effects_of(hidden))


def draw(seed, count):
    """count cases (family, hidden, seed of the case), always the same of one seed; names first, then the place, so that no family weighs more."""
    rng = random.Random(seed)
    held = library()
    places = defaultdict(list)
    for kind in ("terms", "structural"):
        for family, hidden in listed(kind):
            names = effects_of(hidden)
            places["+".join(names) if len(names) == 1 else "pair"].append((family, hidden))
    nothing = [name for name in places if name in NOTHING]
    outside = [name for name in places if name not in NOTHING and name != "pair" and is_outside(name, held)]
    inside = [name for name in places if name not in NOTHING and name not in outside]
    wanted = [nothing] * (count // 2) + [outside] * round(OUTSIDE_SHARE * count)
    wanted += [inside] * (count - len(wanted))
    return [(*rng.choice(places[rng.choice(names)]), rng.randrange(1, 10**6)) for names in wanted]


def settings(folder, jobs):
    return argparse.Namespace(cases=BUILD / "tests/gap/cases/gap_cases", algest=ALGEST, output=Path(folder), truth=False, jobs=jobs,
                              effects=SHARED / "cases" / "effects.json")


class Matrix:
    """What was hidden against what was said."""

    def __init__(self):
        self.said = defaultdict(Counter)    # hidden -> verdict and names
        self.totals = Counter()
        self.dropped = 0
        self.seconds = []
        self.wrong = []
        self.held = library()

    def add(self, case, result):
        if result["judged"] == "no case":   # the simulator finds no strength at which this one shows
            self.dropped += 1
            return
        group = self.group(case[1], result)
        names = effects_of(case[1])
        self.said[group + ": " + ("pair" if len(names) > 1 else names[0])][result.get("verdict", "refused") + (" " + result["named"] if result.get("named") else "")] += 1
        self.totals[group] += 1
        self.totals[group, result["judged"]] += 1
        self.totals[group, result.get("verdict", "refused")] += 1
        self.seconds.append(result["seconds"])
        if result["judged"] in ("wrong", "misleading", "refused"):
            self.wrong.append((case, result))

    def group(self, hidden, result):
        if hidden in NOTHING:
            return "nothing"
        if is_outside(hidden, self.held):
            return "outside"
        if result.get("truth") != "named" or result.get("expected", 0) < CLEAR_GAP:
            return "faint"   # a gap near the noise, or one that the excitation cannot tell
        return "rivals" if result.get("allowed") else "clear"

    def share(self, group, what):
        return self.totals[group, what] / max(self.totals[group], 1)

    def false_names(self):
        return self.totals["nothing", "named"] + self.totals["nothing", "ambiguous"]

    def refused(self):
        """Runs that did not end well, whatever is hidden."""
        return sum(self.totals[group, "refused"] for group in GROUPS) // 2   # judged and said, both

    def wrong_names(self):
        """Of all draws: named, and not what is hidden."""
        return sum(self.totals[group, "wrong"] for group in GROUPS)

    def draws(self):
        return sum(self.totals[group] for group in GROUPS)

    def text(self):
        out = ["", "hidden -> said"]
        for hidden in sorted(self.said):
            out.append(f"  {hidden} ({sum(self.said[hidden].values())})")
            out += [f"      {count:3d} {said}" for said, count in self.said[hidden].most_common()]
        out.append("")
        for case, result in self.wrong:
            out.append(f"  {result['judged']}: {case[0]} {case[1]} {case[2]} -> {result.get('verdict', '')} {result.get('named', result.get('error', ''))}")
        due = self.totals["clear"] + self.totals["rivals"]
        right = sum(self.totals[group, judged] for group in ("clear", "rivals") for judged in ("right", "honest"))
        unknown = self.totals["outside", "right"]
        out += ["", f"draws: {self.draws()}, of them {self.totals['nothing']} with nothing hidden, {self.totals['outside']} outside the library; {self.dropped} more have no sound case",
                f"refused: {self.refused()}",
                f"false names where nothing is hidden: {self.false_names()} of {self.totals['nothing']}, a gap seen in {self.totals['nothing', 'unknown']}",
                f"right where the gap is above {CLEAR_GAP:g} floors: {right} of {due} ({100 * right / max(due, 1):.1f} %), "
                f"of them without a rival that the data allow {self.totals['clear', 'right']} of {self.totals['clear']}",
                f"wrong names with verdict named: {self.wrong_names()} of {self.draws()} ({100 * self.wrong_names() / max(self.draws(), 1):.1f} %)",
                f"named a term that the recording does not tell from the hidden sensor's fault or wrong constant: {sum(self.totals[group, 'equal'] for group in GROUPS)}",
                f"ambiguous where the excitation separates: {self.totals['clear', 'ambiguous']} of {self.totals['clear']} ({100 * self.share('clear', 'ambiguous'):.1f} %)",
                f"outside the library, unknown without a wrong name: {unknown} of {self.totals['outside']} ({100 * unknown / max(self.totals['outside'], 1):.1f} %)"]
        if self.seconds:
            out.append(f"seconds a case: median {statistics.median(self.seconds):.1f}, longest {max(self.seconds):.1f}")
        return "\n".join(out)


def confusion(cases, jobs=None, keep=None):
    """The matrix of these cases; a line is printed for each as it ends. keep: a folder whose cases stay."""
    matrix = Matrix()
    with tempfile.TemporaryDirectory() as scratch:
        print(score.COLUMNS.format("case", "hidden", "verdict", "named", "judged", "error", "expected", "before", "after", "s"))
        for case, result in score.results(settings(keep or scratch, jobs or os.cpu_count()), cases):
            print(score.line(case, result), flush=True)
            matrix.add(case, result)
    return matrix
