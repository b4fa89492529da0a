# SPDX-License-Identifier: GPL-3.0-or-later
"""What every run on a spoilt model must keep to: no crash, no hang, an exit code of the contract, a message that says something."""
import json
import random
from fractions import Fraction

from environment import SOURCE
from model_case import ModelCase, value
from mutations import mutants

MOST_SECONDS = 2.0


class MutantsCase(ModelCase):
    def models(self):
        texts = [path.read_bytes() for path in sorted((SOURCE / "models").glob("*.toml"))]
        self.assertTrue(texts)
        return texts

    def inverse_is_exact(self, answer):
        """The parameters, put into what the unknowns mean and back, are themselves."""
        draw = random.Random(1)
        parameters = {parameter["name"]: Fraction(draw.randint(10 ** 3, 10 ** 6), draw.randint(1, 10 ** 3)) for parameter in answer["parameters"]}
        unknowns = {unknown["name"]: value(unknown["meaning"], parameters) for unknown in answer["unknowns"]}
        for parameter in answer["parameters"]:
            self.assertEqual(value(parameter["from"], unknowns), parameters[parameter["name"]], parameter)

    def examine(self, text):
        """The exit codes of check, derive and generate."""
        self.write(text)
        codes = []
        for command in (("check", "m.toml"), ("derive", "m.toml", "--format", "json"), ("generate", "m.toml", "-o", "out")):
            code, out, err, seconds = self.run_algest(*command)
            self.assertLess(seconds, MOST_SECONDS, command)
            complaints = [row for row in err.splitlines() if ": error: " in row or ": not identifiable: " in row]
            if code == 0:
                self.assertEqual(complaints, [])
                if command[0] == "derive":
                    self.inverse_is_exact(json.loads(out))
            else:
                self.assertTrue(complaints, err)
                for row in complaints:
                    self.assertTrue(row.startswith("m.toml"), row)
                    self.assertGreater(len(row.partition(": error: ")[2] or row.partition(": not identifiable: ")[2]), 5, row)
                self.assertLess(len(err), 100_000)
                self.assertNotIn("out", self.entries())
            codes.append(code)
            if codes == [2]:
                break
        if len(codes) == 3:
            self.assertEqual(codes[1], codes[2])
            self.assertGreaterEqual(codes[1], codes[0])
        for path in sorted((self.folder / "out").rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()
        if (self.folder / "out").exists():
            (self.folder / "out").rmdir()
        return codes

    def examine_all(self, seed, count):
        answers = {0: 0, 1: 0, 2: 0}
        for number, text in enumerate(mutants(seed, count, self.models())):
            with self.subTest(seed=seed, number=number):
                try:
                    answers[self.examine(text)[0]] += 1
                except AssertionError:
                    print(f"mutant {number} of seed {seed}:\n{text!r}")
                    raise
        for code, times in answers.items():      # spoilt, but not all beyond recognition
            self.assertGreater(times, count // 100, f"exit code {code} came {times} times")
