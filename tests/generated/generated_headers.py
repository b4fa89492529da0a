# SPDX-License-Identifier: GPL-3.0-or-later
"""The models of models/, their generated headers in double (as committed) and in float (generated for the test), in parallel."""
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from environment import ALGEST, SOURCE, run

MODELS = sorted(path.stem for path in (SOURCE / "models").glob("*.toml"))
COMPILERS = ("g++", "clang++")
WARNINGS = "-Wall -Wextra -Wconversion -Wpedantic -Wshadow -Werror".split()
FLAGS = ["-std=c++17", "-fno-exceptions", "-fno-rtti", "-ffp-contract=off", f"-I{SOURCE}/runtime/include"]


def class_name(model):
    return "".join(word.capitalize() for word in model.split("_"))


def float_headers(folder):
    """A folder as generated/, in single precision."""
    run(ALGEST, "generate", *sorted((SOURCE / "models").glob("*.toml")), "-o", folder, "--scalar", "float")
    return Path(folder)


def folders(float_folder):
    return {"double": SOURCE / "generated", "float": float_folder}


def of(model, folder):
    """Compiler options that say which model a program of programs/ is about, about what its inputs move by how much, and how many samples they are held."""
    # The servo has to turn, and to turn back; the PMSM's currents have to exceed their noise; operating points have to be steady for two of their
    # blocks of 200, and differ by more than their tolerances; others may divide by an air gap.
    operating_points = (5.0, 4.0, 600)
    middle, size, held = {"servo": (0.0, 1.0, 1), "pmsm_electrical": (2.0, 1.0, 1), "pmsm_sensorless": operating_points,
                          "pmsm_sensorless_voltage": operating_points}.get(model, (2e-3, 1e-3, 1))
    return [f"-I{folder}", f'-DHEADER="{model}/{model}.hpp"', f"-DMODEL={class_name(model)}", f"-DMIDDLE={middle}", f"-DSIZE={size}", f"-DHELD={held}"]


def in_parallel(jobs):
    """Runs (name, function) pairs on all cores; the names of those that failed, with what they said."""
    def guarded(job):
        name, function = job
        try:
            function()
        except AssertionError as error:
            return f"{name}:\n{error}"
        return None
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return [failure for failure in pool.map(guarded, jobs) if failure]


def output(*command):
    """Exit code and all that was printed."""
    result = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    return result.returncode, result.stdout
