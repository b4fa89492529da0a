# SPDX-License-Identifier: GPL-3.0-or-later
"""One estimator on an emulated controller: what it answers, and what it costs there.

Instructions are instructions under emulation, not cycles: a Cortex-M takes 1 to 14 cycles for one, and waits for its memory besides.
"""
import json
import re
import shutil
import struct
import tempfile
from dataclasses import dataclass
from pathlib import Path

from environment import ALGEST, SOURCE, run, skip

HERE = SOURCE / "tests/target"
CORES = {   # name: compiler options, board
    "Cortex-M4F": ("-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16", "mps2-an386"),
    "Cortex-M7": ("-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16", "mps2-an500"),
}
FLAGS = "-std=c++17 -O2 -ffp-contract=off -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Werror"
STARTUP_FLAGS = "-std=c++17 -O2 -ffreestanding -fno-tree-loop-distribute-patterns -fno-exceptions -fno-rtti -Wall -Wextra -Werror"
FORMATS = {"float": "f", "double": "d"}   # of python's struct


def skip_without_compiler():
    if not shutil.which("arm-none-eabi-g++"):
        skip("no arm-none-eabi-g++ (.ci/install target)")


def skip_without_tools():
    skip_without_compiler()
    if not shutil.which("qemu-system-arm"):
        skip("no qemu-system-arm (.ci/install target)")


@dataclass
class Emitted:
    """An estimator that `generate` wrote."""
    header: Path
    scalar: str = "float"

    @property
    def class_name(self):
        return re.search(r"^class (\w+) \{", self.header.read_text(), re.M)[1]

    @property
    def inputs(self):
        sample = re.search(r"struct Sample \{(.*?)\};", self.header.read_text(), re.S)[1]
        return len(re.findall(r"Scalar \w+;", sample))

    @property
    def first_ok(self):
        return int(re.search(r"First `ok` at sample (\d+)", self.header.read_text())[1])

    @property
    def definitions(self):
        return [f'-DHEADER="{self.header}"', f"-DCLASS={self.class_name}", f"-I{SOURCE}/runtime/include"]


def generate(model, engine, folder, scalar="float"):
    run(ALGEST, "generate", model, "--engine", engine, "--scalar", scalar, "-o", folder)
    [header] = [h for h in Path(folder).glob("*/*.hpp") if h.stem == h.parent.name]
    return Emitted(header, scalar)


def engines(model):
    """That the model can have."""
    with tempfile.TemporaryDirectory() as folder:
        [made] = json.loads(run(ALGEST, "generate", model, "--json", "-o", folder))["models"]
    return sorted(cost["engine"] for cost in made["cost"])


def as_bits(rows, scalar):
    return b"".join(struct.pack(f"<{len(row)}{FORMATS[scalar]}", *row) for row in rows)


def link(emitted, core, program, script, folder, *more):
    """Compiles and links against -lm -lgcc and nothing else: there is no heap to be had. The image, and the bytes of stack of each function."""
    cpu = CORES[core][0].split()
    objects = [folder / "program.o", folder / "startup.o"]
    run("arm-none-eabi-g++", *cpu, *FLAGS.split(), "-fstack-usage", *emitted.definitions, *more, "-c", program, "-o", objects[0])
    run("arm-none-eabi-g++", *cpu, *STARTUP_FLAGS.split(), "-c", HERE / "image/startup.cpp", "-o", objects[1])
    image = folder / "image.elf"
    run("arm-none-eabi-g++", *cpu, "-nostdlib", f"-L{HERE}/image", "-T", script, *objects, "-lm", "-lgcc", "-o", image)
    usage = {}
    for line in (folder / "program.su").read_text().splitlines():
        place, size, kind = line.split("\t")
        usage[place] = int(size)
        if kind != "static":
            raise AssertionError(f"a stack frame of {kind} size: {line}")
    return image, usage


@dataclass
class Footprint:
    flash: int
    ram: int
    stack: int   # all frames at once, more than is ever in use


def footprint(emitted, core, folder):
    """Of a controller that calls every member."""
    image, usage = link(emitted, core, HERE / "image/controller.cpp", HERE / "board/board.ld", folder)
    text, data, bss = (int(n) for n in run("arm-none-eabi-size", image).splitlines()[1].split()[:3])
    return Footprint(text + data, data + bss, sum(usage.values()))


@dataclass
class Answers:
    bits: bytes
    of: list   # by sample: status, condition, parameters


def answers(bits, count, scalar):
    row = struct.Struct(f"<{len(bits) // struct.calcsize(FORMATS[scalar]) // count}{FORMATS[scalar]}")
    return Answers(bits, list(row.iter_unpack(bits)))


@dataclass
class Run:
    answers: Answers
    push: list      # instructions, by sample
    estimate: list


class Board:
    """The estimator on a board of its own."""
    def __init__(self, emitted, core, folder):
        self.scalar, self.machine, self.folder = emitted.scalar, CORES[core][1], folder
        self.image, _ = link(emitted, core, HERE / "board/main.cpp", HERE / "board/board.ld", folder)

    def run(self, rows):
        (self.folder / "input.bin").write_bytes(as_bits(rows, self.scalar))
        run("qemu-system-arm", "-M", self.machine, "-nographic", "-monitor", "none", "-serial", "none", "-icount", "shift=10",
            "-semihosting-config", "enable=on,target=native", "-kernel", self.image, cwd=self.folder, timeout=600)
        bits = (self.folder / "output.bin").read_bytes()
        counts = list(struct.iter_unpack("<2I", (self.folder / "counts.bin").read_bytes()))
        return Run(answers(bits, len(rows), self.scalar), [c[0] for c in counts], [c[1] for c in counts])


class Host:
    """The same estimator, compiled for this machine."""
    def __init__(self, emitted, folder):
        self.scalar, self.folder, self.program = emitted.scalar, folder, folder / "host"
        run("c++", *FLAGS.split(), *emitted.definitions, HERE / "board/host.cpp", "-o", self.program)

    def run(self, rows):
        (self.folder / "host.in").write_bytes(as_bits(rows, self.scalar))
        run(self.program, self.folder / "host.in", self.folder / "host.out")
        return answers((self.folder / "host.out").read_bytes(), len(rows), self.scalar)
