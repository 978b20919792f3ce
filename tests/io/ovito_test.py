"""What `export --format extxyz` writes, read by ASE and by parsers of our own.

Argument: the indet executable.
"""

import json
import pathlib
import re
import shlex
import sys

import ase.io
import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402


def read_extxyz(path):
    """One frame: a dictionary of the columns that `Properties` names, and one of the other keys."""
    count, comment, *lines = path.read_text().splitlines()
    keys = dict(item.split("=", 1) for item in shlex.split(comment))
    fields = keys.pop("Properties").split(":")
    rows = [line.split() for line in lines]
    assert len(rows) == int(count)
    columns, start = {}, 0
    for name, kind, width in zip(fields[::3], fields[1::3], map(int, fields[2::3]), strict=True):
        part = [row[start:start + width] for row in rows]
        columns[name] = np.array(part, {"S": str, "I": int, "R": float}[kind]).reshape(len(rows), width)
        start += width
    assert all(len(row) == start for row in rows)
    return {name: data[:, 0] if data.shape[1] == 1 else data for name, data in columns.items()}, keys


def read_dump_local(path):
    """One frame: the columns of the entries, and the bounds of the box."""
    text = path.read_text()
    match = re.fullmatch(r"ITEM: TIMESTEP\n(\d+)\nITEM: NUMBER OF ENTRIES\n(\d+)\nITEM: BOX BOUNDS ff ff ff\n"
                         r"((?:\S+ \S+\n){3})ITEM: ENTRIES (.*)\n((?:.*\n)*)", text)
    names = match[4].split()
    rows = np.array([line.split() for line in match[5].splitlines()], float).reshape(-1, len(names))
    assert len(rows) == int(match[2])
    bounds = np.array([line.split() for line in match[3].splitlines()], float)
    return dict(zip(names, rows.T, strict=True)), bounds


