"""Dumps of LAMMPS, read as a user reads them.

Argument: the indet executable.
"""

import gzip
import pathlib
import re
import shutil

import h5py
import numpy as np

from importing import DATA, ImportTest, program


class Lammps(ImportTest):
    PLAIN = "lammps-cases/region-box"

    def test_frozen_atoms(self):
        message = self.lammps("lammps-cases/frozen", status=3)
        self.assertIn("on disk 33 the net force is 16.1 mg", message)
        self.assertRegex(message, r"→ fixed disks: --fixed type=2 would leave \d.*e-1\d mg")
        for fixed in ["type=2", "29-34", "29,30,31,32,33-34"]:
            shown = self.lammps("lammps-cases/frozen", "--fixed", fixed)
            self.assertEqual((shown["disks"], shown["fixed_disks"]), (34, 6))
            self.assertLess(shown["force_residual"], 1e-9)
        self.assertEqual(self.analyze()["dim"], 12)
        self.expect_ranges(pathlib.Path(DATA, "frozen-base/expected.csv"))
        for fixed, message in [("type=3", "no atom is fixed by \"type=3\""), ("99", "no atom is fixed by \"99\"")]:
            self.assertIn(message, self.lammps("lammps-cases/frozen", "--fixed", fixed, status=3, output="q.h5"))
        for fixed in ["x", "type=", "5-2", "type=x", "-3"]:
            self.assertIn("--fixed: fixed \"", self.lammps("lammps-cases/frozen", f"--fixed={fixed}", status=2, output="q.h5"))

    def test_compressed_dumps(self):
        packed = self.lammps("lammps-cases/gz")
        folder = self.folder / "plain"
        folder.mkdir()
        for name in ["atoms.dump", "contacts.dump"]:
            (folder / name).write_bytes(gzip.decompress(pathlib.Path(DATA, "lammps-cases/gz", name + ".gz").read_bytes()))
        plain = self.lammps(folder, output="q.h5")
        self.assertEqual(packed["contacts"], plain["contacts"])
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])
        for name in ["atoms.dump", "contacts.dump"]:  # appended to each other, as parallel packers write them
            text = (folder / name).read_bytes()
            (folder / (name + ".gz")).write_bytes(gzip.compress(text[:5000]) + gzip.compress(text[5000:]))
            (folder / name).unlink()
        self.lammps(folder, output="q.h5")
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])
        spoilt = self.folder / "spoilt"
        spoilt.mkdir()
        for name in ["atoms.dump.gz", "contacts.dump.gz"]:
            shutil.copy(pathlib.Path(DATA, "lammps-cases/gz", name), spoilt)
        whole = (spoilt / "contacts.dump.gz").read_bytes()
        (spoilt / "contacts.dump.gz").write_bytes(whole[:-100])
        self.assertIn("contacts.dump.gz: the compressed data end too early", self.lammps(spoilt, status=3, output="s.h5"))
        (spoilt / "contacts.dump.gz").write_bytes(whole[:1000] + b"\xff" * 50 + whole[1050:])
        self.assertIn("contacts.dump.gz: the compressed data are damaged", self.lammps(spoilt, status=3, output="s.h5"))

    def test_several_planes_of_one_fix(self):
        shown = self.lammps(self.PLAIN)
        self.assertEqual((shown["walls"], shown["contacts"]), (3, 48))
        with h5py.File(self.folder / "p.h5") as file:
            self.assertEqual([name.decode() for name in file["walls/name"][:]], ["wl", "wl (2)", "wl (3)"])
            np.testing.assert_array_equal(file["walls/normal"][:], [[0, 1], [1, 0], [-1, 0]])
        self.lammps(self.PLAIN, friction="disk=0.4,wall:wl=0.2")
        with h5py.File(self.folder / "p.h5") as file:
            np.testing.assert_array_equal(file["contacts/mu"][:], np.where(file["contacts/body_b"][:] < 0, 0.2, 0.4))

    def test_missing_walls(self):
        message = self.lammps("lammps-cases/no-wall-columns", status=3)
        self.assertIn("no wall was read", message)
        self.assertIn("the keyword contacts", message)
        self.assertRegex(message, r"→ walls: on the \d+ disks that reach to no side of the packing \S+e-1\d mg is left; "
                                  r"\d+ disks at its sides may lack the force of a wall \(there are no walls at all\)")

    def test_a_floor_that_is_periodic(self):
        """Contacts are with the nearest images; the box is in the dump."""
        shown = self.lammps("lammps-cases/periodic")
        self.assertEqual((shown["walls"], shown["cell"]), (1, {"a": [5, 0], "b": None}))
        self.assertLess(max(shown["force_residual"], shown["torque_residual"]), 1e-9)
        self.assertEqual(shown["gravity"], [0, -1])
        self.expect_simulated_forces_in_ranges()
        with h5py.File(self.folder / "p.h5") as file:
            image, gap = file["contacts/image"][:], file["contacts/gap"][:]
            self.assertGreater(np.count_nonzero(image[:, 0]), 3)
            self.assertFalse(image[:, 1].any())
            self.assertLess(np.abs(gap).max(), 0.01)

    def test_a_box_that_is_periodic_in_both_directions(self):
        """At rest under a pressure of 20; LAMMPS printed pxx = 21.327286, pyy = 18.672714, pxy = 0.19426964."""
        folder = "lammps-periodic"
        arguments = ("--force-unit", "20")
        message = self.lammps(folder, status=3, friction="0.3")
        self.assertIn("there is no gravity", message)
        self.assertRegex(message, r"the pressure times the largest diameter is 19\.\d")
        shown = self.lammps(folder, *arguments, friction="0.3")
        self.assertEqual((shown["disks"], shown["contacts"], shown["gravity"]), (80, 130, [0, 0]))
        self.assertLess(max(shown["force_residual"], shown["torque_residual"]), 1e-9)
        np.testing.assert_allclose(shown["stress_of_forces"], [[21.327286, 0.19426964], [0.19426964, 18.672714]],
                                   rtol=0, atol=5e-7)
        self.assertEqual(set(shown["stress"]), {"xx", "yy", "xy"})
        self.assertLess(shown["stress_residual"], 1e-12)
        ranges = self.expect_simulated_forces_in_ranges()
        self.assertEqual(ranges["status"], "bounded")
        with h5py.File(self.folder / "r.h5") as file:
            wanted = file["ranges/R_max"][:]
            cell = file["particles/disks/box/edges"][:]
        # The same box with another edge: tilted by its own length, and as a general triclinic one.
        copy = self.copy(folder)
        for name in ("atoms.dump", "contacts.dump"):
            lines = (copy / name).read_text().splitlines(keepends=True)
            (low_x, high_x), (low_y, high_y) = (map(float, line.split()) for line in lines[5:7])
            width = high_x - low_x
            for kind, bounds in {"tilted": [f"{low_x!r} {high_x + width!r} {width!r}\n", f"{low_y!r} {high_y!r} 0\n", "-0.5 0.5 0\n"],
                                 "general": [f"{width!r} 0 0 {low_x!r}\n", f"{width!r} {high_y - low_y!r} 0 {low_y!r}\n", "0 0 1 -0.5\n"]}.items():
                (copy / kind).mkdir(exist_ok=True)
                header = "ITEM: BOX BOUNDS " + ("xy xz yz" if kind == "tilted" else "abc origin") + " pp pp pp\n"
                (copy / kind / name).write_text("".join([*lines[:4], header, *bounds, *lines[8:]]))
        for kind in ("tilted", "general"):
            self.lammps(copy / kind, *arguments, friction="0.3")
            self.analyze()
            with h5py.File(self.folder / "r.h5") as file:
                np.testing.assert_allclose(file["particles/disks/box/edges"][:], [cell[0], cell[0] + cell[1]], rtol=1e-14)
                np.testing.assert_allclose(file["ranges/R_max"][:], wanted, rtol=1e-9, atol=1e-9)
        self.assertIn("gravity must be (0, 0)", self.lammps(folder, *arguments, "--gravity=0,-1", friction="0.3", status=3, output="q.h5"))
        self.assertIn("a stress needs a cell that is periodic in both directions",
                      self.lammps("lammps-cases/periodic", "--stress", "pressure=1", status=3, output="q.h5"))

    def test_a_periodic_direction_that_no_contact_crosses(self):
        copy = self.copy(self.PLAIN)
        for name in ("atoms.dump", "contacts.dump"):
            self.changed(copy / name, ("ITEM: BOX BOUNDS ff ff pp", "ITEM: BOX BOUNDS pp pp pp"))
        shown = self.lammps(copy)
        self.assertIsNone(shown["cell"])
        self.assertEqual(shown["gravity"], [0, -1])
        self.assertTrue(any("no contact crosses that boundary" in text for text in shown["warnings"]))

    def expect_simulated_forces_in_ranges(self):
        """Certified throughout; verify finds nothing."""
        shown = self.analyze()
        with h5py.File(self.folder / "r.h5") as file:
            unit = file["equilibrium"].attrs["force_unit"]
            for name in "RT":
                force = file[f"contacts/{name}"][:]
                self.assertGreater((force - file[f"ranges/{name}_min"][:]).min(), -1e-6 * unit)
                self.assertGreater((file[f"ranges/{name}_max"][:] - force).min(), -1e-6 * unit)
        return shown

    def test_the_plane_x_z(self):
        """The same packing with z for y: of the columns and of the contact force, which stands in p1, p3."""
        name = "lammps-cases/xz"
        self.assertIn("column y is missing", self.lammps(name, status=3))
        self.lammps(name, "--plane", "xz")
        folder = self.copy(name)
        text = (folder / "atoms.dump").read_text()
        head = "ITEM: ATOMS id type x y radius mass vx vy " + " ".join(
            f"f_{wall}[{i}]" for wall in ("wl", "wr", "wb") for i in range(1, 9))
        text = re.sub("ITEM: ATOMS .*", head, text)
        text = re.sub(r"(ITEM: BOX BOUNDS) ff pp ff\n(.*)\n(.*)\n(.*)\n", r"\1 ff ff pp\n\2\n\4\n\3\n", text)
        (folder / "atoms.dump").write_text(text)
        self.lammps(folder, output="q.h5")
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])
        self.assertIn("atoms.dump:11: column y: the atom lies at 0.437",
                      self.lammps(folder, "--plane", "xz", "--columns", "z=y,vz=vy", status=3, output="s.h5"))

    def test_headers(self):
        """Of dump_modify units yes, time yes, of triclinic boxes, and of old versions."""
        wanted = self.lammps(self.PLAIN)
        box = ("ITEM: BOX BOUNDS ff ff pp\n0.0000000000000000e+00 5.0000000000000000e+00\n"
               "0.0000000000000000e+00 1.2000000000000000e+01\n-5.0000000000000000e-01 5.0000000000000000e-01\n")
        start = "ITEM: TIMESTEP\n"
        for old, new in [(start, "ITEM: UNITS\nlj\n" + start), (start, "ITEM: TIME\n64\n" + start),
                         (start, "ITEM: UNITS\nlj\nITEM: TIME\n64\n" + start),
                         (box, box.replace(" ff ff pp", "")),
                         (box, "ITEM: BOX BOUNDS xy xz yz ff ff pp\n0 5 0\n0 12 0\n-0.5 0.5 0\n"),
                         (box, "ITEM: BOX BOUNDS abc origin ff ff pp\n5 0 0 0\n0 12 0 0\n0 0 1 -0.5\n")]:
            with self.subTest(new):
                folder = self.copy(self.PLAIN)
                for name in ["atoms.dump", "contacts.dump"]:
                    self.changed(folder / name, (old, new))
                shown = self.lammps(folder, output="q.h5")
                self.assertEqual(shown["warnings"], [])
                with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
                    self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])
        self.assertEqual(wanted["warnings"], [])
        # Components of vectors are no bounds: a box of the vectors (5, 1), (−1, 5) from (−2, −3) reaches to (3, 3).
        folder = self.copy(self.PLAIN)
        self.changed(folder / "atoms.dump", (box, "ITEM: BOX BOUNDS abc origin ff ff pp\n5 1 0 -2\n-1 5 0 -3\n0 0 1 -0.5\n"))
        self.assertRegex(self.lammps(folder)["warnings"][0], r"\d+ atoms are outside the box")

    def test_bad_headers(self):
        for old, new, message in [
                ("ITEM: TIMESTEP\n320000\n", "", "atoms.dump:7: the header of the frame has no ITEM: TIMESTEP"),
                ("ITEM: BOX BOUNDS ff ff pp\n0.0000000000000000e+00", "ITEM: BOX BOUNDS ff ff pp\nzero",
                 "atoms.dump:6: the bounds of the box must be two numbers"),
                ("ITEM: BOX BOUNDS ff", "ITEM: BOX BOUNDS abc origin ff", "atoms.dump:6: an edge vector of the box"),
                (" id type x y", " number type x y", "atoms.dump:9: column id is missing"),
                ("ITEM: TIMESTEP\n", "ITEM: SPEED\n", "atoms.dump:1: ITEM: SPEED is unknown"),
        ]:
            with self.subTest(message):
                folder = self.copy(self.PLAIN)
                self.changed(folder / "atoms.dump", (old, new))
                self.assertIn(message, self.lammps(folder, status=3))
        folder = self.copy(self.PLAIN)
        text = (folder / "atoms.dump").read_text()
        (folder / "atoms.dump").write_text(re.sub("ITEM: ATOMS .*", "ITEM: ATOMS", text))
        self.assertIn("atoms.dump:9: ITEM: ATOMS names no columns", self.lammps(folder, status=3))

    def with_column(self, folder, old, new, change):
        """Renames a column of atoms and changes its values."""
        lines = (folder / "atoms.dump").read_text().splitlines()
        columns = lines[8].split()[2:]
        i = columns.index(old)
        columns[i] = new
        rows = [line.split() for line in lines[9:]]
        for row in rows:
            row[i] = repr(change(float(row[i])))
        lines[8] = "ITEM: ATOMS " + " ".join(columns)
        (folder / "atoms.dump").write_text("\n".join(lines[:9] + [" ".join(row) for row in rows]) + "\n")

    def test_diameters_and_other_coordinates(self):
        self.lammps(self.PLAIN)
        for old, new, change in [("radius", "diameter", lambda r: 2 * r), ("x", "xu", lambda x: x),
                                 ("y", "ys", lambda y: y / 12)]:
            with self.subTest(new):
                folder = self.copy(self.PLAIN)
                self.with_column(folder, old, new, change)
                self.lammps(folder, output="q.h5")
                with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
                    for item in ["particles/disks/radius", "particles/disks/position", "contacts/R"]:
                        np.testing.assert_allclose(p[item][()], q[item][()], rtol=1e-14, err_msg=item)
        folder = self.copy(self.PLAIN)
        self.with_column(folder, "y", "ys", lambda y: y / 12)
        text = (folder / "atoms.dump").read_text()
        text = re.sub(r"BOX BOUNDS (ff .*)\n(.*)\n(.*)\n(.*)\n", r"BOX BOUNDS xy xz yz \1\n\2 0\n\3 0\n\4 0\n", text)
        (folder / "atoms.dump").write_text(text)
        self.assertIn("ys is relative to a tilted box", self.lammps(folder, status=3, output="s.h5"))

    def test_more_columns_of_a_wall(self):
        folder = self.copy(self.PLAIN)
        lines = (folder / "atoms.dump").read_text().splitlines()
        lines = [line + (" f_wl[9]" if i == 8 else " 0.5" if i > 8 else "") for i, line in enumerate(lines)]
        (folder / "atoms.dump").write_text("\n".join(lines) + "\n")
        self.assertEqual(self.lammps(folder)["walls"], 3)

    def test_weightless_packings(self):
        folder = self.folder / "weightless"
        folder.mkdir()
        box = "ITEM: BOX BOUNDS ff ff pp\n0 2\n0 2\n-0.5 0.5\n"
        walls = {"l": (1, 2.5, 0, 0, 0, 1, 0, 1), "r": (1, -2.5, 0, 0, 2, 1, 0, 1)}
        columns = " ".join(f"f_{name}[{i}]" for name in walls for i in range(1, 9))
        values = " ".join(str(value) for wall in walls.values() for value in wall)
        (folder / "atoms.dump").write_text(f"ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1\n{box}"
                                           f"ITEM: ATOMS id x y radius mass {columns}\n1 1 1 1 1 {values}\n")
        (folder / "contacts.dump").write_text(f"ITEM: TIMESTEP\n1\nITEM: NUMBER OF ENTRIES\n0\n{box}ITEM: ENTRIES index "
                                              "c_pp[1] c_pp[2] c_pl[1] c_pl[2] c_pl[3] c_pl[4] c_pl[5] c_pl[6]\n")
        message = self.lammps(folder, "--gravity", "0,0", status=3)
        self.assertIn("atoms.dump: there is no gravity", message)
        self.assertIn("--force-unit F", message)
        shown = self.lammps(folder, "--gravity", "0,0", "--force-unit", "2.5")
        self.assertEqual((shown["force_unit"], shown["force_residual"], shown["walls"]), (2.5, 0, 2))
        self.assertIn("--force-unit", self.lammps(folder, "--force-unit", "0", status=2, output="q.h5"))

    def test_a_wrong_gravity_is_named(self):
        message = self.lammps(self.PLAIN, "--gravity", "0,-2", status=3)
        self.assertRegex(message, r"→ gravity: --gravity 0,-1, which most disks want instead of 0,-2, would leave \S+e-1\d mg")

    def test_the_right_gravity_is_not_proposed(self):
        message = self.lammps("lammps-cases/no-wall-columns", status=3)
        self.assertIn("gravity: most disks want that which was taken, 0,-1\n", message)

    def test_options_of_other_formats(self):
        self.assertIn("--walls is for --format liggghts", self.lammps(self.PLAIN, "--walls", "wl=x:0", status=2))
        message = self.read("yade/soft", "--format", "yade", "--timestep", "3", status=2)
        self.assertIn("--timestep is for --format lammps, liggghts", message)


if __name__ == "__main__":
    program.main()
