# SPDX-License-Identifier: GPL-3.0-or-later
"""push, estimate, step and reset of every generated class never ask for memory: with malloc, operator new and all their kin
replaced, no call comes while they run, whatever the samples are."""
import tempfile
import unittest
from pathlib import Path

from environment import SOURCE, run
from generated_headers import COMPILERS, FLAGS, MODELS, float_headers, folders, in_parallel, of, output

PROGRAM = SOURCE / "tests/generated/programs/no_allocation.cpp"


class NoAllocation(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.folders = folders(float_headers(self.folder / "float"))

    def program(self, model, scalar, compiler):
        target = self.folder / f"{model}-{scalar}-{compiler}"
        run(compiler, *FLAGS, "-O1", *of(model, self.folders[scalar]), PROGRAM, "-o", target)
        return target

    def test_no_call_while_an_estimator_works(self):
        def job(model, scalar, compiler):
            code, said = output(self.program(model, scalar, compiler))
            self.assertEqual(code, 0, said)   # and all four statuses came
            self.assertIn("ok", said)

        failures = in_parallel([(f"{model}, {scalar}, {compiler}", lambda words=(model, scalar, compiler): job(*words))
                                for model in MODELS for scalar, compiler in zip(self.folders, COMPILERS)])
        self.assertEqual(failures, [], "\n" + "\n".join(failures))

    def test_a_call_would_be_seen(self):
        target = self.program("rl_circuit", "double", "g++")
        self.assertEqual(output(target, "allocate"), (1, "malloc was called\n"))
        self.assertEqual(output(target, "allocate", "in C++"), (1, "operator new was called\n"))


if __name__ == "__main__":
    unittest.main()
