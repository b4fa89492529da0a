# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the open cases of ../shared/cases share: verdicts, names, gaps. Every third case is in test_open_cases.py, all of them in
test_open_cases_long.py, which CI runs."""
import json
import subprocess
import tempfile
from pathlib import Path

from environment import ALGEST, SHARED, skip
from gap.scoring import aliases, judge

CASES = SHARED / "cases"
if not CASES.is_dir():
    skip("no ../shared/cases")

CASES_BY_NUMBER = sorted(case.name for case in CASES.iterdir() if case.is_dir())
ALIASES = aliases(CASES / "effects.json")


class OpenCases:
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

    def right_of(self, cases):
        right = 0
        for case in cases:
            answer = json.loads((CASES / case / "answer.json").read_text())
            found = self.discover(case, answer)
            names = [e["name"] for e in found["effects"]]
            good = judge(found, answer, ALIASES) == "right"
            if found["verdict"] == "named":
                self.assertTrue(good, f"{case}: {names} is named, and wrong")
                for output in found["outputs"]:   # the bar of the issue, over the floor of the case's author
                    self.assertLess(output["nrmse_after"] / answer["noise_floor_nrmse"][output["signal"]], 1.2, f"{case} {output}")
            right += good
            print(f"{case}: {answer['verdict']} {[e['name'] for e in answer['effects']]} -> {found['verdict']} {names} {'right' if good else 'WRONG'}")
        print(f"{right} of {len(cases)} right")
        return right
