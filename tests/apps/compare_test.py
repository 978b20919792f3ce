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
                        ["--contacts", "0", "--seed", "3"], ["--neighbour", "first"], ["--start", "common"],
                        ["--method", "pivoting-tableau", "--neighbour", "best"],
                        ["--method", "pivoting-paper", "--neighbour", "best", "--seed", "3"]]:
            done = self.run_indet("analyze", packing, *options, status=2)
            self.assertIn(options[-2], done.stderr)
            self.assertEqual(self.files(), ["p", "p.h5"])


class Walk(program.ProgramTest):
    """--neighbour and --start of pivoting-paper."""

    def walked(self, *options, packing="pile.h5"):
        """How a file of the walk tells its options: the file itself, JSON, inspect; and its dR, dT."""
        arguments = ["analyze", packing, "--method", "pivoting-paper", "--extremal-states", "solver", *options, "-o", "w.h5",
                     "--overwrite"]
        report = json.loads(self.run_indet(*arguments, "--json").stdout)["paper"]
        inspected = json.loads(self.run_indet("inspect", "w.h5", "--json").stdout)["ranges"]["paper"]
        self.assertEqual(report, inspected)
        shown = self.run_indet("inspect", "w.h5").stdout
        with h5py.File(self.folder / "w.h5") as file:
            work = dict(file["provenance/work"].attrs)
            mg = file["parameters"].attrs["mg"]
            vertex, states = file["ranges/vertex"][()], file["extremal/states"][()]
            distances = [file[f"ranges/{name}"][()] for name in ("d_R", "d_T")]
            for lowest, distance in zip((0, 2), distances):
                np.testing.assert_allclose(
                    distance, np.linalg.norm(states[vertex[:, lowest + 1]] - states[vertex[:, lowest]], axis=1) / mg, atol=1e-9)
        self.assertEqual((work["neighbour_rule"], work["walk_start"]), (report["neighbour_rule"], report["walk_start"]))
        self.assertEqual(work.get("walk_seed"), report.get("walk_seed"))
        self.assertIn(f"pivoting-paper (neighbour: {work['neighbour_rule']}, start: {work['walk_start']})", shown)
        self.run_indet("verify", "w.h5")
        return (work["neighbour_rule"], work["walk_start"], work.get("walk_seed")), np.array(distances)

    def test_the_options_are_told_wherever_the_method_is_and_lead_to_other_states(self):
        self.run_indet("simulate", "--protocol", "md1", "--disks", "25", "--seed", "2", "--quiet", "-o", "pile.h5")
        told, as_written = self.walked()
        self.assertEqual(told, ("first", "common", None))
        np.testing.assert_array_equal(self.walked("--neighbour", "first", "--start", "common")[1], as_written)
        others = [as_written]
        for options, expected in [(["--neighbour", "best"], ("best", "common", None)),
                                  (["--neighbour", "best", "--start", "minimum"], ("best", "minimum", None)),
                                  (["--start", "minimum"], ("first", "minimum", None)),
                                  (["--neighbour", "random"], ("random", "common", 1)),
                                  (["--neighbour", "random", "--seed", "7"], ("random", "common", 7))]:
            told, distances = self.walked(*options)
            self.assertEqual(told, expected)
            for other in others:
                self.assertFalse(np.allclose(distances, other), options)
            others.append(distances)

    def test_a_configuration_file_has_them(self):
        self.packing(program.pyramid())
        (self.folder / "c.toml").write_text('[analyze]\nmethod = "pivoting-paper"\nneighbour = "best"\nstart = "minimum"\n')
        self.run_indet("--config", "c.toml", "analyze", "p.h5", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["provenance/work"].attrs["neighbour_rule"], "best")
            self.assertEqual(file["provenance/work"].attrs["walk_start"], "minimum")
        done = self.run_indet("--config", "c.toml", "analyze", "p.h5", "--method", "lp", "-o", "s.h5", status=2)
        self.assertIn("--neighbour best has no effect without --method pivoting-paper", done.stderr)
        (self.folder / "c.toml").write_text('[analyze]\nneighbour = "nearest"\n')
        done = self.run_indet("--config", "c.toml", "analyze", "p.h5", "-o", "s.h5", status=3)
        self.assertIn("c.toml:2: neighbour", done.stderr)

    def test_compare_walks_as_it_is_told(self):
        packing = self.packing(program.pyramid())
        done = self.run_indet("compare", packing)
        self.assertRegex(done.stdout, r"(?m)^neighbour, start of the walks +- +first, common +-$")
        report = json.loads(self.run_indet("compare", packing, "--neighbour", "best", "--start", "minimum", "--json").stdout)
        paper = report["methods"][1]["paper"]
        self.assertEqual((paper["neighbour_rule"], paper["walk_start"]), ("best", "minimum"))
        self.assertEqual(paper["neighbours"], paper["extremal_points"] * report["dim"])

    def test_a_file_that_does_not_tell_went_to_the_best_neighbour_from_the_minimum(self):
        self.run_indet("analyze", self.packing(program.pyramid()), "--method", "pivoting-paper", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5", "r+") as file:
            for name in ("neighbour_rule", "walk_start"):
                del file["provenance/work"].attrs[name]
        self.assertIn("neighbour: best, start: minimum", self.run_indet("inspect", "r.h5").stdout)


if __name__ == "__main__":
    program.main()
