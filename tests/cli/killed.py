# SPDX-License-Identifier: GPL-3.0-or-later
"""kill -9 at random moments, and at each step of writing: every file in its place is whole, the old one or the new one."""
import os
import random
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

from command_line import CommandLine
from environment import ALGEST


class Killed(CommandLine):
    """Two runs that write different bytes to the same places, in turn, each killed at a random moment."""
    times = 0     # set by the test

    def contents(self, folder):
        """File -> bytes; what a killed run left beside a place (.part) is none of its outputs."""
        return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file() and ".part" not in p.name}

    def outputs_of(self, first, second):
        """What the two command lines leave in the folder `out`, and how long they take."""
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
        return wanted, seconds

    def assert_whole(self, wanted, after):
        found = self.contents(self.folder / "out")
        self.assertEqual(set(found), set(wanted[0]))
        for name, content in found.items():
            self.assertIn(content, (wanted[0][name], wanted[1][name]), f"{name} is half written after {after}")

    def kill_at_each_step(self, first, second):
        """As kill_in_turn, at every step of writing that the second takes (kill_at.c)."""
        wanted, _ = self.outputs_of(first, second)
        shim = self.folder / "kill_at.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", shim, Path(__file__).with_name("kill_at.c")], check=True)
        step, killed = 0, 0
        while True:
            step += 1
            self.algest(*first)
            process = subprocess.run([ALGEST, *second], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False,
                                     env={**os.environ, "LD_PRELOAD": str(shim), "KILL_AT": str(step)})
            self.assert_whole(wanted, f"a kill at step {step}")
            if process.returncode != -signal.SIGKILL:
                break
            killed += 1
        self.assertEqual(process.returncode, 0)
        steps = int(re.search(r"steps of writing: (\d+)", process.stderr.decode())[1])
        self.assertEqual(killed, steps)
        self.assertGreaterEqual(steps, 4 * sum(wanted[0][name] != wanted[1][name] for name in wanted[0]))   # two halves, fsync and rename of each file
        print(f"killed at each of {steps} steps")

    def kill_in_turn(self, first, second, seed):
        """first, second: command lines that write into the folder `out`."""
        wanted, seconds = self.outputs_of(first, second)
        out = self.folder / "out"
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
            self.assert_whole(wanted, f"kill {k} at {moment:.4f} s of {duration:.4f} s")
        self.assertGreater(cut_short, self.times // 6)    # six in ten are expected, and a run is as long as the machine is busy
        print(f"{cut_short} of {self.times} runs were killed")

    def kill_generate(self):
        # a window of 20000 samples: the tables are megabytes, so that writing takes a share of the run
        wide = (self.folder / "rl.toml").read_text().replace("window = 0.05", "window = 20")
        self.write("rl.toml", wide)
        self.kill_in_turn(["generate", "rl.toml", "-o", "out"], ["generate", "rl.toml", "-o", "out", "--scalar", "float"], 1)

    def kill_generate_at_each_step(self):
        self.kill_at_each_step(["generate", "rl.toml", "-o", "out"], ["generate", "rl.toml", "-o", "out", "--scalar", "float"])

    def discoveries(self):
        """Noise below which nothing is missing, and an inductance that the voltage balance lacks; over two stretches."""
        (self.folder / "coil.toml").write_text((self.folder / "rl.toml").read_text().replace('i = { unit = "A" }', 'i = { unit = "A", noise = 1e-4 }'))
        return [["discover", "coil.toml", "coil.csv", "-o", "out", "--train", f"0:{end}"] for end in ("0.12", "0.15")]

    def kill_discover(self):
        self.kill_in_turn(*self.discoveries(), 2)

    def kill_discover_at_each_step(self):
        self.kill_at_each_step(*self.discoveries())
