# SPDX-License-Identifier: GPL-3.0-or-later
"""Every model, on both engines, in single precision, on both emulated controllers: what it costs. As a program: writes docs/target-table.md."""
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from environment import SOURCE, run
from driven import MEASURED, driven
from emulated import CORES, Board, engines, footprint, generate, skip_without_tools

TABLE = SOURCE / "docs/target-table.md"
OK = 1   # of algest::Status
FULL = "pmsm_electrical, M = 2000"
FULL_MODEL = SOURCE / "bench/pmsm_full_window.toml"   # as 000 would have it: 10 kHz, S(t) over as many


@dataclass(frozen=True)
class Row:
    model: str
    engine: str
    core: str
    push_mean: int
    push_most: int
    estimate_mean: int
    estimate_most: int
    stack: int
    ram: int
    flash: int

    NUMBERS = ("push_mean", "push_most", "estimate_mean", "estimate_most", "stack", "ram", "flash")

    def line(self):
        return f"| {self.model} | {self.engine} | {self.core} | " + " | ".join(str(getattr(self, n)) for n in self.NUMBERS) + " |"


@dataclass(frozen=True)
class Case:
    name: str
    model: Path
    engine: str


def cases():
    for model in sorted(SOURCE.glob("models/*.toml")):
        for engine in engines(model):
            yield Case(model.stem, model, engine)
    yield Case(FULL, FULL_MODEL, "moments")


def measure(case, emitted, rows, core, folder):
    """The row of the table, and what ran on the board."""
    ran = Board(emitted, core, folder).run(rows)
    ok = sum(answer[0] == OK for answer in ran.answers.of[-MEASURED:])
    if ok <= MEASURED // 4:
        raise AssertionError(f"{case.name}: {ok} of {MEASURED} estimates are ok; inputs that do not move the model say nothing of answers and costs")
    size = footprint(emitted, core, folder)
    push, estimate = ran.push[-MEASURED:], ran.estimate[-MEASURED:]
    return Row(case.name, case.engine, core, round(sum(push) / MEASURED), max(ran.push), round(sum(estimate) / MEASURED), max(ran.estimate),
               size.stack, size.ram, size.flash), ran


def read_table():
    rows = {}
    for line in TABLE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 10 and cells[3].isdigit():
            row = Row(*cells[:3], *(int(c) for c in cells[3:]))
            rows[row.model, row.engine, row.core] = row
    return rows


def text(rows):
    compiler = run("arm-none-eabi-g++", "--version").splitlines()[0]
    return f"""<!-- SPDX-License-Identifier: GPL-3.0-or-later -->
<!-- Written by `cmake --build build --target target_table`; tests/target compares it with what it measures. -->
# What estimators cost on a controller

Single precision, {compiler}, -O2. Instructions of one call **under emulation** (qemu-system-arm, -icount), not cycles; mean over the last {MEASURED} samples of a run,
where estimates are `ok`, and the most of any call. Stack: all frames of the program together, more than is ever in use at once. RAM and flash: of a
bare-metal controller that calls every member, vectors and start-up code included, stack not. Bytes. [engines.md](engines.md) says more.

| model | engine | core | push, mean | push, most | estimate, mean | estimate, most | stack | RAM | flash |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
""" + "".join(row.line() + "\n" for row in rows)


def main():
    skip_without_tools()
    rows = []
    for case in cases():
        with tempfile.TemporaryDirectory() as folder:
            emitted = generate(case.model, case.engine, Path(folder) / "generated")
            for core in CORES:
                row, _ = measure(case, emitted, driven(case.name, emitted), core, Path(folder))
                rows.append(row)
                print(row.line(), file=sys.stderr, flush=True)
    TABLE.write_text(text(rows))


if __name__ == "__main__":
    main()
