# SPDX-License-Identifier: GPL-3.0-or-later
"""The committed models on recordings of real machines: published values come out, and the compiled estimator says the same."""
import math
import struct
import subprocess
import unittest

from command_line import CommandLine
from environment import CXX, SHARED, SOURCE, run, skip

EMPS = SHARED / "recordings" / "emps.csv"
PENDULUM = SHARED / "recordings" / "single_pendulum.csv"

PROGRAM = """\
#include <cstdio>
#include "positioning_axis/positioning_axis.hpp"
int main() {
    static algest::generated::PositioningAxis estimator;
    algest::generated::PositioningAxis::Sample s;
    while (std::scanf("%lf %lf", &s.q, &s.force) == 2) {
        const auto e = estimator.step(s);
        std::printf("%s %a %a %a %a %a\\n", algest::name(e.status), e.condition, e.M, e.Fv, e.Fc, e.offset);
    }
}
"""


def bits(number):
    return struct.pack("<d", number)


class Measured(CommandLine):
    def medians(self, model, recording):
        value = self.algest_json("replay", SOURCE / "models" / f"{model}.toml", recording)
        return {p["name"]: p["median"] for p in value["parameters"]}, {p["name"]: p["last"] for p in value["parameters"]}

    def test_positioning_axis(self):
        published = {"M": (95.1, 0.03), "Fv": (203.5, 0.04), "Fc": (20.4, 0.08), "offset": (-3.2, 0.15)}
        for found in self.medians("positioning_axis", EMPS):
            for name, (value, tolerance) in published.items():
                self.assertLess(abs(found[name] / value - 1), tolerance, f"{name} = {found[name]}, published {value}")

    def test_pendulum(self):
        for found in self.medians("pendulum", PENDULUM):
            self.assertLess(abs(found["gravity"] / 64.1 - 1), 0.01)

    def test_replay_and_the_compiled_estimator_agree_to_the_last_bit(self):
        self.algest("replay", SOURCE / "models/positioning_axis.toml", EMPS, "-o", "replay.csv")
        replayed = [line.split(",") for line in (self.folder / "replay.csv").read_text().splitlines()[1:]]

        with open(EMPS, encoding="utf-8") as file:
            header = [name.split(" ")[0] for name in file.readline().strip().split(",")]
            q, force = header.index("qm"), header.index("force")
            samples = [line.strip().split(",") for line in file]
        self.write("program.cpp", PROGRAM)
        run(CXX, "-std=c++17", "-O2", "-ffp-contract=off", "-I", SOURCE / "runtime/include", "-I", SOURCE / "generated",
            "program.cpp", "-o", "program", cwd=self.folder)
        text = "".join(f"{row[q]} {row[force]}\n" for row in samples)
        result = subprocess.run([self.folder / "program"], input=text, text=True, stdout=subprocess.PIPE, check=True)
        compiled = [line.split() for line in result.stdout.splitlines()]

        self.assertEqual(len(replayed), 24841)
        self.assertEqual(len(compiled), 24841)
        for (time, status, condition, *parameters), (their_status, their_condition, *their_parameters) in zip(replayed, compiled):
            self.assertEqual(status, their_status, time)
            self.assertEqual(bits(float(condition or math.inf)), bits(float.fromhex(their_condition)), time)
            self.assertEqual([bits(float(p)) for p in parameters], [bits(float.fromhex(p)) for p in their_parameters], time)

    def test_all_recordings_are_read(self):
        # A model that asks for a column none of them has: everything else about them must be sound.
        self.write("rl.toml", (self.folder / "rl.toml").read_text().replace('"A" }', '"A", column = "no such column" }'))
        files = sorted((SHARED / "recordings").glob("*.csv"))
        self.assertGreaterEqual(len(files), 13)
        for file in files:
            _, err = self.algest("replay", "rl.toml", file, exit_code=2)
            errors = [line for line in err.splitlines() if ": error: " in line]
            self.assertTrue(all("no column" in e or "is sampled every" in e for e in errors) and errors, err)


if __name__ == "__main__":
    if not EMPS.exists():
        skip(f"there are no recordings in {SHARED}")
    unittest.main()