class Ovito(program.ProgramTest):
    def test_particles_and_bonds_are_those_of_the_packing(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "12", "--seed", "3", "-o", "p.h5")
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        done = self.run_indet("export", "r.h5", "--format", "extxyz")
        self.assertEqual(done.stdout, "written to r.extxyz and r.bonds.dump\n")
        particles, keys = read_extxyz(self.folder / "r.extxyz")
        bonds, bounds = read_dump_local(self.folder / "r.bonds.dump")
        self.assertEqual(keys["pbc"], "F F F")
        with h5py.File(self.folder / "r.h5") as file:
            position, radius = file["particles/disks/position"][()], file["particles/disks/radius"][()]
            a, b = file["contacts/body_a"][()], file["contacts/body_b"][()]
            mg = file["equilibrium"].attrs["force_unit"]
            n = len(radius)
            np.testing.assert_array_equal(particles["pos"][:n], np.column_stack([position, np.zeros(n)]))
            np.testing.assert_array_equal(particles["radius"][:n], radius)
            np.testing.assert_array_equal(particles["mass"][:n], file["particles/disks/mass"][()])
            np.testing.assert_array_equal(particles["id"][:n], file["particles/disks/id"][()])
            self.assertEqual(len(set(particles["id"])), len(particles["id"]))
            self.assertEqual(set(particles["species"][:n]), {"X"})
            self.assertEqual(set(particles["species"][n:]), {"W"})
            np.testing.assert_allclose(particles["radius"][n:], 0.02 * radius.max())

            row = {identifier: i for i, identifier in enumerate(particles["id"])}
            first = np.array([row[i] for i in bonds["ParticleIdentifiers.A"]])
            second = np.array([row[i] for i in bonds["ParticleIdentifiers.B"]])
            np.testing.assert_array_equal(first, a)
            np.testing.assert_array_equal(second[b >= 0], b[b >= 0])
            np.testing.assert_array_equal(second[b < 0], n + np.arange((b < 0).sum()))
            # A foot is where the normal from the centre meets the wall.
            to_foot = particles["pos"][second[b < 0]] - particles["pos"][first[b < 0]]
            gap = file["contacts/gap"][()][b < 0]
            expected = -(radius[a[b < 0]] + gap)[:, None] * file["contacts/normal"][()][b < 0]
            np.testing.assert_allclose(to_foot[:, :2], expected, atol=1e-12 * radius.max())
            np.testing.assert_array_equal(bonds["index"], 1 + np.arange(len(a)))
            for column in ("R", "T"):
                np.testing.assert_allclose(bonds[f"{column}_mg"], file["contacts"][column][()] / mg, rtol=1e-15)
            for column in ("R_min", "R_max", "T_min", "T_max"):
                np.testing.assert_allclose(bonds[f"{column}_mg"], file["ranges"][column][()] / mg, rtol=1e-15)
            for column in ("delta_R", "delta_T", "d_R", "d_T"):
                np.testing.assert_array_equal(bonds[f"{column}_mg"], file["ranges"][column][()])
            for column in ("R_star", "T_star"):
                np.testing.assert_array_equal(bonds[column], file["ranges"][column][()])
            outcome = file["ranges/outcome"][()]
            for i, column in enumerate(("R_min", "R_max", "T_min", "T_max")):
                np.testing.assert_array_equal(bonds[f"{column}_outcome"], outcome[:, i])
            low = np.min(position - radius[:, None], axis=0)
            self.assertTrue((bounds[:2, 0] <= low).all() and (bounds[:2, 0] >= low - 0.1 * radius.max()).all())
            self.assertTrue((bounds[:2, 1] >= np.max(position + radius[:, None], axis=0)).all())

    def test_states_and_names(self):
        self.run_indet("analyze", self.packing(program.pyramid()), "-o", "r.h5")
        report = json.loads(self.run_indet("export", "r.h5", "--state", "R_max:4", "-o", "a.b.extxyz", "--json").stdout)
        self.assertEqual((report["output"], report["bonds"]), ("a.b.extxyz", "a.b.bonds.dump"))
        bonds, _ = read_dump_local(self.folder / "a.b.bonds.dump")
        np.testing.assert_allclose(bonds["R_mg"][4], bonds["R_max_mg"][4], rtol=1e-15)
        done = self.run_indet("export", "r.h5", "--format", "extxyz", "-o", "/dev/stdout", status=3)
        self.assertIn("/dev/stdout: must end with .extxyz", done.stderr)

    def test_unknown_forces_and_a_packing_without_contacts(self):
        self.packing(program.pyramid())
        self.run_indet("export", "p.h5", "-o", "p.extxyz")
        bonds, _ = read_dump_local(self.folder / "p.bonds.dump")
        self.assertEqual(list(bonds), ["index", "ParticleIdentifiers.A", "ParticleIdentifiers.B", "mu", "gap", "R_mg", "T_mg"])
        self.assertTrue(np.isnan(bonds["R_mg"]).all())
        self.write("l", {"disks.csv": "id,x,y,radius,mass\n7,3,4,0.5,2\n", "contacts.csv": "a,b,mu\n"})
        self.run_indet("import", "--format", "csv", "l", "--balance-tol", "2", "-o", "l.h5")
        self.run_indet("export", "l.h5", "-o", "l.extxyz")
        particles, _ = read_extxyz(self.folder / "l.extxyz")
        self.assertEqual((particles["id"].tolist(), particles["pos"].tolist()), ([7], [[3, 4, 0]]))
        bonds, bounds = read_dump_local(self.folder / "l.bonds.dump")
        self.assertEqual(len(bonds["index"]), 0)
        np.testing.assert_array_equal(bounds, [[2.5, 3.5], [3.5, 4.5], [-0.5, 0.5]])

    def test_fixed_disks_and_levers(self):
        scene = {"disks.csv": "id,x,y,radius,mass,fixed\n0,0,0,1,1,\n5,-1.5,-2.598076211353316,2,3,1\n",
                 "walls.csv": "id,px,py,nx,ny\n0,1,0,-1,0\n",
                 "contacts.csv": "a,b,mu,lever_a,lever_b\n0,5,0.3,0.9,\n0,-1,0.2,,\n"}
        self.packing(scene)
        for _ in range(2):  # known as its own, and replaced
            self.run_indet("export", "p.h5", "-o", "p.extxyz")
        particles, _ = read_extxyz(self.folder / "p.extxyz")
        bonds, _ = read_dump_local(self.folder / "p.bonds.dump")
        self.assertEqual(particles["species"].tolist(), ["X", "F", "W"])
        np.testing.assert_array_equal(bonds["lever_a"], [0.9, 1])
        np.testing.assert_array_equal(bonds["lever_b"], [2, np.nan])

    def test_what_is_replaced(self):
        self.packing(program.pyramid())
        for _ in range(2):
            self.run_indet("export", "p.h5", "-o", "p.extxyz")
            self.run_indet("export", "p.h5", "-o", "p.vtkhdf")
        other = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n0\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ENTRIES c_1[1]\n"
        for name, text in [("p.bonds.dump", other), ("p.extxyz", "1\nProperties=species:S:1:pos:R:3\nX 0 0 0\n")]:
            before = (self.folder / name).read_text()
            (self.folder / name).write_text(text)
            self.assertIn(name, self.run_indet("export", "p.h5", "-o", "p.extxyz", status=3).stderr)
            self.assertEqual((self.folder / name).read_text(), text)
            self.run_indet("export", "p.h5", "-o", "p.extxyz", "--overwrite")
            self.assertEqual((self.folder / name).read_text(), before)

    def test_ase_reads_the_particles(self):
        self.packing(program.pyramid())
        self.run_indet("export", "p.h5", "-o", "p.extxyz")
        atoms = ase.io.read(self.folder / "p.extxyz", format="extxyz")
        self.assertEqual(len(atoms), 5)
        particles, _ = read_extxyz(self.folder / "p.extxyz")
        np.testing.assert_array_equal(atoms.positions, particles["pos"])
        self.assertEqual(atoms.get_chemical_symbols(), particles["species"].tolist())
        for name in ("id", "radius"):
            np.testing.assert_array_equal(atoms.arrays[name], particles[name])
        self.assertFalse(atoms.pbc.any())


if __name__ == "__main__":
    program.main()
