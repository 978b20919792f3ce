"""`indet analyze --method barrier`: intervals of values, what is stored of them, and when it is chosen.

Arguments: the indet executable.
"""

import json
import pathlib
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

ENDS = ["R_min", "R_max", "T_min", "T_max"]


class Barrier(program.ProgramTest):
    """A pile of 30 disks, simulated once for all tests."""

    packing = None

    def setUp(self):
        super().setUp()
        if Barrier.packing is None:
            self.run_indet("simulate", "--protocol", "md1", "--disks", "30", "--seed", "1", "--quiet", "-o", "p.h5")
            Barrier.packing = (self.folder / "p.h5").read_bytes()
        (self.folder / "p.h5").write_bytes(Barrier.packing)

    def analyze(self, output, *options):
        return self.run_indet("analyze", "p.h5", "-o", output, *options).stdout

    def open(self, name):
        file = h5py.File(self.folder / name)
        self.addCleanup(file.close)
        return file

    def test_intervals_hold_the_values_of_linear_programs(self):
        self.analyze("lp.h5")
        text = self.analyze("b.h5", "--method", "barrier", "--gap", "1e-7")
        self.assertIn("found by the barrier method (gap 1e-07)", text)
        lp, barrier = self.open("lp.h5"), self.open("b.h5")
        mg = barrier["equilibrium"].attrs["force_unit"]
        names = h5py.check_enum_dtype(barrier["ranges/outcome"].dtype)
        self.assertEqual(names["enclosed"], 5)
        self.assertNotIn("enclosed", h5py.check_enum_dtype(lp["ranges/outcome"].dtype))
        self.assertTrue((barrier["ranges/outcome"][()] == names["enclosed"]).all())
        self.assertEqual(barrier["equilibrium"].attrs["gap"], 1e-7)
        self.assertEqual(barrier["equilibrium"].attrs["enclosed"], barrier["equilibrium"].attrs["objectives"])
        for k, end in enumerate(ENDS):
            lower, upper = barrier["ranges/lower"][:, k], barrier["ranges/upper"][:, k]
            value = barrier["ranges"][end][()]
            np.testing.assert_allclose(value, (lower + upper) / 2, rtol=1e-14)
            self.assertTrue((upper - lower <= 1e-7 * np.maximum(mg, abs(value))).all())
            self.assertTrue((lower <= lp["ranges/upper"][:, k]).all() and (upper >= lp["ranges/lower"][:, k]).all())
        self.assertEqual(barrier["extremal/states"].shape[0], 0)

    def test_verify_checks_them(self):
        self.analyze("b.h5", "--method", "barrier")
        text = self.run_indet("verify", "b.h5").stdout
        self.assertIn("0 contradictions", text)
        self.assertIn("linear programs found again", text)
        with h5py.File(self.folder / "b.h5", "r+") as file:  # an interval beside the value
            for name, shift in [("lower", 1), ("upper", 1)]:
                file["ranges"][name][0, 1] += shift
            file["ranges/R_max"][0] += 1
            file["ranges/delta_R"][0] += 1 / file["equilibrium"].attrs["force_unit"]
        result = self.run_indet("verify", "b.h5", status=5)
        self.assertIn("contact 0 R_max", result.stdout + result.stderr)

    def test_any_number_of_threads_gives_the_same_contents(self):
        digests = set()
        for threads in ["1", "2", "3"]:
            self.analyze("b.h5", "--method", "barrier", "--threads", threads)
            digests.add(self.open("b.h5").attrs["content_sha256"])
        self.assertEqual(len(digests), 1)

    def test_options_that_do_not_go_together(self):
        for options, text in [(["--method", "lp", "--gap", "1e-3"], "--gap has no effect"),
                              (["--method", "barrier", "--extremal-states", "solver"], "inside of optimal faces"),
                              (["--method", "barrier", "--accuracy", "exact"], "starts from the vertices"),
                              (["--method", "barrier", "--gap", "0"], "--gap"),
                              (["--method", "lp", "--duals", "all"], "--duals all has no effect"),
                              (["--duals", "all", "--states-of", "3"], "do not go together"),
                              (["--accuracy", "exact", "--duals", "all"], "starts from the vertices"),
                              (["--accuracy", "estimate", "--duals", "all"], "estimates have no multipliers"),
                              (["--duals", "sample:0"], "expected none, all, or sample:K"),
                              (["--duals", "3"], "expected none, all, or sample:K")]:
            with self.subTest(options):
                result = self.run_indet("analyze", "p.h5", "-o", "x.h5", *options, status=2)
                self.assertIn(text, result.stderr)
                self.assertFalse((self.folder / "x.h5").exists())

    def test_auto_says_what_it_chose(self):
        for options, method in [([], "lp"), (["--extremal-states", "none"], "lp")]:
            found = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "a.h5", *options).stdout)
            self.assertEqual(found["method"], method)
        reason = self.open("a.h5")["provenance/work"].attrs["reason"]
        self.assertIn("small", reason)

    def test_a_gap_asks_for_intervals(self):
        found = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "g.h5", "--gap", "1e-3").stdout)
        self.assertEqual(found["method"], "barrier")

    def test_extremal_states_are_those_of_linear_programs(self):
        self.analyze("l.h5", "--method", "lp")
        self.analyze("b.h5", "--method", "barrier", "--extremal-states", "canonical")
        lp, barrier = self.open("l.h5"), self.open("b.h5")
        self.assertTrue((barrier["ranges/outcome"][()] == 0).all())
        for name in ["d_R", "d_T", "R_max", "T_min"]:
            np.testing.assert_allclose(barrier["ranges/" + name][()], lp["ranges/" + name][()], rtol=1e-9, atol=1e-9)
        for name in ["vertex", "unique"]:
            np.testing.assert_array_equal(barrier["ranges/" + name][()], lp["ranges/" + name][()])
        np.testing.assert_array_equal(barrier["extremal/active"][()], lp["extremal/active"][()])
        text = self.run_indet("verify", "b.h5").stdout
        self.assertIn("0 contradictions", text)
        self.assertIn("certified values, optimal but for gaps up to", text)

    def test_extremal_states_of_some_contacts(self):
        self.analyze("b.h5", "--method", "barrier", "--states-of", "3,5")
        file = self.open("b.h5")
        kept = (file["ranges/vertex"][()] >= 0).all(axis=1)
        self.assertEqual(list(np.flatnonzero(kept)), [3, 5])
        np.testing.assert_array_equal(np.isfinite(file["ranges/d_R"][()]), kept)
        self.assertIn("0 contradictions", self.run_indet("verify", "b.h5").stdout)

    def test_multipliers_prove_values_by_themselves(self):
        text = self.analyze("d.h5", "--duals", "all")
        self.assertIn("found by the barrier method", text)
        file = self.open("d.h5")
        disks, walls = len(file["particles/disks/id"]), len(file["walls/id"])
        n, a, b, mu = (file["contacts"][name][()] for name in ["normal", "body_a", "body_b", "mu"])
        # One column an edge of strength 1: R = 1, T = ±mu.
        force = np.stack([np.ones(2 * len(mu)), np.repeat(mu, 2) * np.tile([1, -1], len(mu))])
        columns = np.zeros((3 * disks + 2 * walls + 3, 2 * len(mu)))
        for k in range(2 * len(mu)):
            R, T = force[:, k]
            nx, ny = n[k // 2]
            push = np.array([R * nx + T * ny, R * ny - T * nx])
            for body, sign in [(a[k // 2], 1), (b[k // 2], -1)]:
                if body >= 0:
                    columns[3 * body:3 * body + 3, k] = [*(sign * push), T]
        load = np.zeros(len(columns))
        weight = file["particles/disks/mass"][()][:, None] * file["parameters"].attrs["gravity"]
        load[:3 * disks].reshape(-1, 3)[:, :2] = -weight
        bounding = file["duals/bounding"][()]
        strength = load @ bounding / (columns.T @ bounding)
        self.assertTrue((columns.T @ bounding > 0).all())
        mg = file["equilibrium"].attrs["force_unit"]
        multipliers, points = file["duals/multipliers"][()], file["duals/points"][()]
        for contact in file["duals/contacts"][()]:
            for column in range(4):
                y, sign = multipliers[4 * contact + column], 1 - 2 * (column % 2)
                c = np.zeros(2 * len(mu))
                c[2 * contact:2 * contact + 2] = force[column // 2, 2 * contact:2 * contact + 2]
                rest = np.minimum(0, sign * (c - columns.T @ y)) @ strength
                proven = sign * load @ y + rest
                lower, upper = (sign * file["ranges"][name][contact, column] for name in ["lower", "upper"])
                stated = min(lower, upper)
                proven = max(proven, 0) if column == 0 else proven  # contacts do not pull
                self.assertLess(stated, proven + 1e-11 * mg)
                self.assertLess(proven, stated + 1e-6 * max(mg, abs(stated)))
                value = sign * points[4 * contact + column, 2 * contact + column // 2]
                self.assertLess(stated - 1e-11 * mg, value)
                self.assertLess(value, max(lower, upper) + 1e-11 * mg)
        self.assertIn(f"{4 * len(mu)} intervals proven by stored multipliers and states",
                      self.run_indet("verify", "d.h5").stdout)

    def test_multipliers_of_some_contacts(self):
        chosen = set()
        for seed, threads in [("3", "1"), ("3", "2"), ("4", "1")]:
            self.analyze("d.h5", "--duals", "sample:3", "--seed", seed, "--threads", threads, "--gap", "1e-3")
            file = self.open("d.h5")
            self.assertEqual(file["duals"].attrs["seed"], int(seed))
            self.assertEqual(file["duals/multipliers"].shape[0], 12)
            chosen.add((seed, tuple(file["duals/contacts"]), file.attrs["content_sha256"]))
        self.assertEqual(len(chosen), 2)
        self.assertIn("multipliers and states stored that prove the values of 3 contacts",
                      self.run_indet("inspect", "d.h5").stdout)
        self.analyze("b.h5", "--method", "barrier")
        self.assertNotIn("duals", self.open("b.h5"))

    def test_a_sample_of_contacts(self):
        self.analyze("b.h5", "--method", "barrier", "--contacts", "3,5-7")
        outcome = self.open("b.h5")["ranges/outcome"][()]
        self.assertEqual(sorted(np.flatnonzero((outcome == 5).all(axis=1))), [3, 5, 6, 7])


class Special(program.ProgramTest):
    def test_a_packing_that_cannot_stand(self):
        self.write("incline", program.incline())
        self.run_indet("import", "--format", "csv", "incline", "-o", "p.h5")
        result = self.run_indet("analyze", "p.h5", "--method", "barrier", "-o", "r.h5", status=4)
        self.assertIn("cannot stand", result.stdout)
        self.assertIn("0 contradictions", self.run_indet("verify", "r.h5").stdout)


    def test_forces_without_limit_have_rays(self):
        """Two contacts at ±45° and μ = 3: R ≥ mg/(2 (cos φ + μ sin φ)), and the disk can be jammed."""
        packing = self.packing(program.groove(np.pi / 4, mu=3))
        shown = json.loads(self.run_indet("--json", "analyze", packing, "--method", "barrier", "-o", "r.h5").stdout)
        self.assertEqual((shown["status"], shown["method"], shown["unbounded"]), ("unbounded", "barrier", 4))
        self.assertEqual(shown["certified"], 8)
        with h5py.File(self.folder / "r.h5") as file:
            mg = file["equilibrium"].attrs["force_unit"]
            np.testing.assert_allclose(file["ranges/R_min"][()] / mg, 1 / (2 * np.sqrt(0.5) * 4), atol=1e-6)
            self.assertTrue(np.isposinf(file["ranges/R_max"][()]).all())
            ray = file["extremal/rays"][()][file["ranges/ray"][0, 1]]
            np.testing.assert_allclose(ray[0::2], ray[0], rtol=1e-9)
        self.assertIn("0 contradictions", self.run_indet("verify", "r.h5").stdout)


if __name__ == "__main__":
    program.main()
