# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `algest` as a user does, in a folder of the test's own, on a small model whose answer is known: an RL circuit."""
import json
import math
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST

RL_CIRCUIT = """\
format = 1
name = "rl"
summary = "a coil with its resistance"

[sampling]
period = 1e-3
window = 0.05

[signals]
u = { unit = "V" }
i = { unit = "A" }

[parameters]
R = { unit = "ohm", initial = 1 }
L = { unit = "H", initial = 1 }

[[equation]]
name = "coil"
ode = "L*der(i) = u - R*i"
"""

R, L = 2.0, 0.05      # ohm, H
HEADER = "t [s],u [V],i [A]"
HANGS = 600           # s: the longest command needs 10 s of its own; the machine may be busy with twenty others


def coil_rows(count):
    """t, u, i at 1 kHz: i for u = 3 + 2 sin(40 t) V, in closed form, from i = 0."""
    w, rate = 40.0, R / L
    square = rate * rate + w * w
    rows = []
    for k in range(count):
        t = k / 1000
        decay = math.exp(-rate * t)
        sine = (rate * math.sin(w * t) - w * math.cos(w * t) + w * decay) / square
        rows.append((t, 3 + 2 * math.sin(w * t), (3 * (1 - decay) / rate + 2 * sine) / L))
    return rows


def csv(rows, header=HEADER, end="\n"):
    return end.join([header] + [",".join(repr(v) for v in row) for row in rows]) + end


class CommandLine(unittest.TestCase):
    """A folder with rl.toml and coil.csv in it, and `algest` run there."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.write("rl.toml", RL_CIRCUIT)
        self.write("coil.csv", csv(coil_rows(200)))

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text.encode() if isinstance(text, str) else text)
        return path

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if p.is_file())

    def algest(self, *words, exit_code=0, **options):
        """Runs it; asserts the exit code; (stdout, stderr)."""
        result = subprocess.run([str(ALGEST), *map(str, words)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=HANGS, **options)
        out, err = result.stdout.decode(), result.stderr.decode()
        self.assertEqual(result.returncode, exit_code, f"algest {' '.join(map(str, words))}\n{out}{err}")
        return out, err

    def algest_json(self, *words, exit_code=0):
        """The one object on standard output; anything else there fails."""
        out, _ = self.algest(*words, "--json", exit_code=exit_code)
        value = json.loads(out, parse_constant=lambda name: self.fail(f"{name} is no JSON"))
        self.assertIsInstance(value, dict)
        return value
