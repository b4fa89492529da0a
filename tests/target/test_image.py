# SPDX-License-Identifier: GPL-3.0-or-later
"""Every estimator in generated/ links into a bare-metal image with -nostdlib -lm -lgcc: no heap, no exceptions, no C++ library."""
import re
import tempfile
import unittest
from pathlib import Path

from emulated import CORES, HERE, Emitted, link, skip_without_compiler
from environment import SOURCE, run

skip_without_compiler()

HEAP_OR_EXCEPTION = re.compile(r"malloc|calloc|realloc|\bfree\b|sbrk|_Zn[wa]|_Zd[la]|__cxa|_Unwind|__gxx|__dso_handle|atexit|terminate")


class Image(unittest.TestCase):
    def link(self, header, core, folder):
        image, _ = link(Emitted(header), core, HERE / "image/controller.cpp", HERE / "image/image.ld", folder)
        self.assertIsNone(HEAP_OR_EXCEPTION.search(run("arm-none-eabi-nm", folder / "program.o")))
        self.assertIsNone(HEAP_OR_EXCEPTION.search(run("arm-none-eabi-nm", image)))
        text, data, bss = run("arm-none-eabi-size", image).splitlines()[1].split()[:3]
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
