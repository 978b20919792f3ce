"""`indet compare` and `indet analyze --method`: the same results by every method, and what the paper's fails at.

Arguments: the indet executable.
"""

import json
import math
import pathlib
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

METHODS = ["lp", "pivoting-paper", "pivoting-tableau"]


class Compare(program.ProgramTest):
    def test_methods_agree_on_a_groove(self):
        report = json.loads(self.run_indet("compare", self.packing(program.groove()), "--json").stdout)
        self.assertEqual([method["method"] for method in report["methods"]], METHODS)
        self.assertEqual((report["disks"], report["contacts"], report["dim"], report["status"]), (1, 2, 1, "bounded"))
        for method in report["methods"]:
            self.assertEqual((method["certified"], method["imprecise"], method["failed"]), (8, 0, 0))
            self.assertEqual((method["compared"], method["same_states"]), (8, 8))
            self.assertLess(method["worst_difference"], 1e-12)
            self.assertEqual(method["disagreements"], [])
        paper = report["methods"][1]["paper"]
        # Both contacts slide at once in a symmetric groove: two active constraints in one dimension.
        self.assertEqual((paper["walks"], paper["failures"]), (8, 8))
        self.assertEqual(paper["ends"]["more active constraints than dimensions"], 8)
        self.assertEqual(paper["starts"]["no simulated state"], 1)

    def test_the_table_names_every_method(self):
        done = self.run_indet("compare", self.packing(program.pyramid()))
        for method in METHODS:
            self.assertIn(method, done.stdout.splitlines()[3])
        self.assertRegex(done.stdout, r"(?m)^certified +20 +20 +20$")
        self.assertRegex(done.stdout, r"(?m)^  interior point: by a linear program in 1 block \(no simulated state\)$")
        self.assertRegex(done.stdout, r"(?m)^ +14  more active constraints than dimensions$")
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.files(), ["p", "p.h5"])

    def test_no_method_pays_for_the_start_of_the_libraries(self):
        packing = self.packing(program.pyramid())
        ratios = []
        for _ in range(5):  # one of them is not disturbed by other work
            report = json.loads(self.run_indet("compare", packing, "--json").stdout)
            first, *others = [method["seconds"]["polytope"] for method in report["methods"]]
            self.assertLessEqual(report["common_seconds"], first)
            ratios.append(first / min(others))
        self.assertLess(min(ratios), 3)

    def test_what_is_asked_of_analyze_is_asked_of_each(self):
        packing = self.packing(program.pyramid())
        report = json.loads(self.run_indet("compare", packing, "--contacts", "0,3", "--accuracy", "fast", "--json").stdout)
        self.assertEqual(report["requested"], 2)
        for method in report["methods"]:
            self.assertEqual(method["objectives"], 8)
            self.assertLess(method["seconds"]["states"], 1e-3)

    def test_a_packing_that_cannot_stand_is_4(self):
        self.run_indet("compare", self.packing(program.incline()), status=4)

    def test_a_negative_tolerance_is_refused(self):
        done = self.run_indet("compare", self.packing(program.groove()), "--tolerance", "-1", status=2)
        self.assertIn("--tolerance", done.stderr)


class Method(program.ProgramTest):
    def test_every_method_writes_the_same_results(self):
        packing = self.packing(program.pyramid())
        for method in METHODS:
            self.run_indet("analyze", packing, "--method", method, "-o", f"{method}.h5")
            self.run_indet("verify", f"{method}.h5")
        with h5py.File(self.folder / "lp.h5") as expected:
            for method in METHODS:
                with h5py.File(self.folder / f"{method}.h5") as found, self.subTest(method):
                    self.assertEqual(found["provenance/work"].attrs["method"], method)
                    for name in ["R_min", "R_max", "T_min", "T_max", "delta_R", "d_R", "outcome", "unique"]:
                        np.testing.assert_allclose(found["ranges"][name][()], expected["ranges"][name][()], atol=1e-12)

    def test_the_paper_s_failures_are_in_the_file(self):
        self.run_indet("analyze", self.packing(program.pyramid()), "--method", "pivoting-paper", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            work = dict(file["provenance/work"].attrs)
        walks = sum(value for name, value in work.items() if name.startswith("walks_"))
        self.assertEqual((walks, work["walks_more_active"]), (14, 14))
        self.assertEqual(work["start_unknown"], 1)
        self.assertGreaterEqual(work["extremal_points"], walks)

    def test_fast_gives_the_same_ranges(self):
        packing = self.packing(program.groove(angle=math.pi / 5))
        reports = [json.loads(self.run_indet("analyze", packing, "--accuracy", accuracy, "--json").stdout)
                   for accuracy in ["fast", "standard"]]
        for name in ["mean_delta_R", "mean_delta_T", "certified"]:
            self.assertAlmostEqual(reports[0][name], reports[1][name], places=13)
        self.assertNotIn("canonical", self.config_of("p.ranges.h5"))

    def test_options_that_would_have_no_effect_are_refused(self):
        packing = self.packing(program.groove())
        for options in [["--method", "pivoting-tableau", "--formulation", "edge"], ["--seed", "3"],
                        ["--contacts", "0", "--seed", "3"]]:
            done = self.run_indet("analyze", packing, *options, status=2)
            self.assertIn(options[-2], done.stderr)
            self.assertEqual(self.files(), ["p", "p.h5"])


if __name__ == "__main__":
    program.main()
