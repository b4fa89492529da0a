# SPDX-License-Identifier: GPL-3.0-or-later
"""A full disk, a limit on the size of files, a folder that cannot be written: an error, exit 2, and the old output whole."""
import os
import resource
import signal
import subprocess
import tempfile
import unittest

from command_line import RL_CIRCUIT, CommandLine

NOBODY = 65534
LIMIT = 2048    # bytes: less than any output here


def limited():
    """In the child: no file grows beyond LIMIT, and the write that would says so."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))


class Outputs(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("noisy.toml", RL_CIRCUIT.replace('i = { unit = "A" }', 'i = { unit = "A", noise = 1e-4 }'))

    def commands(self, out):
        """Every command that writes, its outputs in the folder `out`, and its file whose old text must survive."""
        return {
            "generate": (["generate", "rl.toml", "-o", out], f"{out}/rl/rl.hpp"),
            "replay -o": (["replay", "rl.toml", "coil.csv", "-o", f"{out}/e.csv"], f"{out}/e.csv"),
            "replay --report": (["replay", "rl.toml", "coil.csv", "--report", f"{out}/r.html"], f"{out}/r.html"),
            "simulate -o": (["simulate", "rl.toml", "coil.csv", "-o", f"{out}/s.csv"], f"{out}/s.csv"),
            "simulate --report": (["simulate", "rl.toml", "coil.csv", "--report", f"{out}/s.html"], f"{out}/s.html"),
            "discover": (["discover", "noisy.toml", "coil.csv", "-o", out], f"{out}/before.csv"),
        }

    def check_all_fail(self, out, **options):
        for name, (words, file) in self.commands(out).items():
            with self.subTest(command=name):
                path = self.folder / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text("old\n")
                before = self.files_in(out)
                self.shut(out)
                try:
                    _, said = self.algest(*words, exit_code=2, **options)
                finally:
                    self.open(out)
                self.assertRegex(said, r"error: (cannot be (written|made)|no folder that can be written into)")
                self.assertEqual(path.read_text(), "old\n")
                self.assertEqual(self.files_in(out), before)      # nothing half written is left beside it
                path.unlink()

    def files_in(self, out):
        return sorted(str(p) for p in (self.folder / out).rglob("*") if p.is_file())

    def shut(self, out):
        pass

    def open(self, out):
        pass


class NoRoom(Outputs):
    def test_a_limit_on_the_size_of_files(self):
        os.environ["PATH"], kept = "/nowhere", os.environ["PATH"]     # gnuplot could not write either: pages without figures are larger still
        try:
            self.check_all_fail("out", preexec_fn=limited)
        finally:
            os.environ["PATH"] = kept

    def test_a_process_that_the_limit_ends_leaves_the_old_output(self):
        words, file = self.commands("out")["generate"]
        (self.folder / "out/rl").mkdir(parents=True)
        (self.folder / file).write_text("old\n")
        done = subprocess.run([os.environ["ALGEST"], *words], cwd=self.folder, capture_output=True,
                              preexec_fn=lambda: (resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT)), resource.setrlimit(resource.RLIMIT_CORE, (0, 0)),
                                                  signal.signal(signal.SIGXFSZ, signal.SIG_DFL)))
        self.assertEqual(done.returncode, -signal.SIGXFSZ)
        self.assertEqual((self.folder / file).read_text(), "old\n")

    def test_a_full_disk(self):
        disk = tempfile.mkdtemp(dir=self.folder)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", disk], capture_output=True, text=True)
        if mounted.returncode != 0:
            self.skipTest(f"no disk of its own: {mounted.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        name = os.path.basename(disk)
        for command, (words, file) in self.commands(name).items():
            with self.subTest(command=command):
                path = self.folder / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text("old\n")
                filler = self.folder / name / "filler"
                with open(filler, "wb", buffering=0) as file_that_fills:
                    try:
                        while True:
                            file_that_fills.write(bytes(4096))
                    except OSError:
                        pass
                _, said = self.algest(*words, exit_code=2)
                self.assertIn("No space left on device", said)
                self.assertEqual(path.read_text(), "old\n")
                self.assertEqual(self.files_in(name), sorted([str(path), str(filler)]))
                path.unlink()
                filler.unlink()


class ReadOnlyFolder(Outputs):
    """As nobody, where the test runs as root: root writes everywhere."""
    def shut(self, out):
        for folder in sorted((self.folder / out).rglob("*"), reverse=True):
            if folder.is_dir():
                folder.chmod(0o555)
        (self.folder / out).chmod(0o555)

    def open(self, out):
        (self.folder / out).chmod(0o755)
        for folder in sorted((self.folder / out).rglob("*")):
            if folder.is_dir():
                folder.chmod(0o755)

    def test_a_folder_that_cannot_be_written(self):
        self.folder.chmod(0o755)
        as_root = os.geteuid() == 0
        reachable = subprocess.run([os.environ["ALGEST"], "--version"], capture_output=True, preexec_fn=(lambda: os.setuid(NOBODY)) if as_root else None)
        if reachable.returncode != 0:
            self.skipTest("nobody cannot run algest where it lies")
        self.check_all_fail("out", preexec_fn=(lambda: os.setuid(NOBODY)) if as_root else None)


if __name__ == "__main__":
    unittest.main()
