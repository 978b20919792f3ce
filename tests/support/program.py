"""What the tests of the program share: running it in a folder of its own, and small scenes with known answers."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py

INDET = ""


def main(*names):
    """Takes the arguments of the test off the command line (the program first) and runs the tests of the caller."""
    global INDET
    module = sys.modules["__main__"]
    values = sys.argv[1:2 + len(names)]
    del sys.argv[1:2 + len(names)]
    INDET = values[0]
    for name, value in zip(names, values[1:], strict=True):
        setattr(module, name, value)
    unittest.main(verbosity=0)


def run(command, folder, environment=None):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120, check=False,
                          env=environment)


def groove(angle=math.pi / 6, mu=0.3):
    """A disk of radius and weight 1 in a symmetric groove whose normals make `angle` with the vertical:

        δR = μ sin φ / (cos² φ − μ² sin² φ),  δT = μ cos φ / (cos² φ − μ² sin² φ).
    """
    s, c = math.sin(angle), math.cos(angle)
    return {"disks.csv": "id,x,y,radius,mass\n0,0,0,1,1\n",
            "walls.csv": f"id,px,py,nx,ny,name\n0,{-s!r},{-c!r},{s!r},{c!r},left\n1,{s!r},{-c!r},{-s!r},{c!r},right\n",
            "contacts.csv": "a,b\n0,-1\n0,-2\n",
            "scene.toml": f"gravity = [0, -1]\nmu = {mu}\n"}


def incline():
    """One disk on an incline of 30°: it rolls, whatever the friction."""
    scene = groove()
    scene["walls.csv"] = "\n".join(scene["walls.csv"].splitlines()[:2]) + "\n"
    scene["contacts.csv"] = "a,b\n0,-1\n"
    return scene


def pyramid(mu=0.5, forces=None):
    """Two disks side by side on a floor, a third on top: it stands for μ ≥ tan 15° = 0.268.

              2
             0 1
            =====
    """
    bodies = [(0, -1), (1, -1), (1, 0), (2, 0), (2, 1)]
    rows = [f"{a},{b}" for a, b in bodies]
    if forces is not None:
        rows = [f"{row},{R!r},{T!r}" for row, (R, T) in zip(rows, forces, strict=True)]
    header = "a,b" if forces is None else "a,b,R,T"
    return {"disks.csv": f"id,x,y,radius,mass\n0,0,1,1,1\n1,2,1,1,1\n2,1,{1 + math.sqrt(3)!r},1,1\n",
            "walls.csv": "id,px,py,nx,ny,name\n0,0,0,0,1,floor\n",
            "contacts.csv": header + "\n" + "\n".join(rows) + "\n",
            "scene.toml": f"gravity = [0, -1]\nmu = {mu}\n"}


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_indet(self, *arguments, status=0, environment=None):
        done = run([INDET, *map(str, arguments)], self.folder, environment)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def write(self, name, scene):
        folder = self.folder / name
        folder.mkdir()
        for file, text in scene.items():
            (folder / file).write_text(text)
        return folder

    def packing(self, scene, name="p"):
        """Imports a scene to NAME.h5 and returns the file's name."""
        self.write(name, scene)
        self.run_indet("import", "--format", "csv", name, "-o", f"{name}.h5")
        return f"{name}.h5"

    def config_of(self, file, group="provenance"):
        with h5py.File(self.folder / file) as content:
            return content[group].attrs["config"]
