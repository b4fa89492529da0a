# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs algest, and builds a user's project, examples/your_project, against it, in folders that are gone afterwards."""
import os
import shutil
from pathlib import Path

from environment import BUILD, CXX, SOURCE, run

FLAGS = "-Wall -Wextra -Wconversion -Werror -fno-exceptions -fno-rtti"


def install(prefix, *components):
    for component in components:
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", component)


def copy_consumer(folder):
    """A copy that may be changed."""
    return Path(shutil.copytree(SOURCE / "examples/your_project", Path(folder) / "consumer"))


def take_from_source(consumer):
    """As its CMakeLists.txt says: a folder of the user's sources in place of what is installed."""
    file = consumer / "CMakeLists.txt"
    text = file.read_text(encoding="utf-8")
    changed = text.replace("find_package(algest REQUIRED)", f"add_subdirectory({SOURCE} algest)")
    if changed == text:
        raise AssertionError("find_package(algest REQUIRED) is not in CMakeLists.txt")
    file.write_text(changed, encoding="utf-8")
    return consumer


def build(consumer, *options, flags=FLAGS):
    """Configures and builds, warnings being errors; the build folder."""
    folder = consumer / "build"
    run("cmake", "-G", "Ninja", "-S", consumer, "-B", folder, *(options or [f"-DCMAKE_CXX_COMPILER={CXX}"]), env={**os.environ, "CXXFLAGS": flags})
    run("cmake", "--build", folder)
    return folder
