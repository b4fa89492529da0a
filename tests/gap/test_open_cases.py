# SPDX-License-Identifier: GPL-3.0-or-later
"""The open cases of ../shared/cases whose effect is a term, is none, or is in no library: verdicts, names, gaps, parameters."""
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, SHARED, skip

CASES = SHARED / "cases"
if not CASES.is_dir():
    skip("no ../shared/cases")

WANTED = ["o01_dc", "o02_dc", "o03_dc", "o04_dc", "o05_pm", "o07_pm", "o08_mb", "o09_mb", "o11_tm", "o12_ms", "o14_hp", "o15_dc",
          "o16_dc", "o17_ms", "o18_dc", "o19_pm"]
ALIASES = {e["name"]: {e["name"], *e["aliases"]} for e in json.loads((CASES / "effects.json").read_text())["effects"]}


def accepted(answer):
    """For each effect the names that count for it, with their aliases."""
    return [set().union(*(ALIASES.get(name, {name}) for name in names)) for names in answer["accepted_names"]]


def names_match(found, wanted):
    rest = list(found)
    for choices in wanted:
        hit = next((name for name in rest if name in choices), None)
        if hit is None:
            return False
        rest.remove(hit)
    return not rest


def equations_match(found, answer):
    """Every equation of an effect carries the name of its signal, as `torque balance of w` carries w; o08 and o09 call x' v."""
    for effect, truth in zip(sorted(found["effects"], key=lambda e: e["name"]), sorted(answer["effects"], key=lambda e: e["name"])):
        signals = {"x" if s == "v" and "force balance of x" in effect["equation"] else s for s in truth["equation"].split(",")}
        if {e.split(" of ")[-1] for e in effect["equation"].split(", ")} != signals:
            return False
    return True


class OpenCases(unittest.TestCase):
    def discover(self, case, answer):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([ALGEST, "discover", CASES / case / "model.toml", CASES / case / "measured.csv", "-o", folder, "--json",
                                   "--train", "{}:{}".format(*answer["train_s"]), "--test", "{}:{}".format(*answer["test_s"])],
                                  text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, case + done.stderr)
            found = json.loads(done.stdout)
            self.assertTrue((Path(folder) / "before.csv").exists() and (Path(folder) / "after.csv").exists())
            if found["model"]:
                check = subprocess.run([ALGEST, "check", found["model"]], text=True, capture_output=True)
                self.assertEqual(check.returncode, 0, check.stderr)
            return found

    def test_open_cases(self):
        right = 0
        for case in WANTED:
            answer = json.loads((CASES / case / "answer.json").read_text())
            found = self.discover(case, answer)
            names = [e["name"] for e in found["effects"]]
            if found["verdict"] == "named":
                good = names_match(names, accepted(answer)) and equations_match(found, answer)
                self.assertTrue(good, f"{case}: {names} is named, and wrong")
                for output in found["outputs"]:   # the bar of the issue: 1.2; process noise (o18) has a floor of its own in the answer
                    floor = max(output["noise_floor"], answer["noise_floor_nrmse"][output["signal"]])
                    self.assertLess(output["nrmse_after"] / floor, 1.2, f"{case} {output}")
            elif found["verdict"] == "ambiguous":
                good = answer["verdict"] == "ambiguous"
            else:
                good = found["verdict"] == answer["verdict"]
            right += good
            print(f"{case}: {answer['verdict']} {[e['name'] for e in answer['effects']]} -> {found['verdict']} {names} {'right' if good else 'WRONG'}")
        print(f"{right} of {len(WANTED)} right")
        self.assertGreaterEqual(right, 14)   # the bar of the issue


if __name__ == "__main__":
    unittest.main()
