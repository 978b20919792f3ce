"""./run.sh does the main job and leaves what it announces. It builds in build/release of the source folder.

Argument: the source folder.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop())


class RunScript(unittest.TestCase):
    def test_it_ends_with_results_and_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([SOURCE / "run.sh", "--quick", folder], cwd="/", capture_output=True, text=True, timeout=1800,
                                  check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            for part in ["rank 657, nullity 95", "polytope of contact states: bounded",
                         "1504 extrema: 1504 certified, 0 imprecise, 0 failed", " 0 contradictions", "16 packings: 16 computed", "report.html"]:
                self.assertIn(part, done.stdout)
            files = re.findall(r"/\S+\.(?:h5|svg)(?=\s)", done.stdout.partition("results:")[2].partition("== ensemble")[0])
            self.assertEqual(len(files), 3)
            for name in files:
                self.assertTrue(pathlib.Path(name).is_file(), name)


if __name__ == "__main__":
    unittest.main(verbosity=0)
