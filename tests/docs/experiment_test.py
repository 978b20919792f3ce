"""The pictures of the paper's experiment in the documents are those that the program makes: simulates and analyzes the 240
packings, and compares the figures. Takes some minutes.

Argument: the indet executable.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from pictures import difference

INDET = pathlib.Path(sys.argv.pop())
IMAGES = pathlib.Path(__file__).parents[2] / "docs/images"


class Experiment(unittest.TestCase):
    def test_the_pictures_are_those_of_the_experiment(self):
        with tempfile.TemporaryDirectory() as folder:
            for command in (["ensemble", "--seeds", "60", "--samples", "0", "--uniform-seeds", "0", "--no-solver-states",
                             "--paper-walk", "0", "-o", folder], ["report", folder]):
                done = subprocess.run([INDET, *command], capture_output=True, text=True, timeout=1700, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
            for shown, made in (("local-indeterminacy", "fig07"), ("ensemble-tilt", "limits-tilt")):
                self.assertIsNone(difference(IMAGES / f"{shown}.svg", pathlib.Path(folder) / f"figures/{made}.svg"))


if __name__ == "__main__":
    unittest.main(verbosity=0)
