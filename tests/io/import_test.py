"""Packings that other codes made, read as a user reads them: LAMMPS, LIGGGHTS, MercuryDPM, YADE.

Residuals of forces and torques were computed from the same files by independent scripts; ranges (expected.csv) by
scipy.optimize.linprog (HiGHS).

Arguments: the indet executable, tests/data, apps/exporters/yade_export.py.
"""

import csv
import gzip
import json
import pathlib
import re
import shutil
import sys
import types

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

DATA = EXPORTER = ""
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

    def analyze(self, name="p.h5"):
        shown = json.loads(self.run_indet("--json", "analyze", name, "-o", "r.h5").stdout)
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


class Levers(ImportTest):
    def tried(self, shown):
        return shown["lever_choice"]["tried"]

    def test_the_arm_with_which_torques_balance_is_found(self):
        for arguments, levers, disks, contacts, force, torques in [
                (("lammps", "--format", "lammps", "--friction", "0.3"), NONE, 220, 376, 1.4e-11, {NONE: 1.8e-15}),
                (("lammps-granular", "--format", "lammps", "--friction", "0.3"), PAIRS, 220, 375, 1.4e-11,
                 {PAIRS: 1.1e-14, NONE: 1.4e-3, BOTH: 1.6e-3}),
                (("liggghts", "--format", "liggghts", "--friction", "0.3", "--walls", WALLS, "--gravity", "0,-9.81"),
                 BOTH, 100, 179, 1.9e-12, {BOTH: 4.0e-15, NONE: 6.3e-4}),
                (("yade/soft", "--format", "yade", "--gravity", "0,-9.81"), BOTH, 100, 171, 2.9e-10,
                 {BOTH: 7.9e-11, NONE: 1.3e-3}),
                (("yade/stiff", "--format", "yade", "--gravity", "0,-9.81"), BOTH, 100, 168, 1.7e-8,
                 {BOTH: 1.3e-8, NONE: 2.8e-5}),
        ]:
            with self.subTest(arguments[0]):
                shown = self.read(*arguments)
                self.assertEqual((shown["disks"], shown["contacts"], shown["walls"]), (disks, contacts, 3))
                self.assertEqual(shown["lever_choice"]["levers"], levers)
                self.assertEqual(len(self.tried(shown)), 4)
                self.assertLess(shown["force_residual"], 1.5 * force)
                for choice, residual in torques.items():
                    # The independent scripts show two digits; rounding may differ where nothing but it is left.
                    self.assertLess(self.tried(shown)[choice], max(1.1 * residual, 10 * residual * (residual < 1e-13)))
                    self.assertGreater(self.tried(shown)[choice], 0.1 * residual)
                self.assertAlmostEqual(shown["torque_residual"], self.tried(shown)[levers], delta=1e-14)
                self.assertEqual(shown["coulomb_violations"], 0)
                self.assertEqual(shown["warnings"], [])

    def test_levers_are_those_of_the_overlap(self):
        self.read("lammps-granular", "--format", "lammps", "--friction", "0.3")
        with h5py.File(self.folder / "p.h5") as file:
            radius, gap = file["particles/disks/radius"][:], file["contacts/gap"][:]
            a, b = file["contacts/body_a"][:], file["contacts/body_b"][:]
            pairs = b >= 0
            np.testing.assert_allclose(file["contacts/lever_a"][:][pairs], (radius[a] + gap / 2)[pairs], rtol=1e-15)
            np.testing.assert_allclose(file["contacts/lever_b"][:][pairs], (radius[b] + gap / 2)[pairs], rtol=1e-15)

    def test_all_of_it_is_shown(self):
        done = self.run_indet("import", "--format", "yade", pathlib.Path(DATA, "yade/soft"), "--gravity", "0,-9.81",
                              "-o", "p.h5")
        self.assertIn(f"lever arms          {BOTH} (", done.stdout)
        self.assertRegex(done.stdout, r"pair=radius,wall=radius +1\.3\de-03 mg r")

    def test_what_the_user_says_is_taken(self):
        shown = self.read("lammps-granular", "--format", "lammps", "--friction", "0.3", "--lever", "wall=radius")
        self.assertEqual(set(self.tried(shown)), {NONE, PAIRS})
        self.assertEqual(shown["lever_choice"]["levers"], PAIRS)
        message = self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81", "--lever", "radius", status=3,
                            output="q.h5")
        self.assertIn("the net torque (divided by its radius) is 0.001", message)
        self.assertIn("of 1 choice allowed, --lever pair=radius,wall=radius leaves the smallest torque, 0.0013", message)
        shown = self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81", "--lever", "radius",
                          "--balance-tol", "0.01")
        self.assertEqual(shown["lever_choice"]["levers"], NONE)

    def test_wrong_words_are_wrong_usage(self):
        for words in ["middle", "pair=middle", "disk=radius", "radius,radius", "radius,wall=radius"]:
            message = self.read("yade/soft", "--format", "yade", "--lever", words, status=2)
            self.assertIn("--lever: lever \"", message)

    def test_a_scene_with_levers_of_its_own_needs_none(self):
        scene = program.groove()
        scene["contacts.csv"] = "a,b,lever_a\n0,-1,0.9\n0,-2,0.9\n"
        self.write("p", scene)
        done = self.run_indet("import", "--format", "csv", "p", "--lever", "radius", "-o", "p.h5", status=3)
        self.assertIn("levers of their own", done.stderr)


