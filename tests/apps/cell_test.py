"""Periodic cells as a user meets them: files, results with known answers, messages.

Arguments: the indet executable.
"""

import json
import math
import pathlib
import re
import sys

import h5py
import numpy as np
import scipy.optimize

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import lattice  # noqa: E402
import program  # noqa: E402

ISOTROPIC = "xx = {0}\nyy = {0}\nxy = 0"


class LinearProgram:
    """The ranges of a packing in a full cell by SciPy, from the datasets of its file alone."""

    def __init__(self, file):
        self.mu = file["contacts/mu"][:]
        a, b = file["contacts/body_a"][:], file["contacts/body_b"][:]
        normal = file["contacts/normal"][:]
        position, radius = file["particles/disks/position"][:], file["particles/disks/radius"][:]
        edges = file["particles/disks/box/edges"][:]
        stress = dict(file["stress"].attrs)
        tangent = np.column_stack([normal[:, 1], -normal[:, 0]])
        branch = position[a] - position[b] - file["contacts/image"][:] @ edges
        lever = {side: file[f"contacts/lever_{side}"][:] if f"contacts/lever_{side}" in file
                 else np.full(len(a), np.nan) for side in "ab"}
        disks, contacts = len(position), len(a)
        rows = np.zeros((3 * disks, 2 * contacts))
        for c in range(contacts):
            for side, disk, sign in (("a", a[c], 1), ("b", b[c], -1)):
                arm = lever[side][c] if np.isfinite(lever[side][c]) else radius[disk]
                for k in (0, 1):
                    rows[3 * disk + k, 2 * c] += sign * normal[c, k]
                    rows[3 * disk + k, 2 * c + 1] += sign * tangent[c, k]
                rows[3 * disk + 2, 2 * c + 1] += arm / radius[disk]
        area = abs(np.linalg.det(edges))
        load = [0.0] * len(rows)
        for name, (i, j) in {"xx": (0, 0), "yy": (1, 1), "xy": (0, 1)}.items():
            if np.isnan(stress[name]):
                continue
            row = np.empty(2 * contacts)
            row[0::2] = normal[:, i] * branch[:, j]
            row[1::2] = tangent[:, i] * branch[:, j]
            rows, load = np.vstack([rows, row]), [*load, area * stress[name]]
        self.scale = np.abs(load).max()
        # Strengths of the edges of each cone: R = p + q, T = μ (p − q).
        columns = np.empty_like(rows)
        columns[:, 0::2] = rows[:, 0::2] + self.mu * rows[:, 1::2]
        columns[:, 1::2] = rows[:, 0::2] - self.mu * rows[:, 1::2]
        self.columns, self.load = columns, np.array(load) / self.scale

    def extremum(self, contact, component, sense):
        cost = np.zeros(self.columns.shape[1])
        cost[2 * contact:2 * contact + 2] = (1, 1) if component == "R" else (self.mu[contact], -self.mu[contact])
        solved = scipy.optimize.linprog(-sense * cost, A_eq=self.columns, b_eq=self.load, method="highs-ds",
                                        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10})
        assert solved.status == 0, solved.message
        return -sense * solved.fun * self.scale


