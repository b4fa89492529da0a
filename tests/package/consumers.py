# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs algest, and builds the user's project in consumer/ against it, in folders that are gone afterwards."""
import shutil
from pathlib import Path

from environment import BUILD, CXX, SOURCE, run


def install(prefix, *components):
    for component in components:
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", component)


def copy_consumer(folder):
    """A copy that may be changed."""
    return Path(shutil.copytree(SOURCE / "tests/package/consumer", Path(folder) / "consumer"))


def build(consumer, *options):
    """Configures and builds; the build folder."""
    folder = consumer / "build"
    run("cmake", "-G", "Ninja", "-S", consumer, "-B", folder, *(options or [f"-DCMAKE_CXX_COMPILER={CXX}"]))
    run("cmake", "--build", folder)
    return folder