class RangesOfRealPackings(ImportTest):
    def test_of_liggghts(self):
        self.read("liggghts", "--format", "liggghts", "--friction", "0.3", "--walls", WALLS, "--gravity", "0,-9.81")
        self.assertEqual(self.analyze()["dim"], 58)

    def test_of_yade(self):
        for kind, dim in [("soft", 42), ("stiff", 37)]:
            self.read(f"yade/{kind}", "--format", "yade", "--gravity", "0,-9.81")
            self.assertEqual(self.analyze()["dim"], dim)


class Friction(ImportTest):
    SMOOTH = "lammps-cases/smooth-walls"

    def test_smooth_walls_give_the_ranges_of_the_scene_that_has_them(self):
        for friction in ["disk=0.4,wall=0", "0.4,wall=0", "disk=0.4,wall:wl=0,wall:wr=0,wall:wb=0", "type:1-1=0.4,wall=0",
                         "0.9,wall=0.1,type:1-1=0.4,wall:wl=0,wall:wr=0,wall:wb=0"]:
            with self.subTest(friction):
                shown = self.lammps(self.SMOOTH, friction=friction)
                self.assertEqual(shown["warnings"], [])
                with h5py.File(self.folder / "p.h5") as file:
                    np.testing.assert_array_equal(file["contacts/mu"][:],
                                                  np.where(file["contacts/body_b"][:] < 0, 0, 0.4))
        shown = self.analyze()
        self.assertEqual(shown["dim"], 11)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertAlmostEqual(file["ranges/delta_R"][:].mean(), 3.537, delta=5e-4)
        self.expect_ranges(pathlib.Path(DATA, self.SMOOTH, "scene/expected.csv"))

    def test_smooth_walls_give_the_ranges_of_the_csv_scene(self):
        self.run_indet("import", "--format", "csv", pathlib.Path(DATA, self.SMOOTH, "scene"), "-o", "p.h5")
        self.analyze()
        self.expect_ranges(pathlib.Path(DATA, self.SMOOTH, "scene/expected.csv"))

    def test_friction_that_no_tangential_force_shows_is_a_warning(self):
        warnings = self.lammps(self.SMOOTH)["warnings"]
        self.assertEqual(len(warnings), 3)
        for name, warning in zip(["wb", "wl", "wr"], warnings, strict=True):
            self.assertIn(f"the tangential forces at wall {name} (", warning)
            self.assertIn("are all 0, but the friction there is 0.4", warning)

    def test_it_may_stand_in_a_column_of_pairs(self):
        folder = self.copy(self.SMOOTH)
        lines = (folder / "contacts.dump").read_text().splitlines()
        lines = [line + (" c_mu" if line.startswith("ITEM: ENTRIES") else f" {0.4 + i / 1000}" if i > 8 else "")
                 for i, line in enumerate(lines)]
        (folder / "contacts.dump").write_text("\n".join(lines) + "\n")
        self.lammps(folder, "--columns", "mu=c_mu", friction="wall=0")
        with h5py.File(self.folder / "p.h5") as file:
            pairs = file["contacts/body_b"][:] >= 0
            self.assertEqual(len(set(file["contacts/mu"][:][pairs])), pairs.sum())
            self.assertAlmostEqual(file["contacts/mu"][:].max(), 0.4 + (len(lines) - 1) / 1000)
        self.assertIn("only that of walls can be given",
                      self.lammps(folder, "--columns", "mu=c_mu", friction="0.4", status=3, output="q.h5"))

    def test_of_other_codes_is_in_the_files_unless_it_is_given(self):
        for friction, pair, wall in [((), 0.3, 0.3), (("--friction", "wall=0.2"), 0.3, 0.2),
                                     (("--friction", "0.5,wall:2=0.1"), 0.5, 0.5)]:
            self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81", *friction)
            with h5py.File(self.folder / "p.h5") as file:
                mu, b = file["contacts/mu"][:], file["contacts/body_b"][:]
                names = [name.decode() for name in file["walls/name"][:]]
            np.testing.assert_allclose(mu[b >= 0], pair, rtol=1e-15)
            for i, name in enumerate(names):
                np.testing.assert_allclose(mu[b == -(i + 1)], 0.1 if "wall:2" in str(friction) and name == "2" else wall)

    def test_what_cannot_be(self):
        for friction, message in [("disk=0.4", "contacts: give it with --friction MU or wall=MU"),
                                  ("wall=0", "the friction of atoms"),
                                  ("0.4,wall:lid=0", "there is no wall lid to have a friction; the walls are wb, wl, wr"),
                                  ("0.4,type:1-2=0", "there is no atom of type 2 to have a friction")]:
            shown = self.lammps(self.SMOOTH, friction=friction, status=3)
            self.assertIn(message.removeprefix("contacts: "), shown)
        for friction in ["-1", "nan", "disk", "disk=", "disk=x", "wall:=1", "type:1=0.3", "disk=0.1,disk=0.2", "0.1,0.2"]:
            self.assertIn("--friction: ", self.lammps(self.SMOOTH, friction=friction, status=2))


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

    def test_periodic_contacts_are_refused(self):
        self.assertIn("contacts.dump:19: atoms 12 and 5 push each other, but their surfaces are 3.28 apart; contacts "
                      "across a periodic boundary are not supported", self.lammps("lammps-cases/periodic", status=3))

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
        self.changed(folder / "atoms.dump", ("BOX BOUNDS ff", "BOX BOUNDS xy xz yz ff"))
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

    def test_options_of_other_formats(self):
        self.assertIn("--walls is for --format liggghts", self.lammps(self.PLAIN, "--walls", "wl=x:0", status=2))
        message = self.read("yade/soft", "--format", "yade", "--timestep", "3", status=2)
        self.assertIn("--timestep is for --format lammps, liggghts", message)


