# SPDX-License-Identifier: GPL-3.0-or-later
"""Every tracked file names its licence, the right one for its folder; none names a path of the machine it was written on, or holds a merge's marks."""
import subprocess
import unittest

from environment import SOURCE, run, skip

if subprocess.run(["git", "-C", SOURCE, "rev-parse"], capture_output=True).returncode != 0:
    skip("not a git checkout")

HOST, RUNTIME, EMITTED = "GPL-3.0-or-later", "MIT-0", "0BSD"
LICENCE = {"generator": HOST, "lab": HOST, "cli": HOST, "runtime": RUNTIME, "templates": EMITTED, "generated": EMITTED}
WITHOUT_COMMENTS = (".csv", ".json", ".md", ".svg", ".png", ".seed", "LICENSE")


class TrackedFiles(unittest.TestCase):
    def setUp(self):
        names = run("git", "-C", SOURCE, "ls-files", "-z").split("\0")
        self.files = [SOURCE / name for name in names if name and (SOURCE / name).is_file()]

    def test_each_names_its_licence(self):
        wrong = []
        for file in self.files:
            if file.name.endswith(WITHOUT_COMMENTS):
                continue
            folder = file.relative_to(SOURCE).parts[0]
            head = file.read_bytes()[:600].decode(errors="replace")
            if f"SPDX-License-Identifier: {LICENCE.get(folder, '')}" not in head:
                wrong.append(f"{file.relative_to(SOURCE)}: wants SPDX-License-Identifier: {LICENCE.get(folder, '...')}")
        self.assertEqual(wrong, [])

    def test_none_names_a_path_of_this_machine(self):
        beside = SOURCE.parent if len(SOURCE.parts) > 2 else SOURCE  # "/" would be in every file
        here = f"{beside}/".encode()
        self.assertEqual([str(file) for file in self.files if here in file.read_bytes()], [])

    def test_none_holds_the_marks_of_a_merge(self):
        marks = (b"\n<<<<<<" + b"< ", b"\n>>>>>>" + b"> ")   # in two, for this file is tracked too
        self.assertEqual([str(file) for file in self.files if any(mark in file.read_bytes() for mark in marks)], [])


if __name__ == "__main__":
    unittest.main()