class Cell(program.ProgramTest):
    def analyze(self, packing, *arguments, status=0):
        return json.loads(self.run_indet("--json", "analyze", packing, "-o", "r.h5", *arguments, status=status).stdout)

    def verify(self, *arguments):
        shown = json.loads(self.run_indet("--json", "verify", *arguments, "r.h5").stdout)
        self.assertEqual(shown["contradictions"], 0)
        return shown

    def ranges(self, name):
        with h5py.File(self.folder / "r.h5") as file:
            return file[f"ranges/{name}"][:]

    # The force network ensemble of Snoeijer, Vlugt, van Hecke and van Saarloos, Phys. Rev. Lett. 92, 054302 (2004), on
    # frictionless triangular lattices of diameter 1.

    def test_one_disk_has_one_network_of_isotropic_stress(self):
        """Its three contacts are with images of itself. A = √3/2 and Σ R n̂ n̂ᵀ = A p 1 over the directions 0°, 60° and
        120°, where Σ n̂ n̂ᵀ = 3/2: each R is p/√3."""
        shown = self.analyze(self.packing(lattice.scene(1, 1, ISOTROPIC.format(2))))
        self.assertEqual((shown["status"], shown["dim"], shown["equations"]), ("point", 0, 5))
        for name in ("R_min", "R_max"):
            np.testing.assert_allclose(self.ranges(name), 2 / math.sqrt(3), rtol=1e-14)
        self.verify("--exact")

    def test_at_a_pressure_alone_the_forces_of_one_disk_are_a_simplex(self):
        """Σ R / 2 = A p: R_1 + R_2 + R_3 = √3 p. The ranges are [0, √3 p], and uniformly R has the density
        2 (1 − R/S)/S with S = √3 p: mean S/3, deviation S/√18."""
        packing = self.packing(lattice.scene(1, 1, "pressure = 2"))
        shown = self.analyze(packing)
        self.assertEqual((shown["status"], shown["dim"]), ("bounded", 2))
        total = 2 * math.sqrt(3)
        np.testing.assert_allclose(self.ranges("R_min"), 0, atol=1e-12)
        np.testing.assert_allclose(self.ranges("R_max"), total, rtol=1e-14)
        self.verify("--exact")
        drawn = json.loads(self.run_indet("--json", "sample", "--method", "uniform", packing, "--states", "2000",
                                          "-o", "s.h5").stdout)
        self.assertEqual(drawn["stopped_by"], "convergence")
        with h5py.File(self.folder / "s.h5") as file:
            states = file["sampling/states"][:, 0::2]
        np.testing.assert_allclose(states.sum(axis=1), total, rtol=1e-12)
        error = total / math.sqrt(18) / math.sqrt(drawn["ess"])
        np.testing.assert_allclose(states.mean(axis=0), total / 3, atol=5 * error)
        # Each decile of the distribution, 1 − (1 − R/S)², holds a tenth, to five binomial deviations.
        deciles = np.floor(10 * (1 - (1 - states / total) ** 2)).astype(int).clip(0, 9)
        for contact in range(3):
            shares = np.bincount(deciles[:, contact], minlength=10) / len(states)
            np.testing.assert_allclose(shares, 0.1, atol=5 * 0.3 / math.sqrt(min(len(states), drawn["ess"])))
        self.run_indet("verify", "s.h5")

    def test_two_disks_share_what_one_direction_bears(self):
        """Rows of two disks, a = (2, 0): R is p/√3 along 0° and 120°, of each of the two contacts. The two contacts along
        60° are with images of the disks themselves; their sum is 2p/√3, so that each has the range [0, 2p/√3], and
        uniformly its deviation is that range over √12."""
        packing = self.packing(lattice.scene(2, 1, ISOTROPIC.format(2)))
        shown = self.analyze(packing)
        self.assertEqual((shown["status"], shown["dim"], shown["expected_dim"]), ("bounded", 1, 2 * 6 - 6 - 3 + 2))
        each = 2 / math.sqrt(3)
        for contact, (_, _, _, direction) in enumerate(lattice.contacts(2, 1)):
            low, high = (0, 2 * each) if direction == 1 else (each, each)
            self.assertAlmostEqual(self.ranges("R_min")[contact], low, delta=1e-12)
            self.assertAlmostEqual(self.ranges("R_max")[contact], high, delta=1e-12)
        self.verify("--exact")
        drawn = json.loads(self.run_indet("--json", "sample", "--method", "uniform", packing, "-o", "s.h5").stdout)
        self.assertAlmostEqual(drawn["r"], math.sqrt(2) * 2 * each / math.sqrt(12), delta=5 * drawn["r_error"])

    def test_a_lattice_has_one_dimension_a_disk(self):
        """3N forces, 2N − 2 independent equations of force and 3 of stress: N − 1. By translation and rotation all
        contacts have the same range."""
        for columns, rows in ((3, 3), (4, 4)):
            packing = self.packing(lattice.scene(columns, rows, ISOTROPIC.format(1)), name=f"p{columns}")
            shown = self.analyze(packing)
            self.assertEqual((shown["dim"], shown["failed"], shown["imprecise"]), (columns * rows - 1, 0, 0))
            np.testing.assert_allclose(self.ranges("R_min"), 0, atol=1e-10)
            np.testing.assert_allclose(self.ranges("R_max"), self.ranges("R_max")[0], rtol=1e-10)
            # One line may bear all of its direction, and no contact more than the sum over its direction.
            self.assertGreaterEqual(self.ranges("R_max")[0], columns / math.sqrt(3) - 1e-10)
            self.assertLess(self.ranges("R_max")[0], columns * rows / math.sqrt(3))
            self.verify()

    def test_friction_agrees_with_scipy(self):
        for columns, rows, mu, stress in ((2, 2, 0.3, "xx = 1\nyy = 1.2\nxy = 0.1"), (4, 3, 0.5, ISOTROPIC.format(1)),
                                          (3, 3, 0.2, "xx = 1\nyy = 1")):
            with self.subTest(columns=columns, rows=rows):
                name = f"p{columns}{rows}"
                shown = self.analyze(self.packing(lattice.scene(columns, rows, stress, mu), name=name))
                self.assertEqual(shown["certified"], 4 * 3 * columns * rows)
                with h5py.File(self.folder / f"{name}.h5") as file:
                    program_of = LinearProgram(file)
                for contact in range(3 * columns * rows):
                    for component in "RT":
                        for end, sense in (("min", -1), ("max", 1)):
                            self.assertAlmostEqual(self.ranges(f"{component}_{end}")[contact],
                                                   program_of.extremum(contact, component, sense), delta=1e-9)
                self.verify()

    def test_units_do_not_matter(self):
        scenes = {"p": lattice.scene(2, 2, ISOTROPIC.format(1), 0.3),
                  "q": lattice.scene(2, 2, ISOTROPIC.format(1e6), 0.3, force_unit=3)}
        values = []
        for name, scene in scenes.items():
            self.assertEqual(self.analyze(self.packing(scene, name=name))["certified"], 48)
            values.append(self.ranges("R_max"))
        np.testing.assert_allclose(values[1], 1e6 * values[0], rtol=1e-9)

    def test_what_cannot_stand_shows_how_the_cell_moves(self):
        """Contacts push only, so that no stress but a compression can be borne: the cell grows against a tension."""
        for stress, moves in (("xx = 1\nyy = -1", (1, 1)), ("pressure = -1", (0, 0))):
            name = f"p{len(stress)}"
            shown = self.analyze(self.packing(lattice.scene(2, 2, stress, 0.3), name=name), status=4)
            self.assertEqual(shown["status"], "empty")
            rate = np.array(shown["cell_motion"])
            self.assertLess(rate[moves], 0)
            self.verify("--exact")
            with h5py.File(self.folder / "r.h5") as file:
                np.testing.assert_array_equal(file["equilibrium/cell_motion"][:], rate)
            self.assertIn("the cell shrinks", self.run_indet("analyze", f"{name}.h5", "-o", "r.h5", status=4).stdout)

    def test_a_scene_of_one_direction_has_walls(self):
        """A row of disks on a floor, periodic along x: each bears its weight, and rows of the same force R ≥ 0 run along
        it without limit."""
        scene = {"disks.csv": "id,x,y,radius,mass\n0,0,1,1,1\n1,2,1,1,1\n2,4,1,1,1\n",
                 "walls.csv": "id,px,py,nx,ny\n0,0,0,0,1\n",
                 "contacts.csv": "a,b,image_x,image_y\n0,1,0,0\n1,2,0,0\n2,0,1,0\n0,-1,,\n1,-1,0,0\n2,-1,,\n",
                 "scene.toml": "mu = 0\n[cell]\na = [6, 0]\n"}
        shown = self.analyze(self.packing(scene))
        self.assertEqual((shown["status"], shown["dim"]), ("unbounded", 1))
        np.testing.assert_array_equal(self.ranges("R_max")[:3], np.inf)
        np.testing.assert_allclose(self.ranges("R_max")[3:], 1, rtol=1e-14)
        self.verify("--exact")

    def test_files_hold_the_cell(self):
        scene = lattice.scene(2, 1, "xx = 2\nxy = 0.5", 0.3)
        self.packing(scene)
        with h5py.File(self.folder / "p.h5") as file:
            self.assertEqual(list(file.attrs["schema_version"]), [2, 0])
            box = file["particles/disks/box"]
            self.assertEqual(list(box.attrs["boundary"]), ["periodic", "periodic"])
            np.testing.assert_array_equal(box["edges"][:], [[2, 0], lattice.DIAGONAL])
            self.assertEqual((file["stress"].attrs["xx"], file["stress"].attrs["xy"]), (2, 0.5))
            self.assertTrue(np.isnan([file["stress"].attrs[name] for name in ("yy", "pressure")]).all())
            np.testing.assert_array_equal(file["contacts/image"][:], [image for _, _, image, _ in lattice.contacts(2, 1)])
        self.run_indet("export", "p.h5", "--format", "csv", "-o", "copy")
        self.run_indet("import", "--format", "csv", "copy", "-o", "q.h5")
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])
        self.run_indet("export", "p.h5", "--format", "csv", "-o", "copy")  # it knows its own files
        shown = self.run_indet("inspect", "p.h5").stdout
        self.assertIn("periodic cell     (2, 0), (0.5, 0.866025)", shown)
        self.assertIn("imposed stress    xx = 2, xy = 0.5", shown)
        # Where no stress is imposed the written scene says so.
        self.packing(lattice.scene(2, 1, None, 0.3), name="free")
        self.run_indet("export", "free.h5", "--format", "csv", "-o", "free-copy")
        self.assertIn('stress = "none"\n', (self.folder / "free-copy/scene.toml").read_text())
        self.run_indet("import", "--format", "csv", "free-copy", "-o", "q.h5")
        with h5py.File(self.folder / "free.h5") as p, h5py.File(self.folder / "q.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])

    def test_images_that_are_not_given_are_the_nearest(self):
        scene = lattice.scene(3, 3, ISOTROPIC.format(1))
        self.packing(scene)
        scene["contacts.csv"] = "a,b\n" + "".join(f"{a},{b}\n" for a, b, _, _ in lattice.contacts(3, 3))
        self.packing(scene, name="q")
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "q.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])

    def test_the_stress_of_known_forces_is_taken(self):
        scene = lattice.scene(2, 1, None)
        forces = {0: 1.5, 1: 0.5, 2: 1.0}  # by direction
        lines = scene["contacts.csv"].splitlines()
        lines = [lines[0] + ",R"] + [f"{line},{forces[direction]}" for line, (_, _, _, direction)
                                     in zip(lines[1:], lattice.contacts(2, 1), strict=True)]
        scene["contacts.csv"] = "\n".join(lines) + "\n"
        self.write("p", scene)
        area = math.sqrt(3)
        xx = (2 * 1.5 + 2 * 0.5 / 4 + 2 * 1.0 / 4) / area
        yy = 0.75 * (2 * 0.5 + 2 * 1.0) / area
        xy = math.sqrt(3) / 4 * (2 * 0.5 - 2 * 1.0) / area
        shown = json.loads(self.run_indet("--json", "import", "--format", "csv", "p", "-o", "p.h5").stdout)
        np.testing.assert_allclose(shown["stress_of_forces"], [[xx, xy], [xy, yy]], rtol=1e-14)
        self.assertEqual(shown["stress"], {"xx": shown["stress_of_forces"][0][0], "yy": shown["stress_of_forces"][1][1],
                                           "xy": shown["stress_of_forces"][0][1]})
        self.assertLess(shown["stress_residual"], 1e-15)
        for option, stress in (("none", {}), ("pressure=1.5", {"pressure": 1.5}), ("xx=1,xy=0.1", {"xx": 1, "xy": 0.1})):
            done = self.run_indet("--json", "import", "--format", "csv", "p", "--stress", option, "-o", "p.h5")
            self.assertEqual(json.loads(done.stdout)["stress"], stress)
            self.assertEqual("do not make the stress" in done.stderr, option != "none")
        text = self.run_indet("import", "--format", "csv", "p", "-o", "p.h5").stdout
        self.assertIn("periodic cell       (2, 0), (0.5, 0.866025)\n", text)
        self.assertIn(f"stress of forces    xx = {xx:.6g}, yy = {yy:.6g}, xy = {xy:.6g}\n", text)
        self.assertIn("(that of the forces)\n", text)
        (self.folder / "p/scene.toml").write_text(scene["scene.toml"] + "[stress]\nxx = 1\n")
        self.assertIn("p: --stress: the files say which stress is imposed",
                      self.run_indet("import", "--format", "csv", "p", "--stress", "none", "-o", "q.h5", status=3).stderr)
        for option in ("xx", "zz=1", "xx=1,xx=2", "pressure=1,xx=1", "xx=inf", "yx=1"):
            self.assertIn("--stress: ", self.run_indet("import", "--format", "csv", "p", "--stress", option, "-o", "q.h5",
                                                       status=2).stderr)

    def test_what_takes_no_cells_says_so(self):
        scene = lattice.scene(2, 1, ISOTROPIC.format(1), 0.3)
        scene["contacts.csv"] = re.sub(r"(\d)$", rf"\1,{1 / math.sqrt(3)!r},0", scene["contacts.csv"], flags=re.M)
        scene["contacts.csv"] = scene["contacts.csv"].replace("image_y", "image_y,R,T")
        self.packing(scene)
        for arguments in (("sample", "--method", "perturb", "p.h5"), ("simulate", "--protocol", "md1", "--from", "p.h5", "-o", "q.h5")):
            message = self.run_indet(*arguments, status=3).stderr
            self.assertIn("takes no periodic scenes", message)
            self.assertIn("--method uniform", message)
        self.assertFalse((self.folder / "q.h5").exists())

    def test_bad_scenes_are_refused(self):
        good = lattice.scene(2, 2, ISOTROPIC.format(1))
        toml, contacts, disks = good["scene.toml"], good["contacts.csv"], good["disks.csv"]
        walls = "id,px,py,nx,ny\n0,0,0,0,1\n"
        for file, text, message in (
                ("scene.toml", toml.replace("a = [2, 0]", "a = [0, 0]"), "scene.toml:4: cell: a must not be (0, 0)"),
                ("scene.toml", toml.replace("a = [2, 0]", "a = [2]"), "scene.toml:5: a must be a list of two numbers"),
                ("scene.toml", toml.replace("a = [2, 0]", "c = [2, 0]"), "scene.toml:5: c of the cell is unknown"),
                ("scene.toml", toml.replace("a = [2, 0]", "a = [0.5, 0.8660254037844386]"), "scene.toml:4: cell: its two vectors are parallel"),
                ("scene.toml", toml.replace("gravity = [0, 0]", "gravity = [0, -1]"), "scene.toml:4: cell: the scene is periodic in both"),
                ("scene.toml", toml + "pressure = 1\n", "scene.toml:7: stress: the pressure is (xx + yy)/2"),
                ("scene.toml", toml + "yx = 1\n", "scene.toml:11: yx of the stress is unknown"),
                ("scene.toml", toml.replace("xx = 1", "xx = inf"), "scene.toml:8: xx must be finite"),
                ("scene.toml", toml.replace("a = [2, 0]\n", ""), "scene.toml:6: stress: a stress needs a cell that is periodic in both"),
                ("walls.csv", walls, "walls.csv:2: a scene that is periodic in both directions has no walls"),
                ("disks.csv", disks.replace("mass\n", "mass,fixed\n").replace("0.5,1\n", "0.5,1,1\n"), "scene.toml:7: stress: a stress cannot be imposed on a cell with fixed disks"),
                ("disks.csv", disks.replace("mass\n", "mass,fx\n").replace("0.5,1\n", "0.5,1,1\n"), "disks.csv: in a cell that is periodic in both directions nothing takes the loads of disks"),
                ("contacts.csv", contacts.replace("0,1,0,0", "0,1,0,"), "contacts.csv:2: image_x and image_y must both be given"),
                ("contacts.csv", contacts.replace("0,1,0,0", "0,1,0.5,0"), "contacts.csv:2: column image_x"),
                ("contacts.csv", contacts.replace("0,1,0,0", "0,1,7,0"), "contacts.csv:2: disk 0 and disk 1 are 14 apart"),
                ("contacts.csv", contacts.replace("0,1,0,0", "0,0,0,0"), "contacts.csv:2: disk 0 cannot touch itself; which image of it is not given"),
                ("contacts.csv", contacts + "1,0,0,0\n", "contacts.csv:14: this contact is given twice, first in line 2")):
            with self.subTest(message=message):
                scene = dict(good)
                scene[file] = text
                folder = f"bad{len(self.files())}"
                self.write(folder, scene)
                self.assertIn(message, self.run_indet("import", "--format", "csv", folder, "-o", "bad.h5", status=3).stderr)
        self.assertFalse((self.folder / "bad.h5").exists())

    def test_pictures_and_other_programs(self):
        """The contacts across the boundary are drawn at both sides, and their images have points in VTK."""
        self.packing(lattice.scene(3, 3, ISOTROPIC.format(1)))
        across = sum(image != (0, 0) for _, _, image, _ in lattice.contacts(3, 3))
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        self.run_indet("export", "r.h5", "--style", "delta-R", "-o", "r.svg")
        svg = (self.folder / "r.svg").read_text()
        self.assertEqual(svg.count("stroke:rgb(35%,20%,55%)"), 4, "the sides of the cell")
        self.assertEqual(svg.count("stroke-linecap:round"), 27 + across + 1, "contacts, and the colour bar")
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(len(file["VTKHDF/Points"]), 9 + across)
            points, ends = file["VTKHDF/Points"][:], file["VTKHDF/Connectivity"][:].reshape(-1, 2)
            np.testing.assert_allclose(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1), 1, rtol=1e-14)
        self.verify()
        self.run_indet("export", "r.h5", "--format", "extxyz", "-o", "r.extxyz")
        lines = (self.folder / "r.extxyz").read_text().splitlines()
        self.assertEqual(int(lines[0]), 9 + across)
        self.assertIn('pbc="T T F" Lattice="3 0 0 1.5 2.598076211353316 0 0 0 1"', lines[1])
        self.assertEqual(sum(line.startswith("I ") for line in lines), across)
        self.run_indet("export", "r.h5", "--format", "extxyz", "-o", "r.extxyz")  # it knows its own files
        self.run_indet("export", "r.h5", "-o", "contacts.csv")
        self.assertIn(",mu,image_x,image_y,R_mg", (self.folder / "contacts.csv").read_text().splitlines()[0])


if __name__ == "__main__":
    program.main()
