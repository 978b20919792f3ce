"""CITATION.cff names the version and the licence of the project. Argument: the folder of the project."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))


class Citation(unittest.TestCase):
    def test_it_is_of_this_version(self):
        entries = dict(re.findall(r"^([\w-]+): (.+)$", (ROOT / "CITATION.cff").read_text(), re.MULTILINE))
        version = re.search(r"project\(indet VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
        self.assertEqual(entries["version"], version)
        self.assertIn(entries["license"], (ROOT / "README.md").read_text())
        self.assertEqual(entries["cff-version"], "1.2.0")


if __name__ == "__main__":
    unittest.main(verbosity=0)
