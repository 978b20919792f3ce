"""Reading packings that other codes made, as a user does.

Residuals of forces and torques were computed from the same files by independent scripts; ranges (expected.csv) by
scipy.optimize.linprog (HiGHS).
"""

import csv
import json
import pathlib
import shutil
import sys

import h5py
import numpy as np

TESTS = pathlib.Path(__file__).parent.parent
sys.path.insert(0, str(TESTS / "support"))
import program  # noqa: E402

DATA = str(TESTS / "data")
WALLS = "wx1=x:0,wx2=x:0.055,wy=y:0"
BOTH = "pair=mid-overlap,wall=mid-overlap"
PAIRS = "pair=mid-overlap,wall=radius"
NONE = "pair=radius,wall=radius"


class ImportTest(program.ProgramTest):
    def read(self, name, *arguments, status=0, output="p.h5"):
        """Imports files of tests/data (or of the test's folder, by a full path): two dumps, or one input."""
        path = pathlib.Path(DATA, name)
        gz = ".gz" if (path / "atoms.dump.gz").exists() else ""
        files = ([f"--atoms={path}/atoms.dump{gz}", f"--contacts={path}/contacts.dump{gz}"]
                 if (path / f"atoms.dump{gz}").exists() else [path])
        done = self.run_indet("--json", "import", *files, *arguments, "-o", output, status=status)
        if status != 0:
            self.assertNotIn(output, self.files())
            self.assertEqual(done.stdout, "")
            return done.stderr
        return json.loads(done.stdout)

    def lammps(self, name, *arguments, friction="0.4", status=0, output="p.h5"):
        return self.read(name, "--format", "lammps", "--friction", friction, *arguments, status=status, output=output)

    def copy(self, name):
        """A copy of a folder of tests/data that the test may spoil."""
        return pathlib.Path(shutil.copytree(pathlib.Path(DATA, name), self.folder / "copy", dirs_exist_ok=True))

    def changed(self, file, *replacements):
        text = file.read_text()
        for old, new in replacements:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        file.write_text(text)

    def analyze(self, name="p.h5", contacts="all"):
        shown = json.loads(self.run_indet("--json", "analyze", name, "--contacts", contacts, "-o", "r.h5").stdout)
        self.assertEqual(shown["certified"], shown["objectives"])
        self.assertEqual(json.loads(self.run_indet("--json", "verify", "r.h5").stdout)["contradictions"], 0)
        return shown

    def expect_ranges(self, expected):
        """Compares r.h5 with a table of ranges, contacts by the ids of their bodies (b negative for walls)."""
        lines = [line for line in pathlib.Path(expected).read_text().splitlines() if not line.startswith("#")]
        rows = {(int(row["a"]), int(row["b"])): row for row in csv.DictReader(lines)}
        with h5py.File(self.folder / "r.h5") as file:
            ids = file["particles/disks/id"][:]
            bodies = zip(file["contacts/body_a"][:], file["contacts/body_b"][:], strict=True)
            keys = [(int(ids[a]), int(ids[b]) if b >= 0 else int(b)) for a, b in bodies]
            keys = [key if key in rows else key[::-1] for key in keys]  # R and T are the same seen from b
            self.assertEqual(set(keys), set(rows))
            for column in ("R_min", "R_max", "T_min", "T_max"):
                wanted = [float(rows[key][column]) for key in keys]
                np.testing.assert_allclose(file[f"ranges/{column}"][:], wanted, atol=1e-9, err_msg=column)
