"""What the tests of the program share: running it in a folder of its own, and small scenes with known answers."""

import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
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


def content(path):
    """The digest of what a file says, whenever and wherever it was computed."""
    with h5py.File(path) as file:
        return file.attrs["content_sha256"]


def wait_until_under_way(process, number, seconds):
    """Until the program catches the signal and has worked for `seconds` of processor time since then."""
    folder = pathlib.Path(f"/proc/{process.pid}")
    ticks = os.sysconf("SC_CLK_TCK")
    start = None
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        if process.poll() is not None:
            raise AssertionError(f"the program ended before the signal, with status {process.returncode}")
        caught = re.search(r"SigCgt:\s*(\w+)", (folder / "status").read_text())
        if caught and int(caught[1], 16) >> (number - 1) & 1:
            fields = (folder / "stat").read_text().rsplit(")", 1)[1].split()
            spent = int(fields[11]) + int(fields[12])
            start = spent if start is None else start
            if spent - start >= seconds * ticks:
                return
        time.sleep(0.02)
    raise TimeoutError("the program does not get ahead")


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


def between_plates(load, count=1, mu=0, tangential="", floor=""):
    """Disks of weight 1 on a floor, under a plate."""
    disks = "".join(f"{i},{3 * i},1,1,1\n" for i in range(count))
    contacts = "".join(f"{i},-1\n" for i in range(count)) + "".join(f"{i},-2\n" for i in range(count))
    return {"disks.csv": "id,x,y,radius,mass\n" + disks,
            "walls.csv": f"id,px,py,nx,ny,name,load_n,load_t\n0,0,0,0,1,floor,{floor},\n1,0,2,0,-1,plate,{load},{tangential}\n",
            "contacts.csv": "a,b\n" + contacts, "scene.toml": f"gravity = [0, -1]\nmu = {mu}\n"}


def rack(loads=(1, 1, 1)):
    """Three balls of radius 1 in a triangular rack, without friction and weight, under the loads of its three sides:

          2
         0 1        contact 3 i: ball i and the next one; the others: walls
    """
    h = math.sqrt(3)
    centres = [(-1, 0), (1, 0), (0, h)]
    walls, contacts = [], []
    for i in range(3):
        (x1, y1), (x2, y2), (x3, y3) = (centres[(i + k) % 3] for k in range(3))
        x, y = (x1 + x2) / 2, (y1 + y2) / 2
        length = math.hypot(x3 - x, y3 - y)
        nx, ny = (x3 - x) / length, (y3 - y) / length
        walls.append(f"{i},{x - nx!r},{y - ny!r},{nx!r},{ny!r},side{i},{loads[i]}")
        contacts += [f"{i},{(i + 1) % 3}", f"{i},{-1 - i}", f"{(i + 1) % 3},{-1 - i}"]
    return {"disks.csv": "id,x,y,radius,mass\n" + "".join(f"{i},{x!r},{y!r},1,1\n" for i, (x, y) in enumerate(centres)),
            "walls.csv": "id,px,py,nx,ny,name,load_n\n" + "\n".join(walls) + "\n",
            "contacts.csv": "a,b\n" + "\n".join(contacts) + "\n",
            "scene.toml": "gravity = [0, 0]\nmu = 0\nforce_unit = 1\n"}


def plates_at_a_column(count, load, mu):
    """Disks of radius and weight 1 on top of each other on a floor, and a plate on the last; contact k lies below disk k."""
    return {"disks.csv": "id,x,y,radius,mass\n" + "".join(f"{i},0,{2 * i + 1},1,1\n" for i in range(count)),
            "walls.csv": f"id,px,py,nx,ny,name,load_n\n0,0,0,0,1,floor,\n1,0,{2 * count},0,-1,plate,{load}\n",
            "contacts.csv": "a,b\n0,-1\n" + "".join(f"{i},{i - 1}\n" for i in range(1, count)) + f"{count - 1},-2\n",
            "scene.toml": f"gravity = [0, -1]\nmu = {mu}\n"}


def biaxial_box(columns, rows, from_right, from_above, mu):
    """Disks of radius 1 on a square lattice without gravity, between fixed walls at the left and below and pistons at the
    right and above. Contacts: row by row from the left wall to the right one, then column by column from below."""
    disk = [[columns * y + x for x in range(columns)] for y in range(rows)]
    contacts = []
    for y in range(rows):
        contacts += [(disk[y][0], -1)] + [(disk[y][x], disk[y][x - 1]) for x in range(1, columns)] + [(disk[y][-1], -2)]
    for x in range(columns):
        contacts += [(disk[0][x], -3)] + [(disk[y][x], disk[y - 1][x]) for y in range(1, rows)] + [(disk[-1][x], -4)]
    return {"disks.csv": "id,x,y,radius,mass\n" + "".join(f"{disk[y][x]},{2 * x + 1},{2 * y + 1},1,1\n"
                                                          for y in range(rows) for x in range(columns)),
            "walls.csv": f"id,px,py,nx,ny,name,load_n\n0,0,0,1,0,left,\n1,{2 * columns},0,-1,0,right,{from_right!r}\n"
                         f"2,0,0,0,1,below,\n3,0,{2 * rows},0,-1,above,{from_above!r}\n",
            "contacts.csv": "a,b\n" + "".join(f"{a},{b}\n" for a, b in contacts),
            "scene.toml": f"gravity = [0, 0]\nmu = {mu}\nforce_unit = 1\n"}


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