class Liggghts(ImportTest):
    ARGUMENTS = ("--format", "liggghts", "--friction", "0.3", "--gravity", "0,-9.81")

    def test_walls_must_be_given(self):
        message = self.read("liggghts", *self.ARGUMENTS, "--walls", "wx2=x:0.055,wy=y:0", status=3)
        self.assertRegex(message, r"atoms.dump:\d+: wall wx1 pushes this atom, but no file says where it is: give its plane "
                                  r"with --walls wx1=x:POSITION")
        message = self.read("liggghts", *self.ARGUMENTS, "--walls", WALLS + ",lid=y:1", status=3)
        self.assertIn("wall lid=y:1 has no columns f_force_lid[1…3]", message)
        self.assertIn("wx1, wx2, wy", message)
        message = self.read("liggghts", *self.ARGUMENTS, "--walls", WALLS.replace("0.055", "0.03"), status=3)
        self.assertRegex(message, r"atoms.dump:\d+: .*; is its plane wx2=x:0.03\?")
        for walls in ["wx1", "wx1=x", "wx1=z:0", "=x:0", "wx1=x:a", "wx1=x:0,wx1=x:1"]:
            self.assertIn("--walls: ", self.read("liggghts", *self.ARGUMENTS, f"--walls={walls}", status=2))

    def test_columns_of_atoms_may_have_other_names(self):
        folder = self.copy("liggghts")
        self.changed(folder / "atoms.dump", (" radius ", " c_r "))
        self.read(folder, *self.ARGUMENTS, "--walls", WALLS, "--columns", "radius=c_r")
        for columns, message in [("fx=c_pl[7]", "fx of LIGGGHTS has its place"), ("wall:wy=f_wy", "are given by --walls")]:
            self.assertIn(message, self.read(folder, *self.ARGUMENTS, "--walls", WALLS, "--columns", columns, status=3,
                                             output="q.h5"))

    def test_bad_dumps(self):
        for name, old, new, message in [
                ("contacts.dump", "1 1 6 0 7.5", "1 1 999 0 7.5", "contacts.dump:10: atom 999 is not in"),
                ("contacts.dump", "1 1 6 0 7.5", "1 1 6.5 0 7.5", "contacts.dump:10: 6.5 is no id of an atom"),
                ("contacts.dump", "1 1 6 0 7.5", "1 1 6 1 7.5", "contacts.dump:10: the contact lies across a periodic"),
                ("contacts.dump", "1 1 6 0 7.5279578711251034 -21.820160577051862 0",
                 "1 1 6 0 7.5279578711251034 -21.820160577051862 1", "contacts.dump:10: the force of c_pl points out of"),
                ("contacts.dump", "c_pl[6]", "other", "contacts.dump:9: column c_NAME[1] is missing"),
                ("atoms.dump", "f_force_wy[3]", "other", "atoms.dump:9: column f_force_wy[3] is missing")]:
            with self.subTest(message):
                folder = self.copy("liggghts")
                self.changed(folder / name, (old, new))
                self.assertIn(message, self.read(folder, *self.ARGUMENTS, "--walls", WALLS, status=3))

    def test_without_walls(self):
        folder = self.copy("liggghts")
        text = (folder / "atoms.dump").read_text()
        (folder / "atoms.dump").write_text(text.replace("f_force_", "f_g"))
        message = self.read(folder, *self.ARGUMENTS, status=3)
        self.assertIn("no wall was read", message)
        self.assertIn("store_force yes", message)


