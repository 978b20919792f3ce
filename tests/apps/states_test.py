"""`indet analyze --extremal-states` and `--states-of`: which extremal states a file keeps, and what works without them.

Arguments: the indet executable.
"""

import json
import pathlib
import sys
import tempfile

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

ENDS = ["R_min", "R_max", "T_min", "T_max"]
HOW = "this file keeps no extremal states; indet analyze … --extremal-states canonical stores them"


class States(program.ProgramTest):
    """A pile of 25 disks."""

    @classmethod
    def setUpClass(cls):
        """Makes the files that all tests start from, once."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        for command in (["simulate", "--protocol", "cd1", "--disks", "25", "--seed", "1", "--quiet", "-o", "p.h5"],
                        ["analyze", "p.h5", "-o", "all.h5"]):
            done = program.run([program.INDET, *command], folder.name)
            assert done.returncode == 0, done.stderr
        cls.made = {name: (pathlib.Path(folder.name) / name).read_bytes() for name in ("p.h5", "all.h5")}

    def setUp(self):
        super().setUp()
        for name, content in self.made.items():
            (self.folder / name).write_bytes(content)

    def analyze(self, output, *options):
        return self.run_indet("analyze", "p.h5", "-o", output, *options).stdout

    def open(self, name):
        file = h5py.File(self.folder / name)
        self.addCleanup(file.close)
        return file

    def assert_same_values(self, name):
        every, some = self.open("all.h5")["ranges"], self.open(name)["ranges"]
        np.testing.assert_array_equal(some["outcome"], every["outcome"])
        for k, end in enumerate(ENDS):
            np.testing.assert_allclose(some[end], every[end], atol=1e-10)
            self.assertTrue((some["lower"][:, k] <= every["upper"][:, k]).all())
            self.assertTrue((some["upper"][:, k] >= every["lower"][:, k]).all())
        for measure in ["delta_R", "delta_T", "R_star", "T_star"]:
            np.testing.assert_allclose(some[measure], every[measure], atol=1e-10)

    def test_all(self):
        text = self.analyze("r.h5")
        self.assertRegex(text, r"\n\d+ extremal states kept, the canonical ones\n")
        file = self.open("all.h5")
        self.assertEqual((file["ranges"].attrs["states"], file["ranges"].attrs["states_of"]), ("canonical", "all"))
        self.assertNotIn("contacts", file["extremal"])
        self.assertRegex(self.analyze("s.h5", "--accuracy", "fast"), r"states kept, those that the solver found\n")
        self.assertEqual(self.open("s.h5")["ranges"].attrs["states"], "solver")

    def test_none(self):
        text = self.analyze("none.h5", "--extremal-states", "none")
        self.assertRegex(text, r"\nno extremal states kept \(all could take 0\.\d+ MB; --extremal-states canonical")
        self.assertNotIn("dR ", text)
        self.assert_same_values("none.h5")
        file = self.open("none.h5")
        self.assertEqual(file["ranges"].attrs["states"], "none")
        self.assertEqual(file["extremal/states"].shape[0], 0)
        self.assertEqual(file["extremal/active"].shape[0], 0)
        self.assertEqual(file["extremal/norm"].shape[0], 0)
        self.assertEqual(file["extremal"].attrs["largest_norm"], -1)
        self.assertTrue((file["ranges/vertex"][()] == -1).all())
        for measure in ["d_R", "d_T"]:
            self.assertTrue(np.isnan(file["ranges"][measure]).all())
        for table in ["lower", "upper", "sensitivity", "primal_residual", "dual_residual"]:
            self.assertTrue(np.isfinite(file["ranges"][table]).all(), table)
        states = self.open("all.h5")["extremal/states"]
        every, none = ((self.folder / name).stat().st_size for name in ["all.h5", "none.h5"])
        self.assertGreater(every - none, 0.9 * 8 * states.size)

    def test_the_solver_finds_the_same_numbers_without_keeping_its_states(self):
        self.analyze("solver.h5", "--extremal-states", "solver")
        self.analyze("none.h5", "--extremal-states", "none")
        solver, none = self.open("solver.h5")["ranges"], self.open("none.h5")["ranges"]
        for name in [*ENDS, "lower", "upper", "sensitivity", "primal_residual", "dual_residual", "outcome", "unique"]:
            np.testing.assert_array_equal(solver[name], none[name], name)

    def test_of_a_list(self):
        text = self.analyze("r.h5", "--states-of", "3,0-1")
        self.assertRegex(text, r"\n\d+ extremal states kept, the canonical ones of 3 contacts\n")
        self.assert_same_values("r.h5")
        every, some = self.open("all.h5"), self.open("r.h5")
        self.assertEqual(list(some["extremal/contacts"]), [0, 1, 3])
        self.assertEqual(some["ranges"].attrs["states_of"], "list")
        vertex = some["ranges/vertex"][()]
        kept = [0, 1, 3]
        self.assertEqual(list(np.flatnonzero((vertex >= 0).all(axis=1))), kept)
        self.assertEqual((vertex >= 0).sum(), 12)
        for measure in ["d_R", "d_T"]:
            np.testing.assert_allclose(some["ranges"][measure][()][kept], every["ranges"][measure][()][kept], atol=1e-8)
            self.assertEqual(np.isfinite(some["ranges"][measure]).sum(), 3)
        for contact in kept:
            np.testing.assert_allclose(some["extremal/states"][()][vertex[contact]],
                                       every["extremal/states"][()][every["ranges/vertex"][contact]], atol=1e-8)
        self.run_indet("verify", "r.h5")
        self.run_indet("export", "r.h5", "--state", "R_max:3", "-o", "s.svg")
        done = self.run_indet("export", "r.h5", "--state", "R_max:2", "-o", "t.svg", status=3)
        self.assertIn("this file keeps the extremal states of 3 contacts alone; indet analyze … --extremal-states "
                      "canonical stores all", done.stderr)

    def test_of_the_largest(self):
        text = self.analyze("r.h5", "--states-of", "largest:2", "--extremal-states", "solver")
        self.assertRegex(text, r"states? kept, those that the solver found of the 2 contacts of largest δR \+ δT\n")
        ranges = self.open("all.h5")["ranges"]
        order = np.argsort(-(ranges["delta_R"][()] + ranges["delta_T"][()]), kind="stable")
        self.assertEqual(list(self.open("r.h5")["extremal/contacts"]), sorted(order[:2]))
        self.run_indet("verify", "r.h5")
        self.analyze("every.h5", "--states-of", "largest:9999")
        self.assertEqual(self.open("every.h5")["extremal/contacts"].shape, ranges["delta_R"].shape)

    def test_what_reads_a_file_without_states(self):
        self.analyze("none.h5", "--extremal-states", "none")
        for state in ["max-norm", "state:0", "R_max:3"]:
            done = self.run_indet("export", "none.h5", "--state", state, "-o", "s.svg", status=3)
            self.assertIn(HOW, done.stderr)
        self.run_indet("export", "none.h5", "--style", "delta-R", "-o", "delta.svg")
        for output in ["t.csv", "t.vtkhdf", "t.extxyz"]:
            self.run_indet("export", "none.h5", "-o", output)
        with open(self.folder / "t.csv", encoding="utf-8") as table:
            names, first = (table.readline().strip().split(",") for _ in range(2))
        row = dict(zip(names, first, strict=True))
        self.assertEqual((row["d_R_mg"], row["d_T_mg"]), ("", ""))
        self.assertNotEqual(row["delta_R_mg"], "")
        self.assertIn("no extremal states kept", self.run_indet("inspect", "none.h5").stdout)
        report = json.loads(self.run_indet("inspect", "none.h5", "--json").stdout)
        self.assertEqual((report["ranges"]["states"], report["ranges"]["extremal_states"]), (0, "none"))
        self.run_indet("sample", "none.h5", "--samples", "20", "--seed", "1", "-o", "samples.h5")
        self.run_indet("simulate", "--protocol", "cd2", "--from", "none.h5", "-o", "again.h5")

    def test_verify_says_what_it_leaves_unchecked(self):
        self.analyze("none.h5", "--extremal-states", "none")
        text = self.run_indet("verify", "none.h5").stdout
        self.assertIn("0 contradictions", text)
        objectives = self.open("none.h5")["equilibrium"].attrs["objectives"]
        self.assertIn(f"that {objectives} of {objectives} values are attained and optimal", text)
        self.assertIn("--extremal-states canonical stores them", text)
        report = json.loads(self.run_indet("verify", "none.h5", "--exact", "--json").stdout)
        self.assertEqual((report["exact"]["contradictions"], report["exact"]["refuted"], report["exact"]["undecided"]),
                         (0, 0, 0))

    def test_verify_notices_what_does_not_fit(self):
        self.analyze("r.h5", "--states-of", "largest:2")
        self.analyze("none.h5", "--extremal-states", "none")

        def forge(name, change, message):
            (self.folder / "bad.h5").write_bytes((self.folder / name).read_bytes())
            with h5py.File(self.folder / "bad.h5", "r+") as file:
                change(file)
            self.assertIn(message, self.run_indet("verify", "bad.h5", status=5).stdout)

        def name_others(file):
            kept = file["extremal/contacts"]
            kept[0] = next(i for i in range(kept[1]) if i != kept[0])

        def leave_the_interval(file):
            file["ranges/R_max"][0] += 1

        forge("r.h5", name_others, "none of it are said to be kept")
        forge("none.h5", leave_the_interval, "is not within its bounds")
        forge("none.h5", lambda file: file["ranges"].attrs.modify("states_of", "list"), "are named, but the states")

    def test_exact_values_need_states_on_the_way_only(self):
        self.packing(program.pyramid(), name="q")
        for option, states in [("none", 0), ("canonical", None)]:
            text = self.run_indet("analyze", "q.h5", "--accuracy", "exact", "--extremal-states", option, "-o",
                                  f"{option}.h5").stdout
            file = self.open(f"{option}.h5")
            self.assertEqual(file["ranges"].attrs["states"], option)
            if states is not None:
                self.assertEqual(file["extremal/states"].shape[0], states)
                self.assertIn("no extremal states kept", text)
            self.run_indet("verify", f"{option}.h5")
        none, canonical = (self.open(f"{option}.h5")["ranges"] for option in ["none", "canonical"])
        for name in [*ENDS, "lower", "upper"]:
            np.testing.assert_array_equal(none[name], canonical[name], name)

    def test_files_without_word_of_it_are_read(self):
        with h5py.File(self.folder / "all.h5", "r+") as file:
            del file.attrs["text_sha256"]
            for name in ["states", "states_of"]:
                del file["ranges"].attrs[name]
        self.run_indet("verify", "all.h5")
        self.assertRegex(self.run_indet("inspect", "all.h5").stdout, r"extremal states +\d+ extremal states kept\n")
        self.run_indet("export", "all.h5", "--state", "R_max:3", "-o", "s.svg")

    def test_bad_choices(self):
        last = self.open("p.h5")["contacts/R"].shape[0]
        for options, message in [
                (["--states-of", str(last)], f"there is no contact {last}"),
                (["--states-of", "largest:0"], "expected a number of contacts from 1 on"),
                (["--states-of", "largest:x"], "expected a number of contacts from 1 on"),
                (["--states-of", "most"], "expected all, largest:K"),
                (["--states-of", "1,,2"], "expected a list of contacts"),
                (["--states-of", "3", "--extremal-states", "none"], "which keeps no states"),
                (["--states-of", "3", "--contacts", "4-6"], "contact 3 are asked for, but its ranges are not")]:
            done = self.run_indet("analyze", "p.h5", "-o", "bad.h5", *options, status=2)
            self.assertIn(message, done.stderr)
            self.assertFalse((self.folder / "bad.h5").exists())


if __name__ == "__main__":
    program.main()
