"""`indet analyze --contacts`: ranges of some contacts only, and what they tell about all.

Arguments: the indet executable.
"""

import json
import pathlib
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

NOT_REQUESTED = 4


class Contacts(program.ProgramTest):
    def analyze(self, *options, output="r.h5"):
        report = json.loads(self.run_indet("analyze", "p.h5", "--json", "-o", output, *options).stdout)
        self.run_indet("verify", output)
        return report

    def setUp(self):
        super().setUp()
        self.packing(program.pyramid())
        self.run_indet("analyze", "p.h5", "-o", "all.h5")

    def assert_same_where_requested(self, name, requested):
        with h5py.File(self.folder / "all.h5") as every, h5py.File(self.folder / name) as some:
            asked = (some["ranges/outcome"][()] != NOT_REQUESTED).all(axis=1)
            self.assertEqual(list(np.flatnonzero(asked)), requested)
            self.assertTrue((some["ranges/outcome"][()][~asked] == NOT_REQUESTED).all())
            for dataset in ["R_min", "R_max", "T_min", "T_max", "delta_R", "delta_T", "d_R", "d_T"]:
                np.testing.assert_allclose(some["ranges"][dataset][()][asked], every["ranges"][dataset][()][asked],
                                           atol=1e-12)
                self.assertTrue(np.isnan(some["ranges"][dataset][()][~asked]).all(), dataset)

    def test_a_list(self):
        report = self.analyze("--contacts", "3,0-1,3")
        self.assertEqual((report["requested"], report["objectives"], report["certified"]), (3, 12, 12))
        self.assert_same_where_requested("r.h5", [0, 1, 3])
        self.assertNotIn("sample", report)

    def test_reactions_are_of_all_contacts_unless_asked_for(self):
        every = self.analyze()["reactions"]
        for method in ("lp", "barrier"):
            self.assertNotIn("reactions", self.analyze("--method", method, "--contacts", "0-1"))
            with h5py.File(self.folder / "r.h5") as file:
                self.assertNotIn("reactions", file)
            self.assertNotIn("reactions", self.analyze("--method", method, "--reactions", "none"))
            some = self.analyze("--method", method, "--contacts", "0-1", "--reactions", "all")["reactions"]
            self.assertEqual(len(some), len(every))
            for one, other in zip(some, every):
                self.assertEqual((one["wall"], one["component"]), (other["wall"], other["component"]))
                np.testing.assert_allclose([one["minimum"], one["maximum"]], [other["minimum"], other["maximum"]], atol=1e-5)

    def test_a_sample(self):
        report = self.analyze("--contacts", "sample:3", "--seed", "7")
        with h5py.File(self.folder / "r.h5") as file:
            delta = file["ranges/delta_R"][()]
            drawn = np.flatnonzero(~np.isnan(delta))
            attributes = dict(file["ranges"].attrs)
        self.assertEqual(len(drawn), 3)
        self.assert_same_where_requested("r.h5", list(drawn))
        mean = delta[drawn].mean()
        np.testing.assert_allclose(attributes["mean_delta_R"], [mean, np.nan, np.nan], atol=1e-12)
        np.testing.assert_allclose(attributes["band_delta_R"], np.sqrt(np.log(40) / 6 * (1 - 2 / 5)), rtol=1e-12)
        self.assertAlmostEqual(report["sample"]["delta_R"]["mean"], mean, places=12)
        self.assertEqual(self.analyze("--contacts", "sample:3", "--seed", "7", output="again.h5")["sample"],
                         report["sample"])

    def test_few_contacts_tell_no_interval(self):
        self.assertIsNone(self.analyze("--contacts", "sample:3")["sample"]["delta_R"]["low"])
        text = self.run_indet("analyze", "p.h5", "--contacts", "sample:3", "-o", "r.h5").stdout
        self.assertRegex(text, r"δR +mean [\d.]+ in the sample; no confidence interval \(--contacts sample:6 or more")

    def test_seeds_draw_different_contacts(self):
        drawn = set()
        for seed in range(8):
            self.analyze("--contacts", "sample:2", "--seed", seed)
            with h5py.File(self.folder / "r.h5") as file:
                drawn.add(tuple(np.flatnonzero(~np.isnan(file["ranges/delta_R"][()]))))
        self.assertGreater(len(drawn), 3)

    def test_a_sample_of_all_is_exact(self):
        sample = self.analyze("--contacts", "sample:99")["sample"]["delta_R"]
        self.assertEqual(sample["low"], sample["high"])
        self.assertEqual(sample["band"], 0)

    def test_what_else_reads_the_file(self):
        self.analyze("--contacts", "sample:2")
        self.assertRegex(self.run_indet("inspect", "r.h5").stdout, r"(?m)^  asked for +2 of 5 contacts \(a sample, seed 1\)$")
        self.run_indet("inspect", "r.h5", "--json")
        self.run_indet("export", "r.h5", "--style", "delta-R", "-o", "r.svg")
        self.run_indet("export", "r.h5", "-o", "r.csv")
        self.assertEqual((self.folder / "r.csv").read_text().count("not requested"), 3 * 4)
        text = self.run_indet("analyze", "p.h5", "--contacts", "sample:2", "-o", "r.h5").stdout
        self.assertIn("asked for: 2 of 5 contacts", text)
        self.assertIn("estimate for all 5 contacts, from 2 drawn at random (seed 1), with 95 % confidence", text)
        self.assertNotIn("nan", text)

    def test_nonsense_is_refused(self):
        before = self.files()
        for choice, message in [("some", "some"), ("sample:0", "sample:0"), ("sample:x", "sample:x"), ("3-1", "3-1"),
                                ("1,", "1,"), ("-1", "-1"), ("0,5", "there is no contact 5; the packing has 5")]:
            with self.subTest(choice):
                done = self.run_indet("analyze", "p.h5", f"--contacts={choice}", status=2)
                self.assertIn(message, done.stderr)
                self.assertEqual(self.files(), before)


if __name__ == "__main__":
    program.main()
