# SPDX-License-Identifier: GPL-3.0-or-later
"""Every estimator in generated/ links into a bare-metal image with -nostdlib -lm -lgcc: no heap, no exceptions, no C++ library."""
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from environment import SOURCE, run, skip

if not shutil.which("arm-none-eabi-g++"):
    skip("no arm-none-eabi-g++ (.ci/install target)")

IMAGE = SOURCE / "tests/target/image"
CORES = {
    "cortex-m7": "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16",
    "cortex-m4": "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16",
}
FLAGS = "-std=c++17 -O2 -ffp-contract=off -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Werror"
STARTUP_FLAGS = "-std=c++17 -O2 -ffreestanding -fno-tree-loop-distribute-patterns -fno-exceptions -fno-rtti -Wall -Wextra -Werror"
HEAP_OR_EXCEPTION = re.compile(r"malloc|calloc|realloc|\bfree\b|sbrk|_Zn[wa]|_Zd[la]|__cxa|_Unwind|__gxx|__dso_handle|atexit|terminate")


class Image(unittest.TestCase):
    def link(self, header, core, folder):
        cpu = CORES[core].split()
        name = "".join(word.capitalize() for word in header.stem.split("_"))
        run("arm-none-eabi-g++", *cpu, *FLAGS.split(), f'-DHEADER="{header}"', f"-DCLASS={name}", f"-I{SOURCE}/runtime/include",
            "-c", IMAGE / "controller.cpp", "-o", folder / "controller.o")
        run("arm-none-eabi-g++", *cpu, *STARTUP_FLAGS.split(), "-c", IMAGE / "startup.cpp", "-o", folder / "startup.o")
        run("arm-none-eabi-g++", *cpu, "-nostdlib", "-T", IMAGE / "image.ld", folder / "startup.o", folder / "controller.o",
            "-lm", "-lgcc", "-o", folder / "image.elf")
        self.assertIsNone(HEAP_OR_EXCEPTION.search(run("arm-none-eabi-nm", folder / "controller.o")))
        self.assertIsNone(HEAP_OR_EXCEPTION.search(run("arm-none-eabi-nm", folder / "image.elf")))
        text, data, bss = run("arm-none-eabi-size", folder / "image.elf").splitlines()[1].split()[:3]
        print(f"{header.stem} on {core}: {int(text) + int(data)} bytes of flash, {int(data) + int(bss)} bytes of memory")

    def test_every_generated_estimator_links(self):
        headers = sorted(SOURCE.glob("generated/*/*.hpp"))
        headers = [header for header in headers if (header.parent / f"{header.parent.name}_tables.hpp").exists() and header.stem == header.parent.name]   # no filter
        self.assertNotEqual(headers, [], "generated/ holds no estimator")
        for header in headers:
            for core in CORES:
                with self.subTest(estimator=header.stem, core=core), tempfile.TemporaryDirectory() as folder:
                    self.link(header, core, Path(folder))


if __name__ == "__main__":
    unittest.main()
