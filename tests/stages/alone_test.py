"""Every source and header of the libraries and the program includes what it uses: it compiles on its own.

Batches of files (docs/decisions/build-time.md) hide an include that is missing. Arguments: the root of the repository,
compile_commands.json, the compiler.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

import includes


def flags(commands):
    """Include folders and definitions of all compilations."""
    found = {}
    for entry in json.loads(commands.read_text()):
        words = shlex.split(entry["command"])
        for word, following in zip(words, words[1:]):
            if word == "-isystem":
                found[word, following] = None
            elif re.match("-[ID].", word):
                found[word,] = None
    return [word for words in found for word in words]


def complaint(compiler, options, path):
    """The first error of a file, empty if it compiles."""
    done = subprocess.run([compiler, "-x", "c++", "-std=c++20", "-fsyntax-only", "-w", *options, path],
                          stderr=subprocess.PIPE, text=True)
    if done.returncode == 0:
        return ""
    return next((line for line in done.stderr.splitlines() if "error" in line), f"{path}: {done.stderr}")


def alone(root):
    """The sources, which begin with their own headers, and the headers that no source begins with."""
    files = [path for path in includes.sources(root, "libindet", "libsim", "apps") if path.suffix in {".h", ".cc"}]
    first = {next((name for _, name in includes.included(root / path)), "") for path in files if path.suffix == ".cc"}
    return [path for path in files if str(path) not in first]


class Alone(unittest.TestCase):
    def test_every_file_compiles_on_its_own(self):
        options = flags(COMMANDS)
        files = alone(ROOT)
        self.assertGreater(len(files), 300)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for said in pool.map(lambda path: complaint(COMPILER, options, ROOT / path), files):
                with self.subTest(said):
                    self.assertEqual(said, "")

    def test_a_missing_include_is_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            header = pathlib.Path(folder, "size.h")
            header.write_text("#pragma once\nstd::string name();\n")
            self.assertIn("size.h:2", complaint(COMPILER, [], header))
            header.write_text("#pragma once\n#include <string>\nstd::string name();\n")
            self.assertEqual(complaint(COMPILER, [], header), "")


if __name__ == "__main__":
    ROOT, COMMANDS, COMPILER = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    del sys.argv[1:4]
    unittest.main(verbosity=0)
