# SPDX-License-Identifier: GPL-3.0-or-later
"""What a generator makes of the models of models/, as bytes; and a generator built anew with another compiler."""
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from environment import SOURCE, run, skip

MODELS = sorted((SOURCE / "models").glob("*.toml"))


def files(folder):
    """{path below the folder: bytes}"""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(Path(folder).rglob("*")) if path.is_file()}


def emitted(generator, models=MODELS, scalar="double"):
    """Every file that it generates, and its derivations in all formats."""
    with tempfile.TemporaryDirectory(prefix="algest-test-") as folder:
        run(generator, "generate", *models, "-o", folder, "--scalar", scalar)
        out = {f"{scalar}/{path}": data for path, data in files(folder).items()}
    for model in models:
        for form in ("text", "latex", "json"):
            weights = ["--weights"] if form == "json" else []
            out[f"derive {model.stem} {form}"] = run(generator, "derive", model, "--format", form, *weights).encode()
    return out


def differences(one, other):
    """Names of files that differ or that one of the two lacks."""
    return sorted(path for path in one.keys() | other.keys() if one.get(path) != other.get(path))


def built_generator(compiler, level, folder):
    """Builds the generator alone (generate.cpp) from this source with that compiler and optimisation; its path. Skips without the compiler."""
    path = shutil.which(compiler)
    if path is None:
        skip(f"no {compiler}")
    began = time.monotonic()
    build = Path(folder) / f"{compiler}{level}"
    ninja = ["-G", "Ninja"] if shutil.which("ninja") else []
    # Debug, so that the project's own flags for Release do not follow ours.
    run("cmake", "-S", SOURCE, "-B", build, *ninja, f"-DCMAKE_CXX_COMPILER={path}", "-DCMAKE_BUILD_TYPE=Debug",
        f"-DCMAKE_CXX_FLAGS_DEBUG={level}")
    run("nice", "cmake", "--build", build, "--target", "generate_alone", "--parallel", os.cpu_count() or 1)
    generator = build / "tests" / "generate_alone"
    comment = subprocess.run(["readelf", "-p", ".comment", generator], capture_output=True, text=True, check=False).stdout
    compilers = " / ".join(line.split("]")[-1].strip() for line in comment.splitlines() if "]" in line)
    print(f"{compiler} {level}: built in {time.monotonic() - began:.0f} s; the binary names {compilers}")
    return generator
