# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference of docs/model-file.md is the parser's own table; every key in it is read, and every default in it is what counts without the key."""
import json
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, SOURCE, run

PAGE = SOURCE / "docs" / "model-file.md"
BEGIN = "<!-- From here on: build/algest keys --format markdown. tests/docs/test_model_keys.py compares. -->\n\n"

HEAD = """\
format = 1
name = "m"
[sampling]
period = 0.1
window = 2
[signals.y]
unit = "1"
[signals.u]
unit = "1"
"""
EQUATION = HEAD + """\
[constants.c]
value = 2
unit = "1"
[parameters.a]
unit = "1/s"
[[equation]]
ode = "der(y) = a*c*u"
[estimator]
solve = "robust"
[estimator.ratio_filter]
omega_n = 1
[[feedback]]
signal = "u"
law = "-y"
"""
TRANSFER = HEAD + """\
[transfer]
n = 1
unknowns = ["a0", "b0"]
"""
INPUTS = HEAD + """\
[transfer]
n = 1
unknowns = ["a0"]
[[transfer.input]]
signal = "u"
unknowns = ["b0"]
"""
DISCRETE = HEAD + """\
[estimator]
functional = "discrete"
[discrete]
domain = "q"
n = 1
[discrete.row_filter]
numerator = [1]
"""
FILTER = HEAD.replace("window = 2\n", "") + "[filter]\n"
# Heading of a section: a sound model that has it, and the line behind which its keys stand.
PLACES = {
    "at the top": (EQUATION, ""), "[sampling]": (EQUATION, "[sampling]"), "[signals] NAME = { ... }": (EQUATION, "[signals.u]"),
    "[constants] NAME = { ... }": (EQUATION, "[constants.c]"), "[parameters] NAME = { ... }": (EQUATION, "[parameters.a]"), "[[equation]]": (EQUATION, "[[equation]]"),
    "[transfer]": (TRANSFER, "[transfer]"), "[[transfer.input]]": (INPUTS, "[[transfer.input]]"), "[estimator]": (EQUATION, "[estimator]"),
    "[estimator] ratio_filter = { ... }": (EQUATION, "[estimator.ratio_filter]"), "[discrete]": (DISCRETE, "[discrete]"),
    "[discrete] row_filter = { ... }": (DISCRETE, "[discrete.row_filter]"), "[filter]": (FILTER, "[filter]"), "[[feedback]]": (EQUATION, "[[feedback]]"),
}
A_DATE = "1979-05-27"   # what no key takes


def blocks(text):
    """[(header or "", its lines)]"""
    out = [("", [])]
    for line in text.splitlines():
        if line.startswith("["):
            out.append((line, []))
        else:
            out[-1][1].append(line)
    return out


def has(text, header, key):
    return any(line.startswith(key + " =") for head, lines in blocks(text) if head == header for line in lines)


def with_key(text, header, key, value):
    """The model with `key = value` first behind the header, in place of what the key had; and the number of that line."""
    table = re.escape(header.strip("[]") + "." + key if header else key)
    out, at = [], None
    for head, lines in blocks(text):
        if re.fullmatch(rf"\[+{table}(\..*)?\]+", head):
            continue
        if head:
            out.append(head)
        if head == header:
            out.append(f"{key} = {value}")
            at = len(out)
            lines = [line for line in lines if not line.startswith(key + " =")]
        out += lines
    return "\n".join(out) + "\n", at


class ModelKeys(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-keys-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.sections = json.loads(run(ALGEST, "keys", "--json"))["sections"]

    def algest(self, text, *words):
        (self.folder / "m.toml").write_text(text)
        return subprocess.run([ALGEST, *words], cwd=self.folder, text=True, capture_output=True)

    def test_the_page_is_the_table(self):
        page = PAGE.read_text(encoding="utf-8")
        self.assertEqual(page[page.index(BEGIN) + len(BEGIN):], run(ALGEST, "keys", "--format", "markdown"),
                         "put the output of `build/algest keys --format markdown` behind the comment in docs/model-file.md")

    def test_every_key_is_said_what_it_means(self):
        self.assertEqual({s["heading"] for s in self.sections}, set(PLACES))
        for section in self.sections:
            for key in section["keys"]:
                with self.subTest(section=section["heading"], key=key["name"]):
                    self.assertGreater(len(key["meaning"]), 5)
                    self.assertNotIn("\n", key["meaning"])
                    self.assertTrue(key["page"] == "" or (SOURCE / "docs" / key["page"]).is_file())

    def test_the_models_of_this_test_are_sound(self):
        for text in {text for text, _ in PLACES.values()}:
            done = self.algest(text, "check", "m.toml")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_every_key_is_read(self):
        """A key of the table that no reader asks for would take anything."""
        for section in self.sections:
            for key in section["keys"]:
                text, header = PLACES[section["heading"]]
                if key["name"] == "transfer":   # not beside equations
                    text = TRANSFER
                with self.subTest(section=section["heading"], key=key["name"]):
                    changed, line = with_key(text, header, key["name"], A_DATE)
                    done = self.algest(changed, "check", "m.toml")
                    self.assertEqual(done.returncode, 2)
                    self.assertRegex(done.stderr, rf"m\.toml:{line}:\d+: error")

    def generated(self, text):
        done = self.algest(text, "generate", "m.toml", "-o", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        return {file.name: file.read_bytes() for file in (self.folder / "out" / "m").iterdir()}

    def test_a_key_that_says_its_default_changes_nothing(self):
        count = 0
        for section in self.sections:
            text, header = PLACES[section["heading"]]
            plain = self.generated(text)
            for key in section["keys"]:
                if key["default"] == "" or key["default"].startswith("(") or has(text, header, key["name"]):
                    continue
                with self.subTest(section=section["heading"], key=key["name"]):
                    self.assertEqual(self.generated(with_key(text, header, key["name"], key["default"])[0]), plain)
                    count += 1
        self.assertGreater(count, 15)


if __name__ == "__main__":
    unittest.main()
