"""`indet analyze --smallest-distances`: the smallest distance of states of largest and smallest value of a force.

Argument: the indet executable. Independent answers: closed forms; and SciPy, on equations written here once more, by
two programs between whose values the smallest distance lies (Problem.smallest_distance).
"""

import csv
import json
import math
import pathlib
import sys

import h5py
import numpy as np
from scipy.optimize import linprog, nnls

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

ENCLOSED, NOT_REQUESTED = 5, 4


class Problem:
    """c B x = −w, x ≥ 0, F = B x of a file of disks of weight 1 between fixed walls; B has the edges of the cones."""

    def __init__(self, path):
        with h5py.File(path) as file:
            disks, contacts = file["particles/disks"], file["contacts"]
            n, m = len(disks["id"]), len(contacts["R"])
            self.mg = file["parameters"].attrs["mg"]
            normal, mu = contacts["normal"][:], contacts["mu"][:]
            c, self.w = np.zeros((3 * n, 2 * m)), np.zeros(3 * n)
            for i in range(n):
                self.w[3 * i:3 * i + 2] = disks["mass"][i] * file["parameters"].attrs["gravity"] / self.mg
            for k in range(m):
                nx, ny = normal[k]
                for body, sign in [(contacts["body_a"][k], 1), (contacts["body_b"][k], -1)]:
                    if body >= 0:
                        c[3 * body:3 * body + 2, 2 * k] = sign * nx, sign * ny
                        c[3 * body:3 * body + 3, 2 * k + 1] = sign * ny, -sign * nx, 1
        self.B = np.zeros((2 * m, 2 * m))
        for k in range(m):
            self.B[2 * k:2 * k + 2, 2 * k:2 * k + 2] = [[1, 1], [mu[k], -mu[k]]]
        self.A = c @ self.B

    def end(self, row, sign):
        found = linprog(-sign * row, A_eq=self.A, b_eq=-self.w, method="highs")
        return sign * -found.fun

    def smallest_distance(self, component, weight=1e5):
        """A lower and an upper bound: of least squares in which equations may be violated at a price, and of those over the
        strengths that are positive there, all others 0, with the equations held."""
        size = self.A.shape[1]
        row = self.B[component]
        fixed = np.vstack([self.A, row])
        targets = [np.append(-self.w, self.end(row, sign)) for sign in (1, -1)]
        apart = np.hstack([self.B, -self.B])
        both = np.block([[fixed, np.zeros_like(fixed)], [np.zeros_like(fixed), fixed]])
        right = np.concatenate(targets)
        x, least = nnls(np.vstack([apart, weight * both]), np.concatenate([np.zeros(len(apart)), weight * right]),
                        maxiter=100 * size)
        held = both[:, x > 1e-8]
        start = np.linalg.lstsq(held, right, rcond=1e-11)[0]
        _, sizes, kernel = np.linalg.svd(held)
        kernel = kernel[np.sum(sizes > 1e-9):].T
        moved = apart[:, x > 1e-8]
        step = np.linalg.lstsq(moved @ kernel, -moved @ start, rcond=1e-11)[0]
        y = start + kernel @ step
        assert np.abs(held @ y - right).max() < 1e-7 and y.min() > -1e-6
        return least, np.linalg.norm(moved @ y)


