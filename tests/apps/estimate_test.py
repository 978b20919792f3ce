"""`indet analyze --accuracy estimate`: what is stored, what is said of it, and how often the intervals hold.

Arguments: the indet executable.
"""

import csv
import json
import pathlib
import re
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

QUANTITIES = ("delta_R", "delta_T")


class Estimate(program.ProgramTest):
    """A pile of 40 disks, simulated once for all tests, and all of its ranges."""

    files_of_pile = None

    def setUp(self):
        super().setUp()
        if Estimate.files_of_pile is None:
            self.run_indet("simulate", "--protocol", "md1", "--disks", "40", "--seed", "1", "--quiet", "-o", "p.h5")
            self.run_indet("analyze", "p.h5", "--method", "barrier", "--quiet", "-o", "all.h5")
            Estimate.files_of_pile = {name: (self.folder / name).read_bytes() for name in ("p.h5", "all.h5")}
        for name, content in Estimate.files_of_pile.items():
            (self.folder / name).write_bytes(content)

    def estimate(self, *options, output="e.h5", packing="p.h5", status=0):
        done = self.run_indet("--json", "analyze", packing, "--accuracy", "estimate", *options, "-o", output, status=status)
        return json.loads(done.stdout) if status == 0 else done.stderr

    def read(self, name):
        with h5py.File(self.folder / name) as file:
            return {key: value[()] for key, value in file["ranges"].items()}, dict(file["ranges"].attrs)

    def test_what_is_stored(self):
        report = self.estimate("--seed", "3")
        ranges, attributes = self.read("e.h5")
        everything, _ = self.read("all.h5")
        calibrates = ranges["calibrates"] == 1
        self.assertEqual(calibrates.sum(), 20)
        self.assertEqual({name: attributes[name] for name in ("calibration", "requested", "sample_seed", "coverage", "contacts")},
                         {"calibration": 20, "requested": 20, "sample_seed": 3, "coverage": 0.95, "contacts": "calibration"})
        with h5py.File(self.folder / "e.h5") as file:
            names = h5py.check_enum_dtype(file["ranges/outcome"].dtype)
            mg = file["equilibrium"].attrs["force_unit"]
        self.assertEqual(names["estimate"], 6)
        for k, q in enumerate(QUANTITIES):
            is_estimate = ranges["outcome"][:, 2 * k] == names["estimate"]
            estimate, low, high = (ranges[f"{q}_{part}"] for part in ("estimate", "low", "high"))
            np.testing.assert_array_equal(np.isnan(ranges[q]), is_estimate)
            for values in (estimate, low, high):
                np.testing.assert_array_equal(np.isnan(values), ~is_estimate)
            self.assertFalse((is_estimate & calibrates).any())
            self.assertTrue((low <= estimate)[is_estimate].all() and (estimate <= high)[is_estimate].all())
            self.assertTrue((low >= 2 * ranges["width"][:, k] / mg * (1 - 1e-12))[is_estimate].all())
            np.testing.assert_allclose(ranges[q][~is_estimate], everything[q][~is_estimate], atol=0.02, rtol=0.02)
            self.assertTrue(np.isnan(ranges["R_min"][is_estimate]).all() if k == 0 else True)
            told = report["estimates"][q]
            self.assertEqual(told["estimated"], is_estimate.sum())
            self.assertAlmostEqual(told["mean"], estimate[is_estimate].mean(), places=9)
            self.assertAlmostEqual(told["max"], estimate[is_estimate].max(), places=9)
        self.run_indet("verify", "e.h5")

    def residuals(self, q, k, ranges):
        """ln(δ/σ) less its location over its scale, of all contacts: the ends of two predictions tell both, as
        low = σ exp(f + s u_low) for all of them with the same u_low."""
        everything, _ = self.read("all.h5")
        keep = ~np.isnan(ranges[f"{q}_estimate"])
        f = np.log(ranges[f"{q}_estimate"][keep])
        s = np.log(ranges[f"{q}_high"][keep]) - f
        return (np.log(everything[q][keep]) - f) / s, keep

    def test_intervals_are_conformal(self):
        """The band of the residuals of 20 contacts, by its definition, in numpy. Without calibration the estimate is
        the location, and the interval has one multiple of the scale."""
        self.estimate("--calibrate", "0", output="none.h5")
        none, _ = self.read("none.h5")
        self.estimate("--seed", "3")
        ranges, _ = self.read("e.h5")
        for k, q in enumerate(QUANTITIES):
            unit, keep = self.residuals(q, k, none)
            u = np.full(len(keep), np.nan)
            u[keep] = unit
            drawn = u[ranges["calibrates"] == 1]
            drawn = drawn[~np.isnan(drawn)]
            self.assertEqual(len(drawn), 20)
            sum_ = drawn.sum()
            grid = np.linspace(drawn.mean() - 3 * np.ptp(drawn), drawn.mean() + 3 * np.ptp(drawn), 20001)
            means = (sum_ + grid) / 21
            inside = grid[(np.abs(drawn[:, None] - means) >= np.abs(grid - means)).any(axis=0)]
            step = grid[1] - grid[0]
            free = ~np.isnan(ranges[f"{q}_estimate"])
            f = np.log(none[f"{q}_estimate"][free])
            s = np.log(none[f"{q}_high"][free]) - f
            for part, end in (("estimate", drawn.mean()), ("low", inside[0]), ("high", inside[-1])):
                least = 2 * ranges["width"][free, k] / self.force_unit("e.h5")
                found = ranges[f"{q}_{part}"][free]
                clear = found > 1.001 * least
                self.assertGreater(clear.sum(), 3)
                # The grid, and calibrating values that are known to 1e-2.
                np.testing.assert_allclose(((np.log(found) - f) / s)[clear], end, atol=2 * step + 0.06)

    def force_unit(self, name):
        with h5py.File(self.folder / name) as file:
            return file["equilibrium"].attrs["force_unit"]

    def test_intervals_hold(self):
        """Over 15 draws of the program: 20/21 in the mean, with a standard deviation of 5 % each."""
        everything, _ = self.read("all.h5")
        shares = []
        for seed in range(1, 16):
            self.estimate("--seed", str(seed))
            ranges, _ = self.read("e.h5")
            for q in QUANTITIES:
                free = ~np.isnan(ranges[f"{q}_estimate"])
                holds = (ranges[f"{q}_low"] <= everything[q]) & (everything[q] <= ranges[f"{q}_high"])
                shares.append(holds[free].mean())
        self.assertGreater(np.mean(shares), 0.92)
        self.assertLess(np.mean(shares), 0.98)

    def test_the_report_says_what_it_is(self):
        text = self.run_indet("analyze", "p.h5", "--accuracy", "estimate", "-o", "e.h5").stdout
        self.assertIn("not found but predicted", text)
        self.assertIn("calibrated on 20 contacts drawn at random (seed 1)", text)
        self.assertRegex(text, r"95 % interval from 0\.\d+ to [123]\.?\d* times the estimate")
        text = self.run_indet("analyze", "p.h5", "--accuracy", "estimate", "--calibrate", "0", "-o", "e.h5").stdout
        self.assertIn("by coefficients of other packings alone", text)
        text = self.run_indet("analyze", "p.h5", "--accuracy", "estimate", "--calibrate", "5", "-o", "e.h5").stdout
        self.assertIn("too few for intervals that hold for any packing (from 19 on)", text)
        text = self.run_indet("inspect", "e.h5").stdout
        self.assertIn("δR, estimated", text)
        self.assertIn("for the calibration of estimates", text)

    def test_pictures_and_tables(self):
        self.estimate()
        ranges, _ = self.read("e.h5")
        self.run_indet("export", "e.h5", "--style", "delta-R", "-o", "e.svg")
        picture = (self.folder / "e.svg").read_text()
        self.run_indet("export", "all.h5", "--style", "delta-R", "-o", "all.svg")
        # As in the picture of known ranges, lines of one thickness, and here half of it, too.
        known, here = (set(map(float, re.findall(r"stroke-width[:=]\"?([\d.]+)", text)))
                       for text in ((self.folder / "all.svg").read_text(), picture))
        self.assertTrue(any(abs(thin / thick - 0.5) < 1e-3 for thin in here - known for thick in here & known), (known, here))
        self.run_indet("export", "e.h5", "-o", "e.csv")
        with open(self.folder / "e.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for row, estimate, known in zip(rows, ranges["delta_R_estimate"], ranges["delta_R"], strict=True):
            self.assertEqual(row["delta_R_estimate_mg"] == "", np.isnan(estimate))
            self.assertEqual(row["delta_R_mg"] == "", np.isnan(known))
        self.assertIn("estimate", {row["R_min_outcome"] for row in rows})
        self.run_indet("export", "e.h5", "--format", "extxyz", "-o", "e.extxyz")
        self.run_indet("export", "e.h5", "-o", "e.vtkhdf")

    def test_determined_forces_are_proven(self):
        """A disk that rests on the floor alone, beside the pyramid: R = 1, T = 0 in all states."""
        scene = program.pyramid()
        scene["disks.csv"] += "3,9,1,1,1\n"
        scene["contacts.csv"] += "3,-1\n"
        report = self.estimate("--calibrate", "0", packing=self.packing(scene, "q"))
        self.run_indet("analyze", "q.h5", "-o", "known.h5")
        ranges, _ = self.read("e.h5")
        known, _ = self.read("known.h5")
        self.assertEqual((ranges["delta_R"][-1], ranges["delta_T"][-1]), (0, 0))
        self.assertAlmostEqual(ranges["R_min"][-1], 1, places=6)
        self.assertTrue(ranges["lower"][-1, 0] <= 1 <= ranges["upper"][-1, 1])
        for q in QUANTITIES:
            np.testing.assert_array_equal(ranges[q] == 0, known[q] < 1e-9)
            np.testing.assert_array_equal(np.isnan(ranges[q]), known[q] > 1e-9)
        self.assertEqual(report["determined"], 2 * sum((known[q] < 1e-9).sum() for q in QUANTITIES))
        self.run_indet("verify", "e.h5")

    def test_without_friction_T_is_no_estimate(self):
        report = self.estimate(packing=self.packing(program.rack(), "q"))
        self.assertEqual(report["estimates"]["delta_T"]["estimated"], 0)
        ranges, _ = self.read("e.h5")
        self.assertTrue((ranges["delta_T"] == 0).all())
        self.run_indet("verify", "e.h5")

    def test_other_bodies(self):
        """Pistons, bounds and fixed disks are in the polytope, and in the estimates."""
        bounded = program.pyramid()
        bounded["contacts.csv"] = "a,b,R_hi\n" + "".join(f"{row},{9 if n == 0 else ''}\n" for n, row in
                                                         enumerate(bounded["contacts.csv"].splitlines()[1:]))
        for name, scene in [("box", program.biaxial_box(4, 4, 8.0, 8.0, 0.3)), ("bounds", bounded),
                            ("plates", program.plates_at_a_column(6, 5, 0.4))]:
            with self.subTest(name):
                packing = self.packing(scene, name)
                for K in ("0", "5", "20"):
                    self.estimate("--calibrate", K, packing=packing)
                    self.run_indet("verify", "e.h5")

    def test_no_estimates_without_centre(self):
        unbounded = self.packing(program.groove(angle=1.4), "unbounded")
        self.assertIn("some contact forces can grow without limit", self.estimate(packing=unbounded, status=3))
        self.assertNotIn("e.h5", self.files())
        done = self.run_indet("analyze", self.packing(program.incline(), "i"), "--accuracy", "estimate", "-o", "e.h5", status=4)
        self.assertIn("cannot stand", done.stdout)
        self.run_indet("verify", "e.h5")

    def test_options_that_contradict(self):
        for options, text in [(["--method", "lp"], "--method lp has no effect"),
                              (["--contacts", "sample:5"], "--contacts sample:5 has no effect"),
                              (["--extremal-states", "canonical"], "no extremal states are found"),
                              (["--states-of", "largest:2"], "no extremal states are found"),
                              (["--formulation", "edge"], "no linear programs"),
                              (["--reactions", "all"], "no reactions are estimated"),
                              (["--calibrate", "0", "--gap", "1e-3"], "--gap has no effect with --calibrate 0"),
                              (["--calibrate", "0", "--seed", "2"], "--seed has no effect with --calibrate 0"),
                              (["--neighbour", "best"], "--neighbour best has no effect"),
                              (["--calibrate", "-1"], "--calibrate")]:
            with self.subTest(options):
                self.assertIn(text, self.estimate(*options, status=2))
        done = self.run_indet("analyze", "p.h5", "--calibrate", "5", status=2)
        self.assertIn("--calibrate has no effect without --accuracy estimate", done.stderr)

    def test_from_a_configuration(self):
        self.estimate("--calibrate", "7", "--gap", "0.05")
        (self.folder / "c.toml").write_text(self.config_of("e.h5"))
        self.run_indet("analyze", "p.h5", "--config", "c.toml", "-o", "again.h5")
        first, again = self.read("e.h5")[0], self.read("again.h5")[0]
        np.testing.assert_array_equal(first["delta_R_high"], again["delta_R_high"])


if __name__ == "__main__":
    program.main()
