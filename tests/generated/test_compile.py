# SPDX-License-Identifier: GPL-3.0-or-later
"""Every generated header, in double and in float, compiles under two compilers with all warnings, with and without
optimisation; not with -ffast-math; and its object needs neither an allocator nor exceptions nor memory that changes."""
import re
import tempfile
import unittest
from pathlib import Path

from environment import ALGEST, SOURCE, run
from generated_headers import COMPILERS, FLAGS, MODELS, WARNINGS, class_name, float_headers, folders, in_parallel, of, output

PROGRAM = SOURCE / "tests/generated/programs/every_member.cpp"

# What an object may ask of the program: a freestanding C library and libm. Everything else is refused by name. Where a C library has sincos,
# as glibc and newlib do, a compiler joins the sine and the cosine of one angle to it.
ALLOWED = {"memcpy", "memmove", "memset", "sqrt", "sqrtf", "exp", "expf", "log", "logf", "sin", "sinf", "cos", "cosf", "sincos", "sincosf",
           "tan", "tanf", "pow", "powf", "_GLOBAL_OFFSET_TABLE_"}


class Compile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="algest-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.folders = folders(float_headers(self.folder / "float"))
        self.assertGreaterEqual(len(MODELS), 6)

    def everywhere(self, job, levels=("-O0", "-O2")):
        """job(compiler, optimisation, scalar, model), for all of them; shows all that fail."""
        failures = in_parallel([(f"{model}, {scalar}, {compiler} {level}", lambda words=(compiler, level, scalar, model): job(*words))
                                for model in MODELS for scalar in self.folders for compiler in COMPILERS for level in levels])
        self.assertEqual(failures, [], "\n" + "\n".join(failures))

    def test_without_a_warning_and_without_foreign_symbols(self):
        def job(compiler, level, scalar, model):
            target = self.folder / f"{model}-{scalar}-{compiler}{level}.o"
            folder = self.folders[scalar]
            run(compiler, *FLAGS, *WARNINGS, level, *of(model, folder), "-c", PROGRAM, "-o", target)
            undefined = {line.split()[-1] for line in run("nm", "--undefined-only", target).splitlines()}
            self.assertLessEqual(undefined, ALLOWED, f"{target.name} refers to more than a bare target has")

            # What changes is the estimator alone; tables are constant (.data.rel.ro: constant once their addresses are known).
            changing = []
            for line in run("nm", "-f", "sysv", "--defined-only", target).splitlines():
                fields = [field.strip() for field in line.split("|")]
                if len(fields) == 7 and re.match(r"\.(data|bss|tdata|tbss)(?!\.rel\.ro)", fields[6]) and fields[2] not in "VR":
                    changing.append(fields[0])
            self.assertEqual(changing, ["estimator"], "mutable statics")

            stated = int(re.search(r"Memory: (\d+) bytes an instance", (folder / model / f"{model}.hpp").read_text())[1])
            size = [int(line.split("|")[4], 16) for line in run("nm", "-f", "sysv", target).splitlines() if line.startswith("estimator ")]
            self.assertEqual(size, [stated])

        self.everywhere(job)

    def test_fast_math_is_refused(self):
        def job(compiler, level, scalar, model):
            for flag in ("-ffast-math", "-ffinite-math-only", "-Ofast") if model == MODELS[0] else ("-ffast-math",):
                code, said = output(compiler, *FLAGS, level, flag, *of(model, self.folders[scalar]), "-fsyntax-only", PROGRAM)
                self.assertNotEqual(code, 0, f"{flag} was accepted")
                self.assertIn("compile without -ffast-math", said)

        self.everywhere(job, ("-O1",))

    def test_a_foreign_symbol_would_be_seen(self):
        source = self.folder / "allocates.cpp"
        source.write_text("int* f();\nint* f() { return new int(1); }\n")
        run("g++", *FLAGS, "-c", source, "-o", self.folder / "allocates.o")
        self.assertIn("_Znwm", run("nm", "--undefined-only", self.folder / "allocates.o"))
        self.assertNotIn("_Znwm", ALLOWED)

    def test_moments_compile_without_a_warning_and_their_tables_take_what_is_stated(self):
        model = (SOURCE / "models/rl_circuit.toml").read_text()
        moments = "coefficients, ends, degrees"
        for name, text, options, arrays in (("wide", model, ["--scalar", "double"], moments),
                                            ("single", model, ["--scalar", "float"], moments),
                                            ("grown", model.replace("\nwindow", "\ngrowing = true\nwindow"), [], moments + ", growing, growing_newest, derivatives")):
            with self.subTest(tables=name):
                folder = self.folder / name
                folder.mkdir()
                (folder / "rl_circuit.toml").write_text(text)
                run(ALGEST, "generate", folder / "rl_circuit.toml", "--engine", "moments", "-o", folder, *options)
                [stated] = re.findall(r"(\d+) bytes of tables", (folder / "rl_circuit/rl_circuit.hpp").read_text())
                sizes = " + ".join(f"sizeof algest::generated::rl_circuit_tables::{array}" for array in arrays.split(", "))
                source = folder / "sizes.cpp"
                source.write_text(f'#include "rl_circuit/rl_circuit_tables.hpp"\nstatic_assert({sizes} == {stated}, "");\n')
                run("g++", *FLAGS, f"-I{folder}", "-fsyntax-only", source)
                for compiler in COMPILERS:   # the runtime's moments are in no header of generated/
                    run(compiler, *FLAGS, *WARNINGS, "-O2", *of("rl_circuit", folder), "-c", PROGRAM, "-o", folder / "estimator.o")

    def test_scalars_are_what_they_should_be(self):
        for scalar, folder in self.folders.items():
            for model in MODELS:
                text = (folder / model / f"{model}.hpp").read_text()
                self.assertIn(f"class {class_name(model)} {{", text)
                self.assertIn(f"using Scalar = {scalar};", text)


if __name__ == "__main__":
    unittest.main()