class Yade(ImportTest):
    def test_what_O_save_wrote_is_the_same_packing(self):
        self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81")
        shown = self.read("yade/soft/scene.xml.gz", "--format", "yade", output="q.h5")
        self.assertEqual(shown["gravity"], [0, -9.81])
        self.assertEqual(shown["lever_choice"]["levers"], BOTH)
        self.assertLess(shown["torque_residual"], 1e-9)
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            for item in ["particles/disks/id", "particles/disks/position", "particles/disks/mass", "particles/disks/inertia",
                         "contacts/body_a", "contacts/body_b", "contacts/normal", "contacts/R", "contacts/T",
                         "contacts/mu", "walls/point", "walls/normal"]:
                np.testing.assert_allclose(p[item][()], q[item][()], rtol=1e-15, atol=1e-300, err_msg=item)
            # O.save has no penetration depth; the positions of the next step give the gap.
            np.testing.assert_allclose(p["contacts/gap"][()], q["contacts/gap"][()], rtol=1e-6)

    def test_what_the_exporter_wrote_in_yade(self):
        """20 spheres, exported and saved by YADE 2023.02a at the same time (make_packing.py soft 1e7 20 1 1e-9)."""
        shown = self.read("yade/exported", "--format", "yade")
        self.assertEqual((shown["disks"], shown["walls"], shown["gravity"]), (20, 3, [0, -9.81]))
        self.assertAlmostEqual(shown["force_unit"], 0.007899952098359036, delta=1e-17)
        self.assertEqual(shown["lever_choice"]["levers"], BOTH)
        self.assertLess(shown["force_residual"], 1.5 * 6.888826320219525e-11)
        self.read("yade/exported/scene.xml.gz", "--format", "yade", output="q.h5")
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            for item in ["particles/disks/id", "particles/disks/position", "particles/disks/mass", "particles/disks/inertia",
                         "particles/disks/velocity", "contacts/body_a", "contacts/body_b", "contacts/normal", "contacts/R",
                         "contacts/T", "contacts/mu", "walls/point", "walls/normal"]:
                np.testing.assert_allclose(p[item][()], q[item][()], rtol=1e-15, atol=1e-300, err_msg=item)

    def test_masses_are_those_of_spheres(self):
        shown = self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81")
        self.assertAlmostEqual(shown["force_unit"], 7.755398e-3, delta=1e-9)
        with h5py.File(self.folder / "p.h5") as file:
            disks = file["particles/disks"]
            np.testing.assert_allclose(disks["inertia"][:], 0.4 * disks["mass"][:] * disks["radius"][:] ** 2, rtol=1e-12)

    def scene(self):
        """YADE's O of the soft packing, as far as the exporter looks at it, from the tables of tests/data."""
        def rows(name):
            lines = pathlib.Path(DATA, "yade/soft", name).read_text().splitlines()
            return [line.split() for line in lines if not line.startswith("#")]

        def named(name, **values):
            return type(name, (), values)()

        bodies = []
        for row in rows("bodies.txt"):
            position = [float(field) for field in row[2:5]]
            material = named("FrictMat", id=0)
            if row[1] == "Wall":
                shape = named("Wall", axis=int(row[5][5:]), sense=int(row[6][6:]))
                state = named("State", pos=position, blockedDOFs="xyzXYZ", ori=[0, 0, 0, 1])
            else:
                radius, mass, inertia, vx, vy, wz = (float(field) for field in row[5:11])
                shape = named("Sphere", radius=radius)
                state = named("State", pos=position, mass=mass, inertia=[inertia] * 3, vel=[vx, vy, 0], angVel=[0, 0, wz],
                              blockedDOFs="zXY")
            bodies.append(named("Body", id=int(row[0]), shape=shape, state=state, mat=material))
        interactions = []
        for row in rows("interactions.txt"):
            v = [float(field) for field in row[2:]]
            geom = named("ScGeom", normal=v[0:3], penetrationDepth=v[9])
            phys = named("FrictPhys", normalForce=v[3:6], shearForce=v[6:9], tangensOfFrictionAngle=v[15])
            interactions.append(named("Interaction", id1=int(row[0]), id2=int(row[1]), isReal=True, geom=geom, phys=phys))
        interactions.append(named("Interaction", id1=0, id2=5, isReal=False, geom=None, phys=None))
        newton = named("NewtonIntegrator", gravity=[0, -9.81, 0])
        return types.SimpleNamespace(periodic=False, bodies=[*bodies, None], interactions=interactions,
                                     engines=[named("ForceResetter"), newton])

    def exporter(self):
        module = types.ModuleType("yade_export")
        exec(compile(pathlib.Path(EXPORTER).read_text(), EXPORTER, "exec"), module.__dict__)
        return module

    def test_what_the_exporter_writes_is_the_same_packing(self):
        scene = self.scene()
        self.exporter().export(str(self.folder / "exported"), scene)
        self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81")
        shown = self.read(self.folder / "exported", "--format", "yade", output="q.h5")
        self.assertEqual(shown["gravity"], [0, -9.81])
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])
        scene.bodies[0].shape = type("Facet", (), {})()
        with self.assertRaisesRegex(ValueError, "body 0 is a Facet"):
            self.exporter().export(str(self.folder / "refused"), scene)
        scene.periodic = True
        with self.assertRaisesRegex(ValueError, "periodic"):
            self.exporter().export(str(self.folder / "refused"), scene)
        self.assertNotIn("refused", self.files())

    def test_blocked_spheres_are_fixed(self):
        scene = self.scene()
        scene.bodies[3].state.blockedDOFs = "xyzXYZ"
        self.exporter().export(str(self.folder / "exported"), scene)
        self.assertEqual(self.read(self.folder / "exported", "--format", "yade")["fixed_disks"], 1)
        scene.bodies[3].state.blockedDOFs = "xzXY"
        self.exporter().export(str(self.folder / "exported"), scene)
        message = self.read(self.folder / "exported", "--format", "yade", status=3, output="q.h5")
        self.assertIn("bodies.txt:6: body 3 may not move in some directions of the plane xy", message)

    def test_boxes_are_walls(self):
        """The floor as a box of which only the upper side is touched."""
        scene = self.scene()
        floor = scene.bodies[2]
        self.assertEqual((type(floor.shape).__name__, floor.shape.axis), ("Wall", 1))
        floor.shape = type("Box", (), {"extents": [1, 0.01, 1]})()
        floor.state.pos = [0, -0.01, 0]
        self.exporter().export(str(self.folder / "exported"), scene)
        self.read(self.folder / "exported", "--format", "yade")
        self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81", output="q.h5")
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            for item in ["contacts/R", "contacts/T", "walls/normal"]:
                np.testing.assert_array_equal(p[item][()], q[item][()])
            np.testing.assert_allclose(p["walls/point"][()] @ [0, 1], q["walls/point"][()] @ [0, 1], atol=1e-15)
        floor.state.ori = [0, 0, 0.1, 0.995]
        self.exporter().export(str(self.folder / "exported"), scene)
        self.assertIn("body 2 is a Box that does not push this way",
                      self.read(self.folder / "exported", "--format", "yade", status=3, output="s.h5"))

    def test_bad_tables(self):
        for name, old, new, message in [
                ("bodies.txt", "1 Wall", "0 Wall", "bodies.txt:3: body 0 is given twice"),
                ("bodies.txt", "axis=0 sense=-1", "axis=0", "bodies.txt:3: sense is missing"),
                ("bodies.txt", "3 Sphere", "3 Facet", "bodies.txt:5: body 3 is a Facet; only spheres"),
                ("bodies.txt", "# id", "# number", "bodies.txt:2: a comment line must name the columns first"),
                ("interactions.txt", "6 11 ", "6 911 ", "interactions.txt:2: there is no body 911"),
                ("interactions.txt", "6 11 ", "0 1 ", "interactions.txt:2: bodies 0 and 1 are both walls"),
                ("interactions.txt", "6 11 ", "6 ", "interactions.txt:2: tanphi is missing"),
                ("interactions.txt", "6 11 -0.54", "6 11 x", "interactions.txt:2: nx: \"x"),
                ("interactions.txt", "0.83695478542482427 0 ", "0.83695478542482427 1e-3 ",
                 "interactions.txt:2: the normal points out of the plane xy"),
                ("interactions.txt", "0.83695478542482427", "-0.83695478542482427",
                 "interactions.txt:2: the normal (")]:
            with self.subTest(message):
                folder = self.copy("yade/soft")
                self.changed(folder / name, (old, new))
                if "tanphi is missing" in message:
                    # a row that lacks its first field lacks its last column
                    self.assertRegex(self.read(folder, "--format", "yade", status=3), r"interactions.txt:2: ")
                    continue
                self.assertIn(message, self.read(folder, "--format", "yade", "--gravity", "0,-9.81", status=3))

    def test_bad_archives(self):
        text = gzip.decompress(pathlib.Path(DATA, "yade/soft/scene.xml.gz").read_bytes()).decode()
        for old, new, message in [
                ("</scene>", "", "s.xml:"), ("<scene ", "<scenes ", "s.xml:"),
                ("<id>0</id>", "<id>zero</id>", "id: \"zero\" is not a whole number"),
                ("<isPeriodic>0", "<isPeriodic>no", "isPeriodic: \"no\" is not a whole number"),
                ("<kn>", "<radius>", "s.xml:"),
                ("<interaction class_id=\"84\" tracking_level=\"0\" version=\"0\">\n", "<item><px object_id_reference=\"_x\"/></item>",
                 "there is no object _x"), ("<id1>0</id1>", "<id1>7777</id1>", "there is no body 7777")]:
            with self.subTest(message):
                self.assertIn(old, text)
                spoilt = text.replace(old, new, -1 if old.startswith("<id1>") else 1)
                if old.startswith("<interaction "):
                    spoilt = text.replace(old, old + new, 1)
                (self.folder / "s.xml").write_text(spoilt)
                self.assertRegex(self.read(self.folder / "s.xml", "--format", "yade", status=3), r"s\.xml:\d+: ")
                self.assertIn(message, self.read(self.folder / "s.xml", "--format", "yade", status=3))
        (self.folder / "s.xml").write_text("<a><b/></a>")
        self.assertIn("s.xml:1: this is not a scene of YADE", self.read(self.folder / "s.xml", "--format", "yade", status=3))


