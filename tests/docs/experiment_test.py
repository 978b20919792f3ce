"""The picture of the paper's experiment in the README is the one that the program makes: simulates and analyzes the 240
packings, and compares the figure. Takes some minutes.

Argument: the indet executable.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from pictures import difference

INDET = pathlib.Path(sys.argv.pop())
SHOWN = pathlib.Path(__file__).parents[2] / "docs/images/local-indeterminacy.svg"


class Experiment(unittest.TestCase):
    def test_the_picture_is_that_of_the_experiment(self):
        with tempfile.TemporaryDirectory() as folder:
            for command in (["ensemble", "--seeds", "60", "--samples", "0", "--uniform-seeds", "0", "--no-solver-states",
                             "--paper-walk", "0", "-o", folder], ["report", folder]):
                done = subprocess.run([INDET, *command], capture_output=True, text=True, timeout=1700, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIsNone(difference(SHOWN, pathlib.Path(folder) / "figures/fig07.svg"))


if __name__ == "__main__":
    unittest.main(verbosity=0)
