# SPDX-License-Identifier: GPL-3.0-or-later
"""kill -9 at random moments while algest writes: every file in its place is whole, the old one or the new one."""
import random
import shutil
import signal
import subprocess
import time

from command_line import CommandLine
from environment import ALGEST


class Killed(CommandLine):
    """Two runs that write different bytes to the same places, in turn, each killed at a random moment."""
    times = 0     # set by the test

    def contents(self, folder):
        """File -> bytes; what a killed run left beside a place (.part) is none of its outputs."""
        return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file() and ".part" not in p.name}

    def kill_in_turn(self, first, second, seed):
        """first, second: command lines that write into the folder `out`."""
        out = self.folder / "out"
        wanted, seconds = [], []
        for words in (first, second):
            shutil.rmtree(out, ignore_errors=True)
            begin = time.monotonic()
            self.algest(*words)
            seconds.append(time.monotonic() - begin)
            wanted.append(self.contents(out))
        self.assertNotEqual(wanted[0], wanted[1])
        self.assertEqual(set(wanted[0]), set(wanted[1]))
        moments = random.Random(seed)
        cut_short = 0
        for k in range(self.times):
            duration = seconds[k % 2]
            # files are written in the last moments of a run: every other kill falls there
            moment = moments.uniform(0, 1.3 * duration) if k % 4 < 2 else moments.uniform(0.8 * duration, 1.3 * duration)
            process = subprocess.Popen([ALGEST, *(first, second)[k % 2]], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(moment)
            except subprocess.TimeoutExpired:
                process.kill()
            cut_short += process.wait() == -signal.SIGKILL
            found = self.contents(out)
            self.assertEqual(set(found), set(wanted[0]))
            for name, content in found.items():
                self.assertIn(content, (wanted[0][name], wanted[1][name]), f"{name} is half written after kill {k} at {moment:.4f} s of {duration:.4f} s")
        self.assertGreater(cut_short, self.times // 6)    # six in ten are expected, and a run is as long as the machine is busy
        print(f"{cut_short} of {self.times} runs were killed")

    def kill_generate(self):
        # a window of 20000 samples: the tables are megabytes, so that writing takes a share of the run
        wide = (self.folder / "rl.toml").read_text().replace("window = 0.05", "window = 20")
        self.write("rl.toml", wide)
        self.kill_in_turn(["generate", "rl.toml", "-o", "out"], ["generate", "rl.toml", "-o", "out", "--scalar", "float"], 1)

    def kill_discover(self):
        # noise below which nothing is missing, and an inductance that the voltage balance lacks
        (self.folder / "coil.toml").write_text((self.folder / "rl.toml").read_text().replace('i = { unit = "A" }', 'i = { unit = "A", noise = 1e-4 }'))
        self.kill_in_turn(["discover", "coil.toml", "coil.csv", "-o", "out", "--train", "0:0.12"], ["discover", "coil.toml", "coil.csv", "-o", "out", "--train", "0:0.15"], 2)
