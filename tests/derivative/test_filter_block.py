# SPDX-License-Identifier: GPL-3.0-or-later
"""The parabola filter as a user's block: what `generate` writes compiles under two compilers in both scalars, needs nothing of a heap, answers every
sample, and says in its derivation what it does to a signal and its noise."""
import ctypes
import math
import random
import re
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, SOURCE, run

MODEL = SOURCE / "models/filters/angle_filter.toml"
ALLOWED = {"_GLOBAL_OFFSET_TABLE_", "memcpy", "memset", "__stack_chk_fail"}
PROGRAM = """#include <angle_filter/angle_filter.hpp>
static algest::generated::AngleFilter filter;
using Scalar = algest::generated::AngleFilter::Scalar;
extern "C" void restart() { filter.reset(); }
extern "C" int step(Scalar theta, Scalar* out) {
    algest::generated::AngleFilter::Sample s;
    s.theta = theta;
    const auto o = filter.step(s);
    out[0] = o.theta;
    out[1] = o.der_theta;
    return static_cast<int>(o.status);
}
extern "C" int bytes() { return static_cast<int>(sizeof filter); }
"""
FILLING, OK, REJECTED = 0, 1, 3


def as_float(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def recursion(samples, rate, rounded):
    """The paper's recursion in the order of operations of the runtime; `rounded` after each: floats computed as floats."""
    r, value, slope, out = rounded, None, None, []
    for k in range(1, len(samples)):
        here, newest = samples[k - 1], samples[k]
        if k == 1:
            value, slope = here, r(newest - here)
        else:
            miss_here = r(r(value + slope) - here)
            miss_next = r(r(value + r(slope + slope)) - newest)
            bend = r(-r(miss_here + r(4 * miss_next)) / 17)
            value, slope = r(r(value + slope) + bend), r(slope + r(bend + bend))
        out.append((value, r(slope * rate)))
    return out


class FilterBlock(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def library(self, compiler, scalar):
        """The emitted block, compiled without a warning and loaded."""
        out = self.folder / scalar
        run(ALGEST, "generate", MODEL, "-o", out, "--scalar", scalar)
        (self.folder / "block.cpp").write_text(PROGRAM)
        target = self.folder / f"{compiler}-{scalar}.so"
        run(compiler, "-std=c++17", "-O2", "-ffp-contract=off", "-fno-exceptions", "-fno-rtti", "-fPIC", "-shared", *"-Wall -Wextra -Wconversion -Wshadow -Werror".split(),
            f"-I{SOURCE}/runtime/include", f"-I{out}", self.folder / "block.cpp", "-o", target)
        return target, out / "angle_filter/angle_filter.hpp"

    def test_the_block_is_the_recursion_to_the_last_bit(self):
        random.seed(2)
        for compiler in ("g++", "clang++"):
            for scalar, kind, rounded in (("double", ctypes.c_double, float), ("float", ctypes.c_float, as_float)):
                with self.subTest(compiler=compiler, scalar=scalar):
                    target, header = self.library(compiler, scalar)
                    block = ctypes.CDLL(str(target))
                    block.step.argtypes = [kind, ctypes.POINTER(kind)]
                    out = (kind * 2)()
                    samples = [rounded(math.sin(0.02 * k) + random.gauss(0, 0.01)) for k in range(500)]
                    wanted = recursion(samples, rounded(1000.0), rounded)
                    self.assertEqual(block.step(samples[0], out), FILLING)
                    for k in range(1, len(samples)):
                        self.assertEqual(block.step(samples[k], out), OK)
                        self.assertEqual(tuple(out), wanted[k - 1])
                    held = tuple(out)
                    for bad in (math.nan, math.inf):
                        self.assertEqual(block.step(bad, out), REJECTED)
                        self.assertEqual(tuple(out), held)
                    self.assertEqual(block.step(0.0, out), FILLING)   # and starts anew
                    self.assertEqual(block.step(1.0, out), OK)
                    self.assertEqual(tuple(out), (0.0, 1000.0))
                    self.assertEqual(block.bytes(), int(re.search(r"Memory: (\d+) bytes", header.read_text())[1]))

    def test_it_needs_no_heap(self):
        for compiler in ("g++", "clang++"):
            self.library(compiler, "double")
            out = self.folder / "object.o"
            run(compiler, "-std=c++17", "-O0", "-fno-exceptions", "-fno-rtti", f"-I{SOURCE}/runtime/include", f"-I{self.folder}/double", "-c", self.folder / "block.cpp", "-o", out)
            undefined = {line.split()[-1] for line in run("nm", "--undefined-only", out).splitlines()}
            self.assertLessEqual(undefined, ALLOWED)

    def test_the_derivation_tells_the_figures(self):
        run(ALGEST, "generate", MODEL, "-o", self.folder)
        text = (self.folder / "angle_filter/angle_filter.md").read_text()
        self.assertIn("and 0.564 in s = T der(y)", text)
        self.assertIn("= 0.485", text)
        self.assertIn("One sample, since sample k+1 is needed", text)
        # noise 1e-4 rad at 1 kHz: 0.564e-4 / 1e-3
        self.assertRegex(text, r"\| theta \| 0.0001 \[rad\] \| 5.9e-05 \| 0.0564 \[[^\]]*\] \|")
        rows = re.findall(r"^\| (0\.\d\d) \| ([\d.]+) \| (-?[\d.]+) \| ([\d.]+) \| (-?[\d.]+) \|$", text, flags=re.MULTILINE)
        self.assertEqual(len(rows), 9)
        for f, value, value_phase, slope, slope_phase in rows:   # against the filter itself, fed with a cosine and a sine
            omega = 2 * math.pi * float(f)
            parts = [recursion([wave(omega * k) for k in range(200)], 1.0, float)[-1] for wave in (math.cos, math.sin)]
            turned = complex(math.cos(omega * 198), -math.sin(omega * 198))   # output 198 belongs to sample 198
            for column, (size, phase) in enumerate(((value, value_phase), (slope, slope_phase))):
                response = complex(parts[0][column], parts[1][column]) * turned / (1 if column == 0 else 1j * omega)
                self.assertAlmostEqual(abs(response), float(size), delta=6e-4)   # three printed decimals
                if abs(response) > 1e-3:
                    turn = math.degrees(math.atan2(response.imag, response.real)) - float(phase)
                    self.assertLess(abs((turn + 180) % 360 - 180), 0.06)   # one printed decimal

    def test_what_a_filter_cannot_have(self):
        text = MODEL.read_text()
        for change, said in ((("signals = [\"theta\"]", "signals = [\"tetha\"]"), "'tetha' is not a signal"),
                             (("signals = [\"theta\"]", "signals = [\"theta\", \"theta\"]"), "listed twice"),
                             (("kind = \"parabola\"", "kind = \"median\""), "parabola"),
                             (("period = 1e-3", "# period = 1e-3"), "a filter needs the sampling period"),
                             (("period = 1e-3", "period = 1e-3\nwindow = 1"), "a window is for estimators"),
                             (("[filter]", "[parameters]\na = { unit = \"1\" }\n[filter]"), "a model with [filter] estimates nothing")):
            self.assertIn(change[0], text)
            path = self.folder / "m.toml"
            path.write_text(text.replace(*change))
            result = subprocess.run([ALGEST, "generate", path, "-o", self.folder / "out"], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(said, result.stderr)
            self.assertRegex(result.stderr, r"m\.toml:\d+:\d+: error")
        for command in ("derive", "replay"):
            words = [MODEL] if command == "derive" else [MODEL, SOURCE / "examples/rl_circuit/recording.csv"]
            result = subprocess.run([ALGEST, command, *words], capture_output=True, text=True)
            self.assertEqual(result.returncode, 2)
            self.assertIn("a model with [filter] has no estimator", result.stderr)
        self.assertIn("ok", run(ALGEST, "check", MODEL, "--strict"))


if __name__ == "__main__":
    unittest.main()
