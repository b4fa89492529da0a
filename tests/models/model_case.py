# SPDX-License-Identifier: GPL-3.0-or-later
"""Model files in a folder of the test's own, and `algest` run on them. A mark in a text shows where a complaint belongs."""
import re
import resource
import subprocess
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

from environment import ALGEST

MARK = "▸"     # no character of any model here
HANG = 300.0   # s of the clock, on a machine that may be busy with twenty others; tests limit the seconds of the processor


def without_marks(text):
    """The text as it goes into the file (a lone surrogate \\udcXX becomes the byte XX), and the places of the marks: lines
    and columns from 1, columns in characters, a byte-order mark being none."""
    places = []
    line, column = 1, 1
    plain = []
    for character in text:
        if character == MARK:
            places.append((line, column))
            continue
        plain.append(character)
        if character == "\n":
            line, column = line + 1, 1
        elif character != "\ufeff":
            column += 1
    return "".join(plain).encode("utf-8", "surrogateescape"), places


def complaints(err, severity="error", name="m.toml"):
    """[(line, column, text)] of the complaints of one severity in what was printed, in the order printed; no place: (0, 0)."""
    out = []
    for row in err.splitlines():
        head, found, text = row.partition(f": {severity}: ")
        if not found or not head.startswith(name):
            continue
        place = [int(number) for number in head[len(name) + 1:].split(":")] if head != name else [0, 0]
        out.append((place[0], place[1], text))
    return out


def value(text, numbers):
    """Of a formula of names, numbers and + - * / ^ ( ), exactly."""
    if not re.fullmatch(r"[\w+\-*/^() .]+", text):
        raise AssertionError(f"not a formula: {text}")
    python = re.sub(r"(?<![\w.])(\d+)(?![\w.])", r"Fraction(\1)", text.replace("^", "**"))
    python = re.sub(r"\*\*Fraction\((\d+)\)", r"**\1", python)
    return eval(python, {"Fraction": Fraction, "__builtins__": {}}, dict(numbers))


class ModelCase(unittest.TestCase):
    """A folder with m.toml in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, content, name="m.toml"):
        (self.folder / name).write_bytes(content)

    def run_algest(self, *words):
        """(exit code, standard output, standard error, seconds of the processor). A run without end or by a signal fails the test."""
        start = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            result = subprocess.run([str(ALGEST), *words], cwd=self.folder, stdin=subprocess.DEVNULL,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=HANG)
        except subprocess.TimeoutExpired:
            self.fail(f"algest {' '.join(words)} does not end")
        end = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = end.ru_utime + end.ru_stime - start.ru_utime - start.ru_stime
        out, err = result.stdout.decode(), result.stderr.decode()
        self.assertIn(result.returncode, (0, 1, 2), f"algest {' '.join(words)}\n{out}{err}")
        self.assertNotIn("fault of algest itself", err)
        return result.returncode, out, err, seconds

    def entries(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))
