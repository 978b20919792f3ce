"""Bounds of single forces: columns of contacts.csv, and --condition around known forces.

Argument: the indet executable. Independent answers: closed forms, and scipy.optimize.linprog (HiGHS) on equations
written here once more.
"""

import csv
import json
import math
import pathlib
import shutil
import sys

import h5py
import numpy as np
from scipy.optimize import linprog

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

KEYS = ("R_lo", "R_hi", "T_lo", "T_hi")


def groove(bounds, angle=math.pi / 6, mu=0.3):
    """program.groove with bounds of the contact with the left wall, a dictionary by KEYS."""
    scene = program.groove(angle, mu)
    fields = ",".join(str(bounds.get(key, "")) for key in KEYS)
    scene["contacts.csv"] = f"a,b,{','.join(KEYS)}\n0,-1,{fields}\n0,-2,,,,\n"
    return scene


class Problem:
    """A F = b, |T| ≤ μ R and the bounds of a file, in the scene's units, for linprog."""

    def __init__(self, path):
        with h5py.File(path) as file:
            disks, contacts = file["particles/disks"], file["contacts"]
            n, m = len(disks["id"]), len(contacts["R"])
            gravity = file["parameters"].attrs["gravity"]
            radius, mass = disks["radius"][:], disks["mass"][:]
            self.A, self.b = np.zeros((3 * n, 2 * m)), np.zeros(3 * n)
            for i in range(n):
                self.b[3 * i:3 * i + 2] = -mass[i] * gravity
            for k in range(m):
                nx, ny = contacts["normal"][k]
                for body, sign in ((contacts["body_a"][k], 1), (contacts["body_b"][k], -1)):
                    if body < 0:
                        continue
                    self.A[3 * body:3 * body + 3, 2 * k] = sign * nx, sign * ny, 0
                    self.A[3 * body:3 * body + 3, 2 * k + 1] = sign * ny, -sign * nx, radius[body]
            self.mu = contacts["mu"][:]
            self.known = np.column_stack([contacts["R"][:], contacts["T"][:]]).ravel()
            self.mg = file["parameters"].attrs["mg"]
            limits = contacts["bounds"][:] if "bounds" in contacts else np.tile([-np.inf, np.inf] * 2, (m, 1))
        self.limits = [(max(0, row[0]), row[1]) if k == 0 else (row[2], row[3]) for row in limits for k in (0, 1)]
        self.cone = np.zeros((2 * m, 2 * m))
        for k in range(m):
            self.cone[2 * k, 2 * k:2 * k + 2] = -self.mu[k], 1
            self.cone[2 * k + 1, 2 * k:2 * k + 2] = -self.mu[k], -1

    def extremum(self, component, sign):
        cost = np.zeros(len(self.limits))
        cost[component] = -sign
        found = linprog(cost, A_ub=self.cone, b_ub=np.zeros(len(self.cone)), A_eq=self.A, b_eq=self.b,
                        bounds=self.limits, method="highs")
        return found.x[component] if found.status == 0 else None

    def least_relaxation(self, error):
        """min t with |F − known| ≤ error + t for all forces, in mg. Multiplied by 1e6 for the solver's tolerances."""
        size = len(self.limits)
        scale = 1e6
        identity, ones = np.eye(size), np.ones((size, 1))
        zeros = np.zeros((len(self.cone), 1))
        upper = np.block([[self.cone, zeros], [identity, -ones], [-identity, -ones]])
        right = np.concatenate([-self.cone @ self.known, np.full(2 * size, error * self.mg)]) * scale
        found = linprog(np.append(np.zeros(size), 1), A_ub=upper, b_ub=right,
                        A_eq=np.hstack([self.A, np.zeros((len(self.A), 1))]),
                        b_eq=(self.b - self.A @ self.known) * scale, bounds=[(None, None)] * size + [(0, None)])
        return found.x[-1] / scale / self.mg


