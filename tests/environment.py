# SPDX-License-Identifier: GPL-3.0-or-later
"""What ctest tells a Python test (tests/CMakeLists.txt): paths, the compiler; and how to run a command or to be skipped."""
import os
import subprocess
import sys
from pathlib import Path

ALGEST = Path(os.environ["ALGEST"])
SOURCE = Path(os.environ["ALGEST_SOURCE"])
BUILD = Path(os.environ["ALGEST_BUILD"])
SHARED = Path(os.environ["ALGEST_SHARED"])
CXX = os.environ["CXX"]


def run(*command, **options):
    """Runs a command that must succeed; its standard output. On failure shows everything it printed."""
    result = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
    if result.returncode != 0:
        raise AssertionError(f"exit {result.returncode}: {' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def skip(reason):
    """Ends the whole test; ctest lists it as skipped."""
    print("skipped:", reason)
    sys.exit(77)