class MercuryDpm(ImportTest):
    SQUARE = "mercurydpm/SquarePackingSelfTest.restart"
    MOVING = "mercurydpm/PolydisperseInsertionBoundarySelfTest.restart"

    def test_a_packing_almost_at_rest(self):
        message = self.read(self.SQUARE, "--format", "mercurydpm", status=3)
        self.assertRegex(message, r"on disk \d+ the net force is \S+e-05 mg, above 1e-06 mg")
        shown = self.read(self.SQUARE, "--format", "mercurydpm", "--balance-tol", "1e-3")
        self.assertEqual((shown["disks"], shown["walls"], shown["contacts"]), (25, 1, 25))
        self.assertEqual(shown["gravity"], [0, -1])
        self.assertLess(shown["force_residual"], 1e-4)
        self.assertEqual(shown["torque_residual"], 0)
        with h5py.File(self.folder / "p.h5") as file:
            np.testing.assert_array_equal(file["contacts/mu"][:], 0)
            np.testing.assert_allclose(file["particles/disks/mass"][:], 1)
            np.testing.assert_allclose(file["walls/normal"][:], [[0, 1]], atol=1e-15)
        # Five columns of five disks: the contact k from the top carries k weights, and nothing else can be.
        shown = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "r.h5").stdout)
        self.assertEqual(shown["dim"], 0)
        with h5py.File(self.folder / "r.h5") as file:
            np.testing.assert_allclose(sorted(file["ranges/R_max"][:]), np.repeat([1, 2, 3, 4, 5], 5), rtol=1e-9)

    def test_a_moving_packing_is_refused(self):
        message = self.read(self.MOVING, "--format", "mercurydpm", status=3)
        self.assertIn("there is no gravity", message)
        self.assertIn("--force-unit F", message)
        message = self.read(self.MOVING, "--format", "mercurydpm", "--force-unit", "0.01", status=3)
        self.assertIn("the forces do not balance", message)
        self.assertRegex(message, r"motion: the packing is not at rest; disk \d+ has the kinetic energy")

    def test_signs(self):
        """The forces of contacts and walls sum to the force that the file has of each particle."""
        self.read(self.MOVING, "--format", "mercurydpm", "--force-unit", "0.01", "--balance-tol", "100")
        forces, ids = {}, []
        for line in pathlib.Path(DATA, self.MOVING).read_text().splitlines():
            words = line.split()
            if words and words[0] == "BaseParticle" and "position" in words and not line.startswith(" "):
                at = words.index("force")
                forces[int(words[2])] = [float(word) for word in words[at + 1:at + 3]]
        with h5py.File(self.folder / "p.h5") as file:
            ids = file["particles/disks/id"][:]
            summed = np.zeros((len(ids), 2))
            n = file["contacts/normal"][:]
            force = file["contacts/R"][:][:, None] * n + file["contacts/T"][:][:, None] * np.c_[n[:, 1], -n[:, 0]]
            for a, b, f in zip(file["contacts/body_a"][:], file["contacts/body_b"][:], force, strict=True):
                summed[a] += f
                if b >= 0:
                    summed[b] -= f
        np.testing.assert_allclose(summed, [forces[i] for i in ids], atol=1e-11)

    def test_bad_files(self):
        for old, new, message in [
                ("MercuryDPM 1.0", "Mercury 1.0", "copy.restart:1: this is not a restart file of MercuryDPM"),
                ("Boundaries 0", "Boundaries 1\nPeriodicBoundary id 0 normal 1 0 0",
                 "copy.restart:19: the packing is periodic"),
                ("Particles 25", "Particles 24", "particle 24 is not in"),
                ("particleWallIds 0 2", "particleWallIds 0 9", "copy.restart:46: there is no wall 9"),
                ("particleWallIds 0 2", "particleWallIds 0", "copy.restart:46: particleWallIds must be followed by"),
                ("InfiniteWall id 2", "IntersectionOfWalls id 2", "copy.restart:16: wall 2 is a IntersectionOfWalls"),
                (" radius 0.5", "", "copy.restart:20: radius is missing"),
                (" invMass 1", " invMass one", "copy.restart:20: invMass must be followed by a number"),
                ("Interactions 25", "Interactions 26", "copy.restart: the file ends too early"),
                ("position 0.5 0.499934083168255 0", "position 0.5 0.499934083168255 0.3",
                 "copy.restart:21: particle 1 lies -0.3 off the plane xy of the first one")]:
            with self.subTest(message):
                path = self.folder / "copy.restart"
                shutil.copy(pathlib.Path(DATA, self.SQUARE), path)
                self.changed(path, (old, new))
                self.assertIn(message, self.read(path, "--format", "mercurydpm", status=3))

    def test_fixed_particles_and_old_walls(self):
        path = self.folder / "copy.restart"
        shutil.copy(pathlib.Path(DATA, self.SQUARE), path)
        self.changed(path, (" invMass 1", " invMass 0"),
                     ("position 0 0 0 orientation 0.707106781186548 0 0 -0.707106781186548", "normal 0 -1 0 position 0 0 0"))
        shown = self.read(path, "--format", "mercurydpm", "--balance-tol", "1e-3")
        self.assertEqual((shown["fixed_disks"], shown["contacts"], shown["without_equations"]), (1, 24, 1))

    def test_friction_of_species(self):
        path = self.folder / "copy.restart"
        shutil.copy(pathlib.Path(DATA, self.SQUARE), path)
        self.changed(path, ("dissipation 230.258509299404", "dissipation 230.258509299404 slidingFrictionCoefficient 0.25"))
        self.read(path, "--format", "mercurydpm", "--balance-tol", "1e-3")
        with h5py.File(self.folder / "p.h5") as file:
            np.testing.assert_array_equal(file["contacts/mu"][:], 0.25)


if __name__ == "__main__":
    program.main("DATA", "EXPORTER")
