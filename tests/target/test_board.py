# SPDX-License-Identifier: GPL-3.0-or-later
"""Every model in single precision on two emulated controllers: the answers are those of this machine, the cost is that of docs/target-table.md."""
import tempfile
import unittest
from pathlib import Path

from emulated import CORES, SIZES, Board, exciting, footprint, generate, skip_without_tools, unpacked
from measured import FULL, FULL_MODEL, MEASURED, Row, cases, measure, read_table
from environment import SOURCE

skip_without_tools()

MARGIN = 0.05   # of a number in the table; another patch level of the compiler moves a few percent
LIBM = {"pendulum"}   # sin of another C library
OK = 1


class OnBoard(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)


class EveryModel(OnBoard):
    def same_answers(self, name):
        def check(emitted, ran, bits):
            del emitted
            wanted = unpacked(bits, len(ran.answers))
            if name not in LIBM:
                self.assertEqual(ran.bits, bits)
                return
            self.assertEqual([a[0] for a in ran.answers], [w[0] for w in wanted])
            for a, w in zip(ran.answers, wanted):
                for x, y in zip(a[2:], w[2:]):
                    # the last bit of sin, times a condition of about 100, twice in the sums
                    self.assertFalse(not abs(x - y) <= 1e-3 * abs(y), (a, w))
        return check

    def test_answers_and_cost(self):
        table = read_table()
        for name, model, engine in cases():
            for core in CORES:
                with self.subTest(model=name, engine=engine, core=core), tempfile.TemporaryDirectory() as folder:
                    row = measure(name, model, engine, core, Path(folder), self.same_answers(name))
                    print(row.line(), flush=True)
                    wanted = table[name, engine, core]
                    for number in Row.NUMBERS:
                        with self.subTest(number=number):
                            self.assertLessEqual(abs(getattr(row, number) - getattr(wanted, number)), MARGIN * getattr(wanted, number))


class FullWindow(OnBoard):
    """000 calls its window of 2000 points at 10 kHz not computable online."""
    def test_instructions_do_not_depend_on_the_numbers(self):
        emitted = generate(FULL_MODEL, "moments", self.folder / "generated")
        board = Board(emitted, "Cortex-M4F", self.folder)
        most = {}
        for name, size in SIZES.items():
            ran = board.run(exciting(emitted.inputs, emitted.first_ok + MEASURED, size))
            most[name] = max(p + e for p, e in zip(ran.push, ran.estimate))
            print(f"{FULL}, {name} inputs: push at most {max(ran.push)}, push + estimate at most {most[name]} instructions")
            self.assertLessEqual(max(ran.push), 8000)
            self.assertLessEqual(most[name], 12000)
        # Branches that numbers take (which of two is larger, a rank test) are a few instructions each, some hundred of some 10 000; a loop whose
        # length hung on the numbers, or subnormals handled in software, would cost a multiple.
        self.assertLessEqual(max(most.values()) - min(most.values()), 0.05 * most["ordinary"])

    def test_memory_of_the_short_window(self):
        emitted = generate(SOURCE / "models/pmsm_electrical.toml", "moments", self.folder / "generated")
        size = footprint(emitted, "Cortex-M4F", self.folder)
        print(f"pmsm_electrical, M = 200: {size.ram} bytes of RAM, {size.stack} of stack, {size.flash} of flash")
        self.assertLessEqual(size.ram, 16 * 1024)
        self.assertLessEqual(size.flash, 24 * 1024)


if __name__ == "__main__":
    unittest.main()