class Bounds(program.ProgramTest):
    def ranges(self, file):
        with h5py.File(self.folder / file) as content:
            return np.column_stack([content[f"ranges/{name}"][:] for name in ("R_min", "R_max", "T_min", "T_max")])

    def analyze(self, packing, *arguments, status=0):
        shown = json.loads(self.run_indet("--json", "analyze", packing, "-o", "r.h5", "--overwrite", *arguments,
                                          status=status).stdout)
        checked = json.loads(self.run_indet("--json", "verify", "--exact", "r.h5").stdout)
        self.assertEqual(checked["contradictions"], 0)
        return shown

    def test_a_groove_has_the_closed_form(self):
        # By symmetry R_1 = R_2 =: R and T_1 = −T_2 =: T (signs of the two tangents), R cos φ + T sin φ = 1/2: one
        # bound on R or T of the left contact cuts the segment |T| ≤ μ R there.
        s, c, mu = 0.5, math.sqrt(0.75), 0.3
        free = sorted(0.5 / (c + sign * mu * s) for sign in (1, -1))
        for bounds, expected in (({"R_hi": 0.6}, (free[0], 0.6)), ({"R_lo": 0.55}, (0.55, free[1])),
                                 ({"R_lo": 0.55, "R_hi": 0.6}, (0.55, 0.6)), ({"R_lo": -2}, free),
                                 ({"R_lo": 0.57, "R_hi": 0.57}, (0.57, 0.57))):
            self.packing(groove(bounds), "p")
            shown = self.analyze("p.h5")
            self.assertEqual(shown["certified"], 8)
            self.assertEqual(shown["dim"], 0 if expected[0] == expected[1] else 1)
            table = self.ranges("r.h5")
            for row in table:  # both contacts
                np.testing.assert_allclose(row[:2], expected, rtol=1e-13)
                np.testing.assert_allclose(sorted(abs(row[2:])), sorted(abs((0.5 - R * c) / s) for R in expected),
                                           atol=1e-13)
            with h5py.File(self.folder / "r.h5") as file:
                self.assertEqual(list(file.attrs["schema_version"]), [2, 0])
            shutil.rmtree(self.folder / "p")

    def test_a_bound_of_a_tangential_force(self):
        self.packing(groove({"T_lo": -0.01, "T_hi": 0.02}))
        self.assertEqual(self.analyze("p.h5")["certified"], 8)
        np.testing.assert_allclose(self.ranges("r.h5")[0, 2:], [-0.01, 0.02], rtol=1e-12)

    def test_a_loose_bound_changes_nothing(self):
        self.packing(program.groove(), "free")
        self.packing(groove({"R_hi": 100, "T_lo": -100}), "loose")
        self.analyze("free.h5")
        free = self.ranges("r.h5")
        self.analyze("loose.h5")
        np.testing.assert_allclose(self.ranges("r.h5"), free, rtol=1e-12)

    def test_it_makes_an_unbounded_packing_bounded(self):
        # A disk between two walls that face each other: any R holds it.
        scene = {"disks.csv": "id,x,y,radius,mass\n0,0,0,1,1\n",
                 "walls.csv": "id,px,py,nx,ny\n0,-1,0,1,0\n1,1,0,-1,0\n",
                 "contacts.csv": "a,b,R_hi\n0,-1,7\n0,-2,\n", "scene.toml": "gravity = [0, -1]\nmu = 0.5\n"}
        self.packing(scene)
        shown = self.analyze("p.h5")
        self.assertEqual((shown["status"], shown["certified"]), ("bounded", 8))
        np.testing.assert_allclose(self.ranges("r.h5")[:, :2], [[1, 7], [1, 7]], rtol=1e-12)

    def test_rays_of_what_stays_unbounded(self):
        # A disk between two walls that face each other, held by bounds that leave R free to grow.
        for bounds in ({"R_lo": 7}, {"T_lo": -0.6, "T_hi": -0.2}, {"T_lo": -0.5, "T_hi": -0.5}):
            scene = groove(bounds, mu=0.5)
            scene["walls.csv"] = "id,px,py,nx,ny\n0,-1,0,1,0\n1,1,0,-1,0\n"
            self.packing(scene)
            self.assertEqual(self.analyze("p.h5")["status"], "unbounded")
            self.assertTrue(np.isinf(self.ranges("r.h5")[:, 1]).all())
            shutil.rmtree(self.folder / "p")

    def test_bounds_that_rounding_hides(self):
        for bounds in ({"R_lo": 0.57, "R_hi": 0.57000000000000006}, {"R_hi": 1e17}):
            self.packing(groove(bounds))
            done = self.run_indet("analyze", "p.h5", "-o", "r.h5", status=3)
            self.assertIn("too narrow, or too far away", done.stderr)
            self.assertNotIn("r.h5", self.files())
            shutil.rmtree(self.folder / "p")
        self.write("p", groove({"R_hi": 1e10}))
        self.assertIn("beyond 1e+05 mg", self.run_indet("import", "--format", "csv", "p", "-o", "p.h5").stderr)

    def test_exact_accuracy_takes_them(self):
        self.packing(groove({"R_hi": 0.6}))
        shown = self.analyze("p.h5", "--accuracy", "exact")
        self.assertEqual(shown["certified"], 8)
        self.assertEqual(self.ranges("r.h5")[0, 1], 0.6)

    def test_other_methods_find_the_same(self):
        self.simulated()
        self.analyze("s.h5", "--condition", "R=known±10%")
        expected = self.ranges("r.h5")
        for arguments in (["--formulation", "edge"], ["--formulation", "nullspace"], ["--method", "pivoting-tableau"]):
            self.analyze("s.h5", "--condition", "R=known±10%", *arguments)
            np.testing.assert_allclose(self.ranges("r.h5"), expected, atol=1e-9)

    def rows(self):
        with (self.folder / "scene" / "contacts.csv").open() as file:
            return list(csv.DictReader(file))

    def write_rows(self, rows):
        with (self.folder / "scene" / "contacts.csv").open("w") as file:
            writer = csv.DictWriter(file, {key: None for row in rows for key in row})
            writer.writeheader()
            writer.writerows(rows)

    def simulated(self):
        self.run_indet("simulate", "--protocol", "md1", "--disks", "12", "--seed", "3", "-o", "s.h5")

    def test_what_scipy_finds(self):
        self.simulated()
        self.run_indet("export", "s.h5", "--format", "csv", "-o", "scene")
        rows = self.rows()
        draw = np.random.default_rng(7)
        for row in rows:  # some one-sided, some two-sided, some none
            for force in "RT":
                width = draw.uniform(0.02, 0.5)
                if draw.random() < 0.4:
                    row[f"{force}_lo"] = repr(float(row[force]) - width)
                if draw.random() < 0.4:
                    row[f"{force}_hi"] = repr(float(row[force]) + width)
        rows[0]["R_lo"] = "-1"
        self.write_rows(rows)
        done = self.run_indet("import", "--format", "csv", "scene", "-o", "p.h5")
        self.assertIn("R_lo is negative", done.stderr)
        shown = self.analyze("p.h5")
        self.assertEqual(shown["certified"], 4 * len(rows))
        problem = Problem(self.folder / "p.h5")
        table = self.ranges("r.h5")
        for k in range(2 * len(rows)):
            for end, sign in ((0, -1), (1, 1)):
                self.assertAlmostEqual(table[k // 2, 2 * (k % 2) + end], problem.extremum(k, sign), delta=1e-8)
        # Out and in again: the same bounds.
        self.run_indet("export", "p.h5", "--format", "csv", "-o", "again")
        self.run_indet("import", "--format", "csv", "again", "-o", "again.h5")
        with h5py.File(self.folder / "p.h5") as first, h5py.File(self.folder / "again.h5") as second:
            np.testing.assert_array_equal(first["contacts/bounds"][:], second["contacts/bounds"][:])

    def test_narrow_conditions_keep_what_was_simulated(self):
        self.simulated()
        with h5py.File(self.folder / "s.h5") as file:
            mg = file["parameters"].attrs["mg"]
            known = {force: file[f"contacts/{force}"][:] / mg for force in "RT"}
        shown = self.analyze("s.h5", "--condition", "R=known±1e-6", "--condition", "T=known+-1e-6")
        self.assertEqual(shown["certified"], 4 * len(known["R"]))
        table = self.ranges("r.h5") / mg
        for column, force in ((0, "R"), (2, "T")):
            low, high = table[:, column], table[:, column + 1]
            self.assertTrue((low >= np.maximum(known[force] - 1e-6, 0 if force == "R" else -np.inf) - 1e-13).all())
            self.assertTrue((high <= known[force] + 1e-6 + 1e-13).all())
            self.assertTrue(((low <= known[force] + 1e-13) & (known[force] <= high + 1e-13)).all())
        with h5py.File(self.folder / "r.h5") as file:  # enclosures are narrow beside the interval
            self.assertLess((file["ranges/upper"][:] - file["ranges/lower"][:]).max() / mg, 1e-9)
        # Of three contacts alone: the others keep more room.
        self.analyze("s.h5", "--condition", "R=known±1e-6@0,2-3")
        some = self.ranges("r.h5") / mg
        self.assertLess((some[[0, 2, 3], 1] - some[[0, 2, 3], 0]).max(), 2.001e-6)
        self.assertGreater((some[:, 1] - some[:, 0]).max(), 1e-3)

    def test_forces_that_contradict_each_other(self):
        self.simulated()
        self.run_indet("export", "s.h5", "--format", "csv", "-o", "scene")
        rows = self.rows()
        draw = np.random.default_rng(1)
        for row in rows:
            for force in "RT":
                row[force] = repr(float(row[force]) + draw.uniform(-1e-8, 1e-8))
        self.write_rows(rows)
        self.run_indet("import", "--format", "csv", "scene", "-o", "p.h5")
        conditions = ["--condition", "R=known±1e-9", "--condition", "T=known±1e-9"]
        shown = self.analyze("p.h5", *conditions, status=4)
        self.assertEqual(shown["status"], "empty")
        text = self.run_indet("analyze", "p.h5", *conditions, "-o", "r.h5", "--overwrite", status=4).stdout
        self.assertRegex(text, r"\d+ of 84 bounds contradict each other")
        least = float(text.split("gives way by ")[1].split(" mg")[0])
        self.assertAlmostEqual(least, Problem(self.folder / "p.h5").least_relaxation(1e-9), delta=0.01 * least)
        with h5py.File(self.folder / "r.h5") as file:
            multipliers = file["equilibrium/bound_multipliers"][:]
        self.assertEqual(np.count_nonzero(abs(multipliers) > 1e-9), int(text.split(" of 84 bounds")[0].split()[-1]))
        # With the error that was named, they are compatible; with a little less, they are not.
        for factor, status in ((1.02, 0), (0.98, 4)):
            error = factor * (1e-9 + least)
            self.run_indet("analyze", "p.h5", "--condition", f"R=known±{error}", "--condition", f"T=known±{error}", "-o",
                           "r.h5", "--overwrite", status=status)

    def test_uniform_samples_keep_to_them(self):
        self.packing(groove({"R_lo": 0.55, "R_hi": 0.6}))
        self.run_indet("sample", "p.h5", "--method", "uniform", "-o", "u.h5")
        self.run_indet("verify", "u.h5")
        with h5py.File(self.folder / "u.h5") as file:
            # Uniform on a segment: the mean is its middle.
            self.assertAlmostEqual(file["sampling/center"][0], 0.575, delta=0.005)
        self.simulated()
        self.run_indet("sample", "s.h5", "--method", "uniform", "--condition", "R=known±1e-3", "-o", "c.h5")
        self.run_indet("verify", "c.h5")
        with h5py.File(self.folder / "c.h5") as file:
            mg = file["parameters"].attrs["mg"]
            np.testing.assert_array_less(abs(file["sampling/center"][0::2] - file["contacts/R"][:]) / mg, 1.0001e-3)

    def test_who_cannot_keep_to_them_says_so(self):
        scene = groove({"R_hi": 0.6})
        R = 0.5 / math.cos(math.pi / 6)
        scene["contacts.csv"] = f"a,b,R,T,R_hi\n0,-1,{R!r},0,0.6\n0,-2,{R!r},0,\n"
        self.packing(scene)
        for command in (["sample", "p.h5"], ["simulate", "--protocol", "cd1", "--from", "p.h5", "-o", "s.h5"]):
            done = self.run_indet(*command, status=3)
            self.assertIn("--method uniform", done.stderr)
        self.assertNotIn("s.h5", self.files())

    def test_bad_bounds_are_refused_with_their_line(self):
        for bounds, reason in (({"R_lo": 2, "R_hi": 1}, "R_lo is 2, more than R_hi, which is 1"),
                               ({"R_hi": -1}, "R_hi is -1, but contacts only push"),
                               ({"T_lo": "inf"}, "T_lo"), ({"T_lo": "x"}, "T_lo")):
            self.write("p", groove(bounds))
            done = self.run_indet("import", "--format", "csv", "p", "-o", "p.h5", status=3)
            self.assertRegex(done.stderr, r"contacts.csv:2:")
            self.assertIn(reason, done.stderr)
            self.assertEqual(self.files(), ["p"])
            shutil.rmtree(self.folder / "p")

    def test_bad_conditions_are_explained(self):
        self.packing(groove({"R_hi": 0.6}))
        for condition, reason, status in (("R=known", "expected R=known±ERROR", 2), ("Q=known±1", "expected R=known", 2),
                                          ("R=known±-1", "expected R=known", 2), ("R=known±1@9", "there is no contact 9", 2),
                                          ("R=known±1@", "list of contacts", 2), ("R=known±1", "known R", 3)):
            done = self.run_indet("analyze", "p.h5", "--condition", condition, status=status)
            self.assertIn(reason, done.stderr)
            self.assertEqual(self.files(), ["p", "p.h5"])


if __name__ == "__main__":
    program.main()
