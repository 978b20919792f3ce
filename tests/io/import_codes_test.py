"""Packings of LIGGGHTS and YADE, read as a user reads them.

Argument: the indet executable.
"""

import gzip
import json
import pathlib
import shutil
import types

import h5py
import numpy as np

from importing import BOTH, DATA, ImportTest, TESTS, WALLS, program

EXPORTER = str(TESTS.parent / "apps/exporters/yade_export.py")


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
                ("contacts.dump", "c_pl[4]", "other", "contacts.dump:9: column c_pl[4] is missing"),
                ("atoms.dump", "f_force_wy[3]", "other", "atoms.dump:9: column f_force_wy[3] is missing")]:
            with self.subTest(message):
                folder = self.copy("liggghts")
                self.changed(folder / name, (old, new))
                self.assertIn(message, self.read(folder, *self.ARGUMENTS, "--walls", WALLS, status=3))

    def test_the_plane_x_z(self):
        """The same packing with z for y in both dumps; the floor pushes along z alone."""
        folder = self.copy("liggghts")
        for name, pairs in [("atoms.dump", [(" y z ", " z y ")] + [(f"f_force_{w}[2] f_force_{w}[3]", f"f_force_{w}[3] f_force_{w}[2]")
                                                                   for w in ("wx1", "wx2", "wy")]),
                            ("contacts.dump", [("c_pl[5] c_pl[6]", "c_pl[6] c_pl[5]")])]:
            self.changed(folder / name, *pairs)
        message = self.read(folder, *self.ARGUMENTS, "--plane", "xz", "--walls", "wx1=x:0,wx2=x:0.055", status=3)
        self.assertRegex(message, r"atoms.dump:\d+: wall wy pushes this atom, but no file says where it is")
        shown = self.read(folder, *self.ARGUMENTS, "--plane", "xz", "--walls", WALLS.replace("wy=y", "wy=z"))
        self.assertEqual((shown["contacts"], shown["walls"]), (179, 3))
        self.assertLess(shown["force_residual"], 1e-11)

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
        self.assertNotIn("refused", self.files())

    def test_a_periodic_cell(self):
        """Spheres pressed together and sheared by the cell; YADE printed its stress (tension positive, per area of a slice as
        high as the cell)."""
        shown = self.read("yade/periodic", "--format", "yade", "--force-unit", "10")
        self.assertEqual((shown["disks"], shown["walls"], shown["gravity"]), (49, 0, [0, 0]))
        self.assertLess(max(shown["force_residual"], shown["torque_residual"]), 1e-9)
        self.assertGreater(shown["cell"]["b"][0], 0)
        printed = [[3452.255009007130, -368.389173746274], [-368.389173746287, 2708.734558495401]]
        np.testing.assert_allclose(np.array(shown["stress_of_forces"]) / 0.04, printed, rtol=1e-9)
        self.assertEqual(self.analyze()["status"], "bounded")
        with h5py.File(self.folder / "r.h5") as file:
            for name in "RT":
                force = file[f"contacts/{name}"][:]
                self.assertGreater((force - file[f"ranges/{name}_min"][:]).min(), -1e-5)
                self.assertGreater((file[f"ranges/{name}_max"][:] - force).min(), -1e-5)
        # What O.save wrote has no penetration depth; it follows from the positions.
        saved = self.read("yade/periodic/scene.xml.gz", "--format", "yade", "--force-unit", "10", output="q.h5")
        np.testing.assert_allclose(saved["stress_of_forces"], shown["stress_of_forces"], rtol=1e-12)
        copy = self.copy("yade/periodic")
        self.changed(copy / "bodies.txt", ("# cell ", "# cell 1 "))
        self.assertIn("the cell must have nine numbers", self.read(copy, "--format", "yade", "--force-unit", "10", status=3, output="s.h5"))

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
                ("interactions.txt", "6 11 ", "6 ", "interactions.txt:2: there are fewer fields than columns: none is left for tanphi"),
                ("bodies.txt", "3 Sphere 0.0051261621788680403 ", "3 Sphere ", "bodies.txt:5: there are fewer fields than columns: none is left for material"),
                ("interactions.txt", "6 11 -0.54", "6 11 x", "interactions.txt:2: nx: \"x"),
                ("interactions.txt", "0.83695478542482427 0 ", "0.83695478542482427 1e-3 ",
                 "interactions.txt:2: the normal points out of the plane xy"),
                ("interactions.txt", "0.83695478542482427", "-0.83695478542482427",
                 "interactions.txt:2: the normal (")]:
            with self.subTest(message):
                folder = self.copy("yade/soft")
                self.changed(folder / name, (old, new))
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


if __name__ == "__main__":
    program.main()