class Distances(program.ProgramTest):
    def analyze(self, name, *options, output="r.h5"):
        done = self.run_indet("analyze", name, "-o", output, "--overwrite", "--smallest-distances", *options)
        return done.stdout

    def table(self, name="r.h5"):
        with h5py.File(self.folder / name) as file:
            return {key: file["ranges"][key][()] for key in file["ranges"]}

    def check(self, name="r.h5"):
        """What holds of every file."""
        r = self.table(name)
        self.assertTrue((r["d_min_outcome"] == ENCLOSED).all())
        for k, component in enumerate("RT"):
            d = r[f"d_{component}_min"]
            self.assertTrue((abs(d - r["d_min_lower"][:, k]) <= 1.001e-3 * np.maximum(1, d)).all())
            self.assertTrue((d >= r[f"delta_{component}"] - 1e-5).all())
            self.assertTrue((r["d_min_shortage"] < 1e-4).all())
            if np.isfinite(r[f"d_{component}"]).all():
                self.assertTrue((r["d_min_lower"][:, k] <= r[f"d_{component}"] * (1 + 1e-9)).all())
        self.run_indet("verify", name)
        return r

    def test_a_groove_has_one_state_at_each_end(self):
        self.write("s", program.groove())
        self.run_indet("import", "--format", "csv", "s", "-o", "p.h5")
        for method in ("lp", "barrier"):
            self.analyze("p.h5", "--method", method)
            r = self.check()
            s, c, mu = math.sin(math.pi / 6), math.cos(math.pi / 6), 0.3
            delta = np.array([mu * s, mu * c]) / (c**2 - mu**2 * s**2)
            for component in "RT":
                np.testing.assert_allclose(r[f"d_{component}_min"], math.sqrt(2) * np.hypot(*delta), rtol=1e-3)

    def test_a_part_that_takes_no_part_does_not_move(self):
        """Two grooves apart: for the extremes of one the other may stay as it is."""
        scene = program.groove()
        scene["disks.csv"] += "1,10,0,1,1\n"
        walls = scene["walls.csv"].splitlines()
        for k, line in enumerate(walls[1:]):
            wall, px, rest = line.split(",", 2)
            walls.append(f"{2 + k},{float(px) + 10!r},{rest}")
        scene["walls.csv"] = "\n".join(walls) + "\n"
        scene["contacts.csv"] = "a,b\n0,-1\n0,-2\n1,-3\n1,-4\n"
        self.write("s", scene)
        self.run_indet("import", "--format", "csv", "s", "-o", "p.h5")
        self.analyze("p.h5")
        r = self.check()
        s, c, mu = math.sin(math.pi / 6), math.cos(math.pi / 6), 0.3
        alone = math.sqrt(2) * math.hypot(mu * s, mu * c) / (c**2 - mu**2 * s**2)
        np.testing.assert_allclose([r["d_R_min"], r["d_T_min"]], np.full((2, 4), alone), rtol=1e-3)

    def test_against_least_squares(self):
        for seed in (1, 2, 3):
            self.run_indet("simulate", "--protocol", "md1", "--disks", 9, "--seed", seed, "--quiet", "-o", "p.h5",
                           "--overwrite")
            self.analyze("p.h5")
            r = self.check()
            problem = Problem(self.folder / "p.h5")
            count = len(r["d_R_min"])
            self.assertGreater(np.nanmax(r["d_R"] - r["d_R_min"]), 0.01)
            for contact in range(0, count, max(1, count // 5)):
                for k, component in enumerate("RT"):
                    least, most = problem.smallest_distance(2 * contact + k)
                    found = r[f"d_{component}_min"][contact]
                    self.assertLess(most - least, 1e-3 * max(1, most))
                    self.assertLess(least - 1.1e-3 * max(1, least), found)
                    self.assertLess(r["d_min_lower"][contact, k], most + 1e-5)
                    self.assertAlmostEqual(found, most, delta=1.1e-3 * max(1, most))

    def test_methods_threads_and_choices_of_contacts(self):
        self.run_indet("simulate", "--protocol", "md1", "--disks", 20, "--seed", 1, "--quiet", "-o", "p.h5")
        text = self.analyze("p.h5")
        self.assertRegex(text, r"\n\d+ smallest distances known to 0\.1 %, 0 imprecise, 0 failed\n")
        self.assertRegex(text, r"\n  dR_min   mean +\d")
        lp = self.check()
        self.analyze("p.h5", "--method", "barrier", "--threads", 1, output="b1.h5")
        self.analyze("p.h5", "--method", "barrier", "--threads", 3, output="b3.h5")
        one, three = self.check("b1.h5"), self.table("b3.h5")
        self.analyze("p.h5", "--method", "barrier", "--contacts", "3,7-9", output="some.h5")
        some = self.table("some.h5")
        chosen = [3, 7, 8, 9]
        for name in ("d_R_min", "d_T_min", "d_min_lower", "d_min_shortage", "d_min_outcome"):
            np.testing.assert_array_equal(one[name], three[name])
            np.testing.assert_array_equal(one[name][chosen], some[name][chosen])
        self.assertEqual((some["d_min_outcome"] == NOT_REQUESTED).sum(), 2 * (len(one["d_R_min"]) - 4))
        self.assertTrue(np.isnan(np.delete(some["d_R_min"], chosen)).all())
        self.run_indet("verify", "some.h5")
        for k, component in enumerate("RT"):
            name = f"d_{component}_min"
            self.assertTrue((lp["d_min_lower"][:, k] <= one[name] + 1e-5).all())
            self.assertTrue((one["d_min_lower"][:, k] <= lp[name] + 1e-5).all())
        text = self.run_indet("inspect", "r.h5").stdout
        self.assertIn("dR_min (mg)", text)
        summary = json.loads(self.run_indet("inspect", "--json", "r.h5").stdout)["ranges"]["smallest_distances"]
        self.assertEqual(summary["known"], 2 * len(lp["d_R_min"]))
        self.assertAlmostEqual(summary["mean_d_R_min"], lp["d_R_min"].mean())
        self.run_indet("export", "r.h5", "-o", "r.csv")
        with open(self.folder / "r.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual([float(row["d_R_min_mg"]) for row in rows], list(lp["d_R_min"]))

    def test_what_there_is_none_of(self):
        self.write("unbounded", program.groove(angle=1.4))
        self.run_indet("import", "--format", "csv", "unbounded", "-o", "p.h5")
        text = self.analyze("p.h5")
        self.assertIn("no smallest distances: ", text)
        self.assertIn("some contact forces can grow without limit", text)
        self.assertTrue(np.isnan(self.table()["d_R_min"]).all())
        self.run_indet("verify", "r.h5")
        self.write("flat", program.plates_at_a_column(2, 1, 0))
        self.run_indet("import", "--format", "csv", "flat", "-o", "q.h5")
        self.analyze("q.h5")
        self.assertTrue((self.check()["d_R_min"] == 0).all(), "one state alone")
        done = self.run_indet("analyze", "p.h5", "--accuracy", "estimate", "--smallest-distances", status=2)
        self.assertIn("--smallest-distances", done.stderr)
        self.analyze("q.h5", output="without.h5")
        self.run_indet("analyze", "q.h5", "-o", "without.h5", "--overwrite")
        with h5py.File(self.folder / "without.h5") as file:
            self.assertNotIn("d_R_min", file["ranges"])

    def test_verify_contradicts_what_is_wrong(self):
        self.run_indet("simulate", "--protocol", "md1", "--disks", 9, "--seed", 1, "--quiet", "-o", "p.h5")
        self.analyze("p.h5")
        self.run_indet("verify", "r.h5")
        clean = (self.folder / "r.h5").read_bytes()
        for name, factor in [("d_R_min", 0.5), ("d_R_min", 1.01), ("d_min_lower", 1.5), ("d_min_shortage", 1e9)]:
            with self.subTest(name, factor=factor):
                (self.folder / "r.h5").write_bytes(clean)
                with h5py.File(self.folder / "r.h5", "r+") as file:
                    file["ranges"][name][...] = file["ranges"][name][()] * factor
                done = self.run_indet("verify", "r.h5", status=5)
                self.assertIn("_min of contact", done.stdout + done.stderr)


if __name__ == "__main__":
    program.main()
