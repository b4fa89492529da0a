# SPDX-License-Identifier: GPL-3.0-or-later
"""After `cmake --install`: find_package(algest), algest_add_estimator, and what each component holds."""
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from consumers import build, copy_consumer, install
from environment import CXX, SOURCE, run


def files(folder):
    return {str(file.relative_to(folder)) for file in Path(folder).rglob("*") if file.is_file()}


class Installed(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def test_runtime_component_is_headers_licence_and_package(self):
        install(self.folder, "runtime")
        headers = {f"include/algest/{file.name}" for file in (SOURCE / "runtime/include/algest").iterdir()}
        package = {f"share/cmake/algest_runtime/algest_runtimeConfig{end}.cmake" for end in ("", "Version")}
        self.assertEqual(files(self.folder), headers | package | {"share/doc/algest_runtime/LICENSE"})

    def test_host_component_has_no_header(self):
        install(self.folder, "host")
        installed = files(self.folder)
        self.assertIn("bin/algest", installed)
        self.assertIn("share/cmake/algest/algestConfig.cmake", installed)
        self.assertEqual([file for file in installed if file.endswith((".hpp", ".a"))], [])

    def test_consumer_builds_runs_and_follows_its_model(self):
        install(self.folder / "first", "runtime", "host")
        prefix = (self.folder / "first").rename(self.folder / "moved")  # the package can be moved
        consumer = copy_consumer(self.folder)
        folder = build(consumer, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={CXX}")
        run(folder / "controller")
        self.assertIn("no work to do", run("ninja", "-C", folder))

        header = folder / "estimators/coil/series_coil/series_coil.hpp"
        before = header.read_bytes()
        model = consumer / "coil.toml"
        model.write_text(model.read_text().replace("window = 0.1", "window = 0.12"))
        run("ninja", "-C", folder)
        self.assertNotEqual(header.read_bytes(), before)
        run(folder / "controller")

    def test_a_copied_example_is_a_project_of_its_own(self):
        install(self.folder / "prefix", "runtime", "host")
        examples = sorted(file.parent for file in (SOURCE / "examples").glob("*/CMakeLists.txt") if file.parent.name != "your_project")   # which has its model in it
        self.assertGreaterEqual(len(examples), 3)
        for example in examples:
            with self.subTest(example=example.name):
                copied = Path(shutil.copytree(example, self.folder / example.name))
                words = set(re.findall(r"\w+", (example / "CMakeLists.txt").read_text()))
                models = [m for m in (SOURCE / "models").glob("*.toml") if m.stem in words]
                self.assertTrue(models)
                for model in models:
                    shutil.copy(model, copied)
                folder = build(copied, f"-DCMAKE_PREFIX_PATH={self.folder / 'prefix'}", f"-DCMAKE_CXX_COMPILER={CXX}", flags="")   # Boost.Odeint of the simulated machines throws
                self.assertTrue((folder / f"{example.name}_example").is_file())


if __name__ == "__main__":
    unittest.main()
