"""The installed package is complete: what docs/library.md shows builds against it, and finds the right ranges.

Arguments: the build folder, docs/library.md, the C++ compiler.
"""

import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD, DOCUMENT, COMPILER = sys.argv[1:]
del sys.argv[1:]


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=300, check=False,
                          **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = pathlib.Path(folder.name)
        cls.prefix = cls.root / "prefix"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)

    def test_the_program_runs_from_where_it_was_installed(self):
        self.assertTrue(run(self.prefix / "bin/indet", "--version").startswith("indet "))

    def test_what_belongs_to_it_is_there(self):
        installed = {str(path.relative_to(self.prefix)) for path in self.prefix.rglob("*")}
        for part in ["share/bash-completion/completions/indet", "share/doc/indet/LICENSE", "share/doc/indet/README.md",
                     "share/indet/exporters/yade_export.py",
                     "include/libindet/range/analyze.h", "include/libindet/base/version.h"]:
            self.assertIn(part, installed)
        if shutil.which("help2man"):
            self.assertIn("share/man/man1/indet-analyze.1", installed)

    def test_links_between_the_installed_documents_lead_somewhere(self):
        folder = self.prefix / "share/doc/indet"
        documents = [folder / "README.md", *(folder / "docs").rglob("*.md")]
        self.assertGreater(len(documents), 20)
        links = 0
        for document in documents:
            text = re.sub(r"```.*?```", "", document.read_text(), flags=re.DOTALL)
            for target in re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'<(?:img|a)\b[^>]*(?:src|href)="([^"]+)"', text):
                if "://" in target or target.startswith("#"):
                    continue
                links += 1
                self.assertTrue((document.parent / target.partition("#")[0]).exists(), f"{document}: {target}")
        self.assertGreater(links, 50)

    def test_the_target_indet_makes_all_that_is_installed(self):
        """So that `cmake --install` works after ./run.sh, which builds nothing else."""
        def ninja(*command):
            return run("ninja", "-C", BUILD, *command).splitlines()
        made = {line.rpartition(": ")[0] for line in ninja("-t", "targets", "all")}
        of_indet = {"indet", *ninja("-t", "inputs", "indet")}
        taken = set()
        for script in pathlib.Path(BUILD).rglob("cmake_install.cmake"):
            taken.update(re.findall(re.escape(BUILD) + r'/([^"]+)"', script.read_text()))
        taken &= made
        self.assertGreater(len(taken), 10)
        self.assertEqual(taken - of_indet, set())

    def test_nothing_of_this_machine_is_in_the_package(self):
        for path in self.prefix.rglob("*.cmake"):
            self.assertNotIn(str(pathlib.Path(BUILD).resolve()), path.read_text(), path)

    def test_the_program_of_the_documentation_builds_and_is_right(self):
        project = self.root / "project"
        project.mkdir()
        blocks = re.findall(r"```\w+\n((?:#|//) (\S+)\n.*?)```", pathlib.Path(DOCUMENT).read_text(), re.DOTALL)
        self.assertEqual([name for _, name in blocks], ["CMakeLists.txt", "groove.cc"])
        for text, name in blocks:
            (project / name).write_text(text)
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_CXX_COMPILER={COMPILER}", *launcher)
        run("cmake", "--build", project / "build")
        output = run(project / "build/groove", env=os.environ)
        values = {name: float(value) for name, value in re.findall(r"(δ[RT]) = ([\d.e+-]+)", output)}
        angle, mu = math.pi / 6, 0.3
        down = math.cos(angle) ** 2 - (mu * math.sin(angle)) ** 2
        self.assertAlmostEqual(values["δR"], mu * math.sin(angle) / down, delta=1e-12)
        self.assertAlmostEqual(values["δT"], mu * math.cos(angle) / down, delta=1e-12)


if __name__ == "__main__":
    unittest.main(verbosity=0)
