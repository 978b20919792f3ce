"""Packings under pistons, whose force networks are known: in closed form, or by SciPy's linear programs.

Argument: the indet executable.
"""

import json
import math
import pathlib
import sys

import h5py
import numpy as np
from scipy.optimize import linprog

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

NAMES = ("R_min", "R_max", "T_min", "T_max")


def ranges_by_scipy(path):
    """[M, 4] minima and maxima of R and T, and {(body, component): (minimum, maximum)} of ΣR and ΣT at walls, in the
    scene's units, by HiGHS, from the packing in the file:

        each disk    Σ ±(R n̂ + T t̂) = −m g − load,   Σ r T = −torque     t̂ = (n_y, −n_x)
        each piston  ΣR = load_n, ΣT = load_t, where given
        each contact R ≥ 0, |T| ≤ μR
    """
    with h5py.File(path) as file:
        disks, contacts = file["particles/disks"], file["contacts"]
        radius, mass, load = disks["radius"][:], disks["mass"][:], disks["load"][:]
        gravity = file["parameters"].attrs["gravity"]
        a, b, n, mu = (contacts[name][:] for name in ("body_a", "body_b", "normal", "mu"))
        pushed = file["walls/load"][:] if "walls/load" in file else np.full((len(file["walls/id"]), 2), np.nan)
    count, m = len(radius), len(a)
    A = np.zeros((3 * count, 2 * m))
    for i in range(m):
        force = np.array([[n[i, 0], n[i, 1]], [n[i, 1], -n[i, 0]]]).T  # of R, of T
        for body, side in ((a[i], 1), (b[i], -1)):
            if body >= 0:
                A[3 * body:3 * body + 2, 2 * i:2 * i + 2] += side * force
                A[3 * body + 2, 2 * i + 1] += radius[body]
    right = -(load + np.column_stack([np.outer(mass, gravity), np.zeros(count)])).ravel()

    def sum_at(wall, component):
        row = np.zeros(2 * m)
        row[component::2] = b == -1 - wall
        return row

    for wall, component in np.argwhere(np.isfinite(pushed)):
        A = np.vstack([A, sum_at(wall, component)])
        right = np.append(right, pushed[wall, component])
    cone = np.zeros((2 * m, 2 * m))
    for i in range(m):
        cone[2 * i:2 * i + 2, 2 * i:2 * i + 2] = [[-mu[i], 1], [-mu[i], -1]]
    bounds = [(0, None), (None, None)] * m

    def extremum(objective, sign):
        found = linprog(-sign * objective, A_ub=cone, b_ub=np.zeros(2 * m), A_eq=A, b_eq=right, bounds=bounds, method="highs")
        assert found.status in (0, 3), found.message
        return sign * math.inf if found.status == 3 else objective @ found.x

    unit = np.eye(2 * m)
    table = np.array([[extremum(unit[2 * i + k // 2], -1 + 2 * (k % 2)) for k in range(4)] for i in range(m)])
    sums = {(-1 - wall, component): tuple(extremum(sum_at(wall, component), sign) for sign in (-1, 1))
            for wall in range(len(pushed)) for component in (0, 1)}
    return table, sums


class Pressed(program.ProgramTest):
    def analyzed(self, scene, name):
        """[M, 4] ranges and {(body, component): (minimum, maximum)} of a scene, all of them certified and proven."""
        self.packing(scene, name)
        shown = json.loads(self.run_indet("--json", "analyze", f"{name}.h5", "-o", f"{name}.r.h5").stdout)
        self.assertEqual(shown["certified"], shown["objectives"])
        proven = json.loads(self.run_indet("--json", "verify", "--exact", f"{name}.r.h5").stdout)
        self.assertEqual((proven["contradictions"], proven["exact"]["contradictions"]), (0, 0))
        with h5py.File(self.folder / f"{name}.r.h5") as file:
            group = file["reactions"]
            sums = {(int(b), int(c)): tuple(v) for b, c, v in zip(group["body"][:], group["component"][:], group["value"][:])}
            return np.column_stack([file["ranges"][column][:] for column in NAMES]), sums, shown

    def assert_same_as_scipy(self, name, table, sums):
        expected, expected_sums = ranges_by_scipy(self.folder / f"{name}.r.h5")
        scale = max(1, np.abs(expected[np.isfinite(expected)]).max())
        np.testing.assert_allclose(table, expected, rtol=0, atol=1e-9 * scale)
        for place, ends in sums.items():
            np.testing.assert_allclose(ends, expected_sums[place], rtol=0, atol=1e-9 * scale)

    def test_a_column_between_plates_is_determined(self):
        """Contact k bears the plate's load P and the N − k disks above it: R = P + N − k. T is the same at all contacts by
        balance of forces, and of alternating sign by that of torques: T = 0."""
        count, load = 4, 2.5
        for mu in (0.0, 0.3):
            table, sums, shown = self.analyzed(program.plates_at_a_column(count, load, mu), f"c{mu}")
            self.assertEqual((shown["status"], shown["dim"]), ("point", 0))
            R = load + count - np.arange(count + 1)
            np.testing.assert_allclose(table, np.column_stack([R, R, 0 * R, 0 * R]), rtol=1e-13, atol=1e-13)
            np.testing.assert_allclose(sums[-1, 0], load + count, rtol=1e-13)
            np.testing.assert_allclose(sums[-2, 0], load, rtol=1e-13)

    def test_a_plate_on_a_row_of_disks(self):
        """Each of N disks takes any share of the load P, with friction as without: R of the plate in [0, P], R of the floor
        in [w, w + P]; dim F = N − 1."""
        for mu in (0.0, 0.3):
            table, sums, shown = self.analyzed(program.between_plates(2.5, 3, mu), f"r{mu}")
            self.assertEqual((shown["status"], shown["dim"]), ("bounded", 2))
            np.testing.assert_allclose(table[:, 0], [1] * 3 + [0] * 3, atol=1e-13)
            np.testing.assert_allclose(table[:, 1], [3.5] * 3 + [2.5] * 3, atol=1e-13)
            np.testing.assert_allclose(sums[-1, 0], 5.5, rtol=1e-13)
            self.assert_same_as_scipy(f"r{mu}", table, sums)

    def test_a_biaxial_box_without_friction(self):
        """Each of the rows carries any share of the load from the right, R in [0, load] at all of its contacts, and columns
        likewise: dim F = rows − 1 + columns − 1."""
        columns, rows, right, above = 3, 2, 2.0, 0.5
        table, sums, shown = self.analyzed(program.biaxial_box(columns, rows, right, above, 0), "b")
        self.assertEqual((shown["status"], shown["dim"]), ("bounded", rows + columns - 2))
        in_rows = rows * (columns + 1)
        np.testing.assert_allclose(table[:, 0], 0, atol=1e-13)
        np.testing.assert_allclose(table[:in_rows, 1], right, rtol=1e-13)
        np.testing.assert_allclose(table[in_rows:, 1], above, rtol=1e-13)
        for wall, load in ((-1, right), (-2, right), (-3, above), (-4, above)):
            np.testing.assert_allclose(sums[wall, 0], load, rtol=1e-13)
        self.assert_same_as_scipy("b", table, sums)

    def test_a_biaxial_box_with_friction(self):
        """Bounded, equal to SciPy, and proportional to the loads: what holds of F holds of λF."""
        one, sums, shown = self.analyzed(program.biaxial_box(3, 3, 1.0, 2.0, 0.4), "one")
        self.assertEqual(shown["status"], "bounded")
        self.assertGreater(shown["dim"], 4)
        self.assert_same_as_scipy("one", one, sums)
        many, many_sums, _ = self.analyzed(program.biaxial_box(3, 3, 7.0, 14.0, 0.4), "many")
        np.testing.assert_allclose(many, 7 * one, rtol=1e-9, atol=1e-9)
        for place, ends in sums.items():
            np.testing.assert_allclose(many_sums[place], 7 * np.array(ends), rtol=1e-9, atol=1e-9)

    def test_a_rack_at_fixed_pressure(self):
        """Three balls under the load L of each of three sides (Snoeijer et al., cond-mat/0407027). A wall pushes ball i by
        w_i at one side and w_i' at the other; balance leaves the forces f_1, f_2, f_3 between balls free but for their sum,
        which follows from L by virtual work of a contraction: f_1 + f_2 + f_3 = (√3/2) L. So f_i is in [0, (√3/2) L], the
        mean is ⟨f⟩ = L/(2√3), and the flat measure on that triangle is, in units of ⟨f⟩,

            P(f) = 2/3 (1 − f/3) on 0 … 3,   share below f: 1 − (1 − f/3)²,   standard deviation 1/√2.

        The loads cancel, so that two of them follow from the third: two walls are held."""
        load = 1.5
        self.write("rack", program.rack((load,) * 3))
        done = self.run_indet("import", "--format", "csv", "rack", "-o", "rack.h5")
        self.assertEqual(done.stderr.count("this wall is held instead"), 2)
        self.run_indet("analyze", "rack.h5", "-o", "rack.r.h5")
        self.run_indet("verify", "--exact", "rack.r.h5")
        mean = load / (2 * math.sqrt(3))
        with h5py.File(self.folder / "rack.r.h5") as file:
            self.assertEqual(file["equilibrium"].attrs["dim"], 2)
            np.testing.assert_allclose(file["ranges/R_max"][::3], 3 * mean, rtol=1e-12)
            np.testing.assert_allclose(file["ranges/R_min"][::3], 0, atol=1e-12)
            np.testing.assert_allclose(file["reactions/value"][:], load, rtol=1e-9)  # of the held walls too
        self.run_indet("sample", "rack.h5", "--method", "uniform", "--effective", "4000", "-o", "rack.s.h5")
        with h5py.File(self.folder / "rack.s.h5") as file:
            np.testing.assert_allclose(file["sampling/center"][::6], mean, rtol=0.05)
            np.testing.assert_allclose(file["sampling/deviation"][::6], mean / math.sqrt(2), rtol=0.05)
            levels = file["sampling/quantile_levels"][:]
            for quantiles in file["sampling/quantiles"][::6]:
                np.testing.assert_allclose(quantiles, 3 * mean * (1 - np.sqrt(1 - levels)), atol=0.08 * mean)
        self.run_indet("verify", "rack.s.h5")

    def test_pistons_made_of_large_disks(self):
        """Before walls could be loaded, people made pistons of disks of 1000 radii between guides. Here they press four
        disks from above and from the right, with 10 each, and two walls hold them. One of the forces was not found once."""
        scene = {"disks.csv": "id,x,y,radius,mass,fx,fy\n0,1,1,1,1,0,0\n1,3,1,1,1,0,0\n2,1,3,1,1,0,0\n3,3,3,1,1,0,0\n"
                              "4,2,1004,1000,1,0,-10\n5,1004,2,1000,1,-10,0\n",
                 "walls.csv": "id,px,py,nx,ny\n0,0,0,0,1\n3,0,0,1,0\n4,-998,0,1,0\n5,1002,0,-1,0\n6,0,-998,0,1\n7,0,1002,0,-1\n",
                 "contacts.csv": "a,b,mu\n0,1,\n2,3,\n2,0,\n3,1,\n0,-1,\n1,-1,\n0,-4,\n2,-4,\n4,2,0\n4,3,0\n5,1,0\n5,3,0\n"
                                 "4,-5,0\n4,-6,0\n5,-7,0\n5,-8,0\n",
                 "scene.toml": "gravity = [0, 0]\nmu = 0.3\nforce_unit = 1\n"}
        table, sums, _ = self.analyzed(scene, "p")
        self.assert_same_as_scipy("p", table, sums)


if __name__ == "__main__":
    program.main()
