"""Running import, inspect and export as a user does.

Arguments: the indet executable, the LAMMPS dumps, docs/importing.md, the folder with the files of write_samples.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SAMPLES, IMPORTING, DATA, INDET = (sys.argv.pop() for _ in range(4))

DISKS = "id,x,y,radius,mass\n0,0,1,1,1\n1,2,1,1,1\n"
WALLS = "id,px,py,nx,ny\n0,0,0,0,1\n"
CONTACTS = "a,b,mu,R,T\n0,-1,0.3,1,0\n1,-1,0.3,1,0\n1,0,0.3,0,0\n"
SCENE = "gravity = [0, -1]\n"


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_indet(self, *arguments, status=0):
        done = subprocess.run([INDET, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def write_scene(self, **changed):
        texts = {"disks.csv": DISKS, "walls.csv": WALLS, "contacts.csv": CONTACTS, "scene.toml": SCENE}
        scene = self.folder / "scene"
        scene.mkdir(exist_ok=True)
        for name, text in texts.items():
            (scene / name).write_text(changed.get(name.replace(".", "_"), text), errors="surrogateescape")

    def import_lammps(self, *arguments, status=0):
        return self.run_indet("import", "--format", "lammps", "--atoms", f"{DATA}/atoms.dump", "--contacts",
                              f"{DATA}/contacts.dump", *arguments, "-o", "p.h5", status=status)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())
