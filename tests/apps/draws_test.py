"""`indet analyze --method barrier --contacts sample:K`: contacts that are drawn by their widths about the analytic centre.

Arguments: the indet executable.
"""

import json
import pathlib
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

STUDENT = 2.048407141795244  # 97.5 % quantile with 28 degrees of freedom


class Draws(program.ProgramTest):
    def analyze(self, *options, output="r.h5"):
        return json.loads(self.run_indet("analyze", "p.h5", "--method", "barrier", "--json", "-o", output, *options).stdout)

    def setUp(self):
        super().setUp()
        self.run_indet("simulate", "--protocol", "cd1", "--disks", 25, "--seed", 1, "-o", "p.h5")

    def test_what_is_stored_gives_the_estimates(self):
        report = self.analyze("--contacts", "sample:30", "--seed", "7")
        with h5py.File(self.folder / "r.h5") as file:
            ranges = {name: file["ranges"][name][()] for name in
                      ["draw_weight", "drawn", "width", "delta_R", "delta_T"]}
            attributes = dict(file["ranges"].attrs)
            contacts = len(file["contacts/body_a"])
        self.assertEqual((attributes["contacts"], attributes["draws"], attributes["sample_seed"]), ("sample", 30, 7))
        self.assertEqual(ranges["drawn"].sum(), 30)
        self.assertEqual((ranges["drawn"] > 0).sum(), attributes["requested"])
        np.testing.assert_array_equal(np.isnan(ranges["delta_R"]), ranges["drawn"] == 0)
        width = ranges["width"]
        self.assertEqual(width.shape, (contacts, 2))
        np.testing.assert_array_equal(ranges["draw_weight"],
                                      2 + np.round(100 * (width / width.mean(axis=0)).sum(axis=1)).astype(int))
        self.assertEqual(report["sample"]["draws"], 30)
        self.assertEqual((report["sample"]["estimator"], attributes["estimator"]), ("regression", "regression"))
        self.run_indet("analyze", "p.h5", "--accuracy", "estimate", "--calibrate", 0, "-o", "e.h5")
        with h5py.File(self.folder / "e.h5") as file:
            predicted = {name: np.nan_to_num(file[f"ranges/{name}_estimate"][()]) for name in ["delta_R", "delta_T"]}
        k = np.repeat(np.arange(contacts), ranges["drawn"])
        for name in ["delta_R", "delta_T"]:
            over = ranges["draw_weight"].sum() / (contacts * ranges["draw_weight"][k])
            line = np.column_stack([np.ones(30), predicted[name][k] * over])
            inverse = np.linalg.pinv(line)
            at = np.array([1, predicted[name].mean()]) @ inverse  # the weight of each draw
            z = ranges[name][k] * over
            residual = (z - line @ (inverse @ z)) / (1 - np.diag(line @ inverse))
            mean, reach = at @ z, STUDENT * np.sqrt(np.sum((at * residual) ** 2))
            np.testing.assert_allclose(attributes[f"mean_{name}"], [mean, mean - reach, mean + reach], rtol=1e-10)
            np.testing.assert_allclose(attributes[f"band_{name}"], 0.15 + 0.2 / np.sqrt(30), rtol=1e-12)
            self.assertAlmostEqual(report["sample"][name]["low"], mean - reach, places=9)
            self.assertAlmostEqual(report["sample"][name]["mean"], mean, places=9)

    def test_the_mean_of_all_is_where_the_draws_say(self):
        self.analyze(output="all.h5")
        with h5py.File(self.folder / "all.h5") as file:
            means = {name: file[f"ranges/{name}"][()].mean() for name in ["delta_R", "delta_T"]}
        covered = 0
        for seed in range(10):
            sample = self.analyze("--contacts", "sample:30", "--seed", seed, "--gap", "1e-3")["sample"]
            covered += sum(sample[name]["low"] <= mean <= sample[name]["high"] for name, mean in means.items())
        self.assertGreaterEqual(covered, 16)  # of 20; 19 are expected

    def test_the_same_whatever_the_threads(self):
        samples = [self.analyze("--contacts", "sample:9", "--threads", threads)["sample"] for threads in (1, 2)]
        self.assertEqual(*samples)

    def test_a_contact_that_is_drawn_twice_is_found_once(self):
        report = self.analyze("--contacts", "sample:40")
        self.assertLess(report["requested"], 40)
        self.assertEqual(report["objectives"], 4 * report["requested"])

    def test_text(self):
        text = self.run_indet("analyze", "p.h5", "--method", "barrier", "--contacts", "sample:8", "-o", "r.h5").stdout
        self.assertIn("  8 draws with replacement, with probabilities that follow the widths about the analytic centre\n"
                      "  means by regression on predictions of δ from these widths\n", text)
        self.assertRegex(text, r"δR +mean between [\d.]+ and [\d.]+; distribution function known to ± 0.22 by experience")
        text = self.run_indet("analyze", "p.h5", "--method", "barrier", "--contacts", "sample:3", "-o", "r.h5").stdout
        self.assertRegex(text, r"δR +mean [\d.]+ by the draws; no confidence interval \(--contacts sample:6 or more")
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["ranges"].attrs["estimator"], "mean")
        self.assertNotIn("regression", text)
        self.assertIn("\nindeterminacy of the contacts that were drawn (mg)\n", text)
        self.assertNotIn("nan", text[text.index("estimate for all"):])

    def test_what_else_reads_the_file(self):
        self.analyze("--contacts", "sample:8")
        self.run_indet("inspect", "r.h5", "--json")
        self.run_indet("export", "r.h5", "--style", "delta-R", "-o", "r.svg")
        self.run_indet("export", "r.h5", "-o", "r.csv")
        header = (self.folder / "r.csv").read_text().splitlines()[0].split(",")
        self.assertIn("drawn", header)
        self.assertIn("draw_weight", header)

    def test_methods_are_compared_on_the_same_contacts(self):
        report = json.loads(self.run_indet("compare", "p.h5", "--contacts", "sample:5", "--tolerance", "1e-4", "--json").stdout)
        self.assertEqual(report["requested"], 5)
        self.assertEqual([method["objectives"] for method in report["methods"]], [20] * len(report["methods"]))

    def test_equally_likely_contacts_elsewhere(self):
        for options in [("--method", "lp", "--contacts", "sample:5"), ("--method", "barrier", "--contacts", "sample:999"),
                        ("--method", "barrier", "--contacts", "0-3")]:
            with self.subTest(options):
                self.run_indet("analyze", "p.h5", "-o", "r.h5", *options)
                with h5py.File(self.folder / "r.h5") as file:
                    self.assertNotIn("draws", file["ranges"].attrs)
                    self.assertNotIn("estimator", file["ranges"].attrs)
                    self.assertNotIn("drawn", file["ranges"])
                self.run_indet("export", "r.h5", "-o", "r.csv")
                self.assertNotIn("drawn", (self.folder / "r.csv").read_text())


if __name__ == "__main__":
    program.main()
