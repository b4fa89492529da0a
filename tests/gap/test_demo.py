# SPDX-License-Identifier: GPL-3.0-or-later
"""What `make demo` hides in its motor, each kind once, is what discover names; the effect file of docs/discover.md is one."""
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from discovery import discover, names, show
from environment import CXX, SOURCE, run

DEMO = SOURCE / "examples" / "demo"


class Demo(unittest.TestCase):
    def test_every_kind_is_named(self):
        with tempfile.TemporaryDirectory(prefix="algest-demo-") as name:
            folder = Path(name)
            run(CXX, "-std=c++17", "-O2", DEMO / "simulate_motor.cpp", "-o", folder / "simulate_motor")
            kinds = set()
            for seed in (1, 2, 3, 4):
                run(folder / "simulate_motor", seed, folder / "motor.csv", folder / "hidden.txt")
                hidden = (folder / "hidden.txt").read_text().strip()
                effect, equation, parameter, value = re.fullmatch(r"(\w+) in ([a-z ]+), (\w+) = (\S+) .+", hidden).groups()
                kinds.add(effect)
                found = discover(DEMO / "motor.toml", folder / "motor.csv", folder / "found")
                show(f"seed {seed}, hidden: {hidden}", found)
                self.assertEqual((found["verdict"], names(found), found["effects"][0]["equation"]), ("named", [effect], equation))
                (named,) = found["effects"][0]["parameters"]
                self.assertEqual(named["name"], parameter)
                # Three digits are written of what was hidden; the rest is five of the report's standard deviations.
                self.assertLess(abs(named["value"] - float(value)), 0.005 * abs(float(value)) + 5 * named["sd"])
            self.assertEqual(len(kinds), 4)

    def test_the_effect_of_the_page_is_one(self):
        """The same term as the library's dry friction under another name: alike, and the search says so."""
        page = (SOURCE / "docs" / "discover.md").read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory(prefix="algest-demo-") as name:
            folder = Path(name)
            run(CXX, "-std=c++17", "-O2", DEMO / "simulate_motor.cpp", "-o", folder / "simulate_motor")
            run(folder / "simulate_motor", 1, folder / "motor.csv", folder / "hidden.txt")
            shutil.copy(DEMO / "motor.toml", folder)
            (folder / "effects").mkdir()
            (folder / "effects" / "seal.toml").write_text(re.search(r"```toml-effect\n(.*?)```", page, flags=re.DOTALL)[1], encoding="utf-8")
            found = discover(folder / "motor.toml", folder / "motor.csv", folder / "found")
            self.assertEqual((found["verdict"], sorted(found["alternatives"])), ("ambiguous", [["coulomb_friction"], ["seal_friction"]]))


if __name__ == "__main__":
    unittest.main()
