"""Runs ensemble and merge as a user does, stops them, goes on, and reads the tables with h5py.

Arguments: the indet executable, and a class of tests.
"""

import json
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

SMALL = ["--disks", "12", "--samples", "5", "--uniform-seeds", "1"]
TINY = ["--seeds", "2", *SMALL]
LONGER = ["--disks", "30", "--samples", "5", "--uniform-seeds", "1"]  # long enough to be interrupted


def table(path, name):
    with h5py.File(path) as file:
        return {column: values[()] for column, values in file[f"table/{name}"].items()}


class EnsembleTest(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        """Makes the ensemble with which most tests begin, once."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.made = pathlib.Path(folder.name) / "tiny"
        done = program.run([program.INDET, "ensemble", *TINY, "-o", str(cls.made), "--threads", "2"], folder.name)
        assert done.returncode == 0, done.stderr

    def made_ensemble(self, name):
        shutil.copytree(self.made, self.folder / name)

    def ensemble(self, folder, *more, status=0):
        return self.run_indet("ensemble", *TINY, "-o", folder, *more, status=status)


class Commands(EnsembleTest):
    def test_tables_hold_what_the_members_hold(self):
        self.made_ensemble("e")
        runs = table(self.folder / "e/ensemble.h5", "runs")
        contacts = table(self.folder / "e/ensemble.h5", "contacts")
        reactions = table(self.folder / "e/ensemble.h5", "reactions")
        self.assertEqual([name.decode() for name in runs["member"]],
                         [f"{p}-{s:04}" for p in ("cd1", "cd2", "md1", "md2") for s in (0, 1)])
        shown = json.loads(self.run_indet("inspect", "e", "--json").stdout)
        self.assertEqual((shown["packings"], shown["intact"]), (8, True))
        self.assertIn("md2", self.run_indet("inspect", "e/ensemble.h5").stdout)
        self.assertTrue((runs["certified"] == 4 * runs["contacts"]).all())
        self.assertTrue((runs["nullity"] >= runs["lower_bound"]).all())
        self.assertEqual(len(contacts["run"]), runs["contacts"].sum())
        for row, name in enumerate(runs["member"]):
            with h5py.File(self.folder / f"e/members/{name.decode()}.h5") as member:
                mine = contacts["run"] == row
                np.testing.assert_array_equal(contacts["delta_R"][mine], member["ranges/delta_R"][()])
                np.testing.assert_allclose(contacts["R"][mine], member["contacts/R"][()] / runs["mg"][row])
                for states in ("extremal_R", "solver_extremal_R"):
                    self.assertEqual(member[f"ensemble/{states}"][()].sum(), 4 * runs["contacts"][row] ** 2)
                self.assertEqual(runs["r"][row], member["sampling"].attrs["r"])
                mine = reactions["run"] == row
                self.assertGreater(mine.sum(), 1)
                for column, name_there, end in (("minimum", "value", 0), ("maximum", "value", 1), ("lower", "lower", 0),
                                                ("upper", "upper", 1)):
                    np.testing.assert_allclose(reactions[column][mine],
                                               member[f"reactions/{name_there}"][:, end] / runs["mg"][row])
                for column in ("body", "component"):
                    np.testing.assert_array_equal(reactions[column][mine], member[f"reactions/{column}"][()])
            self.run_indet("verify", f"e/members/{name.decode()}.h5")

    def test_distances_compare_contacts_by_their_bodies(self):
        self.made_ensemble("e")
        runs = table(self.folder / "e/ensemble.h5", "runs")
        states = []
        for name in ("cd1-0001", "md2-0001"):
            with h5py.File(self.folder / f"e/members/{name}.h5") as member:
                c = member["contacts"]
                mg = member["parameters"].attrs["mg"]
                states.append({frozenset(pair): np.array([R, T]) / mg for *pair, R, T in
                               zip(c["body_a"][()], c["body_b"][()], c["R"][()], c["T"][()])})
        squares = sum(np.sum((states[0].get(k, 0) - states[1].get(k, np.zeros(2))) ** 2)
                      for k in states[0].keys() | states[1].keys())
        row = list(runs["member"]).index(b"md2-0001")
        self.assertAlmostEqual(runs["distance_cd1"][row], squares ** 0.5, delta=1e-9)
        self.assertTrue(np.isnan(runs["distance_cd1"][list(runs["member"]).index(b"md1-0001")]))

    def test_a_finished_member_is_skipped_and_a_damaged_or_different_one_is_not(self):
        self.made_ensemble("e")
        self.assertEqual(json.loads(self.ensemble("e", "--json").stdout)["skipped"], 8)
        damaged = self.folder / "e/members/md1-0000.h5"
        damaged.write_bytes(damaged.read_bytes()[:3000])
        listed = json.loads(self.ensemble("e", "--dry-run", "--json").stdout)["members"]
        self.assertEqual([member["name"] for member in listed if not member["done"]], ["md1-0000"])
        done = self.ensemble("e", "--json")
        self.assertIn("warning: e/members/md1-0000.h5: ", done.stderr)
        self.assertIn("it is computed again", done.stderr)
        again = json.loads(done.stdout)
        self.assertEqual((again["done"], again["skipped"]), (1, 7))
        other = json.loads(self.ensemble("e", "--mu", "0.4", "--json").stdout)
        self.assertEqual(other["done"], 8)
        more = json.loads(
            self.run_indet("ensemble", "--seeds", "3", *SMALL, "--mu", "0.4", "-o", "e", "--json").stdout)
        self.assertEqual((more["done"], more["skipped"]), (4, 8))

    def test_parts_join_to_the_same_tables(self):
        self.made_ensemble("whole")
        for part, members in enumerate(["0-1", "2-3", "4-5", "6-7"]):
            self.ensemble(f"p{part}", "--members", members)
        self.assertFalse((self.folder / "p0/ensemble.h5").exists())
        missing = self.run_indet("merge", "p0", "p1", "p3", "-o", "m", status=3).stderr
        self.assertIn("2 of 8 members are missing", missing)
        self.assertIn("md1-0001", missing)
        self.assertFalse((self.folder / "m").exists())
        self.run_indet("merge", "p0", "p1", "p2", "p3", "-o", "m")
        self.assertEqual(program.content(self.folder / "m/ensemble.h5"), program.content(self.folder / "whole/ensemble.h5"))
        damaged = self.folder / "m/members/md1-0000.h5"
        damaged.unlink()  # it is also the file of a part
        damaged.write_bytes(b"damaged")
        self.run_indet("merge", "p0", "p1", "p2", "p3", "-o", "m")
        self.run_indet("verify", damaged)
        self.assertEqual(program.content(self.folder / "m/ensemble.h5"), program.content(self.folder / "whole/ensemble.h5"))
        self.assertIn("is in two parts", self.run_indet("merge", "p0", "p1", "p2", "p3", "whole", "-o", "n", status=3).stderr)
        (self.folder / "p1/members/cd2-0000.h5").write_bytes(b"damaged")
        missing = self.run_indet("merge", "p1", "-o", "o", status=3).stderr
        self.assertIn("cd2-0000 (p1/members/cd2-0000.h5: cannot be opened", missing)
        self.run_indet("merge", "p0", "-o", "some", "--allow-missing", status=5)
        with h5py.File(self.folder / "some/ensemble.h5") as file:
            self.assertEqual(len(file["ensemble/missing"]), 6)

    def test_uniform_seeds_choose_packings_and_leave_the_others_as_they_are(self):
        self.made_ensemble("e")
        runs = table(self.folder / "e/ensemble.h5", "runs")
        self.assertTrue(((runs["uniform"] != b"") == (runs["seed"] == 0)).all())
        self.assertTrue(np.isnan(runs["uniform_r"][runs["seed"] == 1]).all())
        arguments = ["ensemble", *TINY[:-1]]
        more = json.loads(self.run_indet(*arguments, "all", "-o", "e", "--json").stdout)
        self.assertEqual((more["done"], more["skipped"]), (4, 4))
        runs = table(self.folder / "e/ensemble.h5", "runs")
        self.assertTrue((runs["uniform"] != b"").all())
        for row in np.flatnonzero(runs["status"] == b"unbounded"):
            self.assertEqual(runs["uniform"][row], b"unbounded")
        for wrong in ("-1", "some", "3x"):
            self.assertIn("expected a number, or all", self.run_indet(*arguments, wrong, "-o", "f", status=2).stderr)

    def test_an_ensemble_of_an_earlier_version_is_to_be_written_anew(self):
        self.ensemble("e")
        with h5py.File(self.folder / "e/ensemble.h5", "r+") as file:
            del file["table/runs/d_min_known"]
        self.assertIn("was written by an earlier indet", self.run_indet("inspect", "e", status=3).stderr)

    def test_packings_from_elsewhere(self):
        self.packing(program.groove(), "one")
        self.packing(program.groove(mu=0.5), "two")
        self.run_indet("ensemble", "one.h5", "two.h5", "-o", "e")
        runs = table(self.folder / "e/ensemble.h5", "runs")
        contacts = table(self.folder / "e/ensemble.h5", "contacts")
        self.assertEqual([name.decode() for name in runs["member"]], ["one", "two"])
        s, c = 0.5, 0.75 ** 0.5
        for row, mu in enumerate((0.3, 0.5)):
            np.testing.assert_allclose(contacts["delta_R"][contacts["run"] == row], mu * s / (c**2 - mu**2 * s**2))

    def test_failed_members_are_named_and_the_others_are_done(self):
        self.packing(program.groove(), "good")
        self.packing(program.groove(), "bad")
        (self.folder / "e/members/bad.h5").mkdir(parents=True)  # cannot be written
        done = self.run_indet("ensemble", "good.h5", "bad.h5", "-o", "e", status=5)
        self.assertIn("bad: ", done.stderr)
        self.assertIn("e/members/bad.h5: is not a file", done.stderr)
        self.assertIn("missing: bad", done.stdout)
        self.assertEqual(list(table(self.folder / "e/ensemble.h5", "runs")["member"]), [b"good"])

    def test_a_packing_that_does_not_balance_in_time_is_named_and_does_with_more(self):
        arguments = ["ensemble", "--protocols", "md1", "--first-seed", "1", "--seeds", "1", *SMALL, "--mu", "0.5", "-o", "e"]
        done = self.run_indet(*arguments, status=5)
        self.assertIn("md1-0001: md1: the forces do not balance", done.stderr)
        self.assertIn("the time limit came before the disks were at rest; a larger one may help", done.stderr)
        self.assertEqual(json.loads(self.run_indet(*arguments, "--time-limit", "40", "--json").stdout)["done"], 1)

    def interrupt(self, *arguments, after):
        """Sends SIGINT once there are `after` packings; returns the message and how many there are then."""
        process = subprocess.Popen([program.INDET, "ensemble", *arguments, "-o", "e"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while len(list((self.folder / "e/members").glob("*.h5"))) < after:
            self.assertIsNone(process.poll(), "it ended before the interrupt")
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        output, error = process.communicate(timeout=60)
        self.assertEqual((process.returncode, output), (128 + signal.SIGINT, ""), error)
        return error, len(list((self.folder / "e/members").glob("*.h5")))

    def test_an_interrupt_leaves_whole_files_and_says_how_many(self):
        for number in (1, 4):  # of which the first ones are there already
            error, done = self.interrupt("--seeds", "20", "--first-seed", "20", *LONGER, after=number)
            self.assertEqual(error, f"indet: interrupted; done: {done} of 80 packings; the same command goes on\n")
        self.assertFalse((self.folder / "e/ensemble.h5").exists())
        for path in (self.folder / "e/members").iterdir():
            self.assertEqual(path.suffix, ".h5", error)
            with h5py.File(path) as file:
                self.assertEqual(file.attrs["complete"], 1)

    def test_a_folder_of_an_earlier_version_is_refused_until_it_is_renamed(self):
        self.made_ensemble("e")
        whole = program.content(self.folder / "e/ensemble.h5")
        (self.folder / "e/members").rename(self.folder / "e/units")
        plan = self.folder / "e/ensemble.toml"
        plan.write_text(plan.read_text().replace("[[member]]", "[[unit]]"))
        advice = "rename e/units to e/members and run the same indet ensemble command again"
        for refused in (self.ensemble("e", status=3), self.run_indet("report", "e", status=3),
                        self.run_indet("merge", "e", "-o", "m", status=3)):
            self.assertIn(advice, refused.stderr)
        (self.folder / "e/units").rename(self.folder / "e/members")
        self.assertIn("writes it anew", self.run_indet("merge", "e", "-o", "m", status=3).stderr)
        self.assertEqual(json.loads(self.ensemble("e", "--json").stdout)["skipped"], 8)
        self.assertEqual(program.content(self.folder / "e/ensemble.h5"), whole)

    def test_a_dry_run_lists_members_and_writes_nothing(self):
        out = self.ensemble("e", "--dry-run").stdout
        self.assertIn("md2-0001", out)
        self.assertIn("8 packings to compute, about", out)
        self.assertEqual(self.files(), [])

    def test_wrong_usage(self):
        for members in ("7-9", "x", "3-1", "0-1z"):
            self.ensemble("e", "--members", members, status=2)
        self.run_indet("merge", ".", "-o", "m", status=3)
        self.run_indet("ensemble", "--protocols", "cd3", "-o", "e", status=2)
        self.assertEqual(self.files(), [])


class Agreement(EnsembleTest):
    """Members hold what other subcommands, and other numbers of threads, find."""

    def test_uniform_sampling_of_a_member_is_that_of_the_command(self):
        self.run_indet("ensemble", "--seeds", "1", "--protocols", "cd1,md2", "--disks", "14", "--samples", "60", "-o", "e")
        runs = table(self.folder / "e/ensemble.h5", "runs")
        contacts = table(self.folder / "e/ensemble.h5", "contacts")
        sampled = table(self.folder / "e/ensemble.h5", "sampled")
        rows = np.flatnonzero(runs["uniform"] == b"converged")
        self.assertGreater(len(rows), 0)
        for row in rows:
            name = f"e/members/{runs['member'][row].decode()}.h5"
            self.run_indet("sample", name, "--method", "uniform", "--states", "1000000", "-o", "u.h5")
            self.run_indet("sample", name, "--samples", "60", "-o", "p.h5")
            for file in (name, "u.h5", "p.h5"):
                self.run_indet("verify", file)
            mine = contacts["run"] == row
            mg = runs["mg"][row]
            with h5py.File(self.folder / name) as member, h5py.File(self.folder / "u.h5") as u, \
                    h5py.File(self.folder / "p.h5") as p:
                for key, value in u["sampling"].attrs.items():
                    if key not in ("method", "worst_residual"):
                        self.assertEqual(member["uniform"].attrs[key], value, key)
                for key in ("center", "deviation", "quantiles", "rhat", "bulk_ess"):
                    np.testing.assert_array_equal(member[f"uniform/{key}"][()], u[f"sampling/{key}"][()])
                self.assertEqual(runs["uniform_r"][row], u["sampling"].attrs["r"])
                R = u["sampling/states"][:, ::2] / mg
                np.testing.assert_allclose(contacts["uniform_R"][mine], R.mean(0), atol=1e-9)
                simulated = member["contacts/R"][()] / mg
                moves = R.std(0) > 1e-6
                np.testing.assert_allclose(contacts["uniform_R_percentile"][mine][moves],
                                           100 * (R < simulated).mean(0)[moves], atol=0.5)
                bins = (sampled["run"] == row) & (sampled["sampling"] == 0) & (sampled["quantity"] == b"R")
                expected, _ = np.histogram(R, np.append(sampled["low"][bins], sampled["low"][bins][-1] + 1))
                if np.all(np.diff(sampled["low"][bins]) == 1):
                    np.testing.assert_allclose(sampled["contacts"][bins], expected / len(R), atol=2 / len(R))
                self.assertAlmostEqual(sampled["contacts"][bins].sum(), len(simulated))
                # The distance of the centres, less what noise makes of it.
                shift = np.linalg.norm(p["sampling/center"][()] - u["sampling/center"][()]) / mg
                bias = member["bias"].attrs
                self.assertAlmostEqual(max(0, shift**2 - bias["center_noise"]**2) ** 0.5, bias["center_shift"], places=7)
                self.assertAlmostEqual(p["sampling"].attrs["r"], bias["r"], places=9)
                self.assertAlmostEqual(bias["ratio"], bias["r"] / u["sampling"].attrs["r"], places=12)

    def test_the_walk_of_the_paper_is_that_of_the_command(self):
        self.made_ensemble("e")
        first = json.loads(self.ensemble("e", "--paper-walk", "1", "--json").stdout)
        self.assertEqual((first["done"], first["skipped"]), (4, 4))
        runs = table(self.folder / "e/ensemble.h5", "runs")
        contacts = table(self.folder / "e/ensemble.h5", "contacts")
        self.assertTrue((np.isnan(runs["paper_walks"]) == (runs["seed"] == 1)).all())
        self.assertTrue((np.isnan(contacts["paper_d_R"]) == (runs["seed"][contacts["run"]] == 1)).all())
        differing = 0
        for row in np.flatnonzero(runs["seed"] == 0):
            name = runs["member"][row].decode()
            done = self.run_indet("analyze", f"e/members/{name}.h5", "--method", "pivoting-paper", "--extremal-states",
                                  "solver", "-o", f"{name}.h5", "--json")
            paper = json.loads(done.stdout)["paper"]
            self.assertEqual((paper["neighbour_rule"], paper["walk_start"]), ("first", "common"))
            self.assertEqual((runs["paper_walks"][row], runs["paper_failures"][row]), (paper["walks"], paper["failures"]))
            mine = contacts["run"] == row
            with h5py.File(self.folder / f"{name}.h5") as file:
                for column in ("d_R", "d_T"):
                    np.testing.assert_array_equal(contacts[f"paper_{column}"][mine], file[f"ranges/{column}"][()])
            differing += not np.allclose(contacts["paper_d_R"][mine], contacts["d_R"][mine])
        self.assertGreater(differing, 0)
        more = json.loads(self.ensemble("e", "--paper-walk", "all", "--json").stdout)
        self.assertEqual((more["done"], more["skipped"]), (4, 4))
        runs = table(self.folder / "e/ensemble.h5", "runs")
        self.assertFalse(np.isnan(runs["paper_walks"]).any())
        self.run_indet("report", "e")
        self.assertIn("CD, the paper's walk (Fig. 8)", (self.folder / "e/figures/comparison.csv").read_text())
        self.assertIn("set title 'the paper''s walk'", (self.folder / "e/figures/fig08.gp").read_text())
        self.assertIn("they measure which of these a method takes", (self.folder / "e/report.html").read_text())
        self.ensemble("e", "--paper-walk", "0")
        self.assertTrue(np.isnan(table(self.folder / "e/ensemble.h5", "contacts")["paper_d_R"]).all())
        self.run_indet("report", "e")
        self.assertNotIn("paper's walk (Fig. 8)", (self.folder / "e/figures/comparison.csv").read_text())
        self.assertNotIn("mallest distance", (self.folder / "e/report.html").read_text())  # not asked for either
        self.assertIn("--paper-walk some: expected a number, or all", self.ensemble("f", "--paper-walk", "some", status=2).stderr)

    def test_limits_are_those_of_the_command(self):
        self.made_ensemble("e")
        runs = table(self.folder / "e/ensemble.h5", "runs")
        for name in ("cd1-0000", "md2-0001"):
            path = f"e/members/{name}.h5"
            shown = self.run_indet("inspect", path).stdout
            for limit in ("tilt: ", "tilt of several disks: ", "load mg on the highest disk: "):
                self.assertEqual(shown.count("\n" + limit), 1, shown)
            with h5py.File(self.folder / path) as file:
                position, mg = file["particles/disks/position"][()], file["parameters"].attrs["mg"]
                top = file["particles/disks/id"][position[:, 1].argmax()]
                load = f"disk={top},0,{-mg!r}"
                self.run_indet("limit", path, "--tilt", "--load", load, "--friction", "-o", "limits.h5")
                self.run_indet("limit", path, "--tilt", "--ignore-below", "90", "-o", "several.h5")
                row = list(runs["member"]).index(name.encode())
                for number, other, place, columns in (
                        (0, "limits.h5", 0, ("tilt_smallest", "tilt_largest")),
                        (1, "several.h5", 0, ("tilt_of_several_smallest", "tilt_of_several_largest")),
                        (2, "limits.h5", 1, (None, "load_on_top")), (3, "limits.h5", 2, ("least_friction", None))):
                    with h5py.File(self.folder / other) as limits:
                        there = limits[f"limits/{place}"]
                        for key in ("value", "sliding", "dim"):
                            values = file[f"limits/{number}/{key}"][()]
                            np.testing.assert_allclose(values, there[key][()], rtol=1e-14)
                            for end, column in enumerate(columns):
                                if column:
                                    self.assertEqual(runs[column + ("" if key == "value" else f"_{key}")][row], values[end])
                        if number == 1:
                            left_out = there["left_out"][()]
                            self.assertEqual(runs["tilt_left_out"][row], len(left_out))
                            bodies = file["contacts/body_a"][()], file["contacts/body_b"][()]
                            contacts = ~(np.isin(bodies[0], left_out) | np.isin(bodies[1], left_out))
                            self.assertEqual(runs["tilt_of_several_lower_bound"][row],
                                             2 * contacts.sum() - 3 * (len(position) - len(left_out)))
        self.run_indet("report", "e")
        summary = (self.folder / "e/figures/limits.csv").read_text()
        self.assertIn('"","CD-1","CD-2","MD-1","MD-2","CD − MD","more stable"', summary)
        self.assertIn("How far are the packings from yielding?", (self.folder / "e/report.html").read_text())
        done = json.loads(self.ensemble("e", "--limits", "1", "--json").stdout)
        self.assertEqual((done["done"], done["skipped"]), (4, 4))
        runs = table(self.folder / "e/ensemble.h5", "runs")
        np.testing.assert_array_equal(np.isnan(runs["least_friction"]), runs["seed"] == 1)
        np.testing.assert_array_equal(runs["tilt_left_out"] == -1, runs["seed"] == 1)
        self.ensemble("e", "--limits", "0")
        self.run_indet("report", "e")
        self.assertNotIn("from yielding", (self.folder / "e/report.html").read_text())

    def test_smallest_distances_are_those_of_the_command(self):
        arguments = ["--seeds", "1", "--protocols", "cd1,md1", "--disks", "14", "--samples", "0", "--uniform-seeds", "0",
                     "--paper-walk", "0"]
        with_distances = ["ensemble", *arguments, "--smallest-distances"]
        done = self.run_indet(*with_distances, "-o", "e")
        for member in "01":
            self.run_indet(*with_distances, "--members", member, "-o", member)
        self.run_indet("merge", "0", "1", "-o", "merged")
        self.assertEqual(program.content(self.folder / "merged/ensemble.h5"), program.content(self.folder / "e/ensemble.h5"))
        again = json.loads(self.run_indet(*with_distances, "-o", "e", "--json").stdout)
        self.assertEqual((again["done"], again["skipped"]), (0, 2))
        runs = table(self.folder / "e/ensemble.h5", "runs")
        contacts = table(self.folder / "e/ensemble.h5", "contacts")
        for row, name in enumerate(runs["member"]):
            self.run_indet("verify", f"e/members/{name.decode()}.h5")
            self.run_indet("analyze", f"e/members/{name.decode()}.h5", "--smallest-distances", "-o", f"{name.decode()}.h5")
            mine = contacts["run"] == row
            with h5py.File(self.folder / f"{name.decode()}.h5") as file:
                ranges = file["ranges"]
                for k, component in enumerate("RT"):
                    smallest = contacts[f"d_{component}_min"][mine]
                    np.testing.assert_array_equal(smallest, ranges[f"d_{component}_min"][()])
                    np.testing.assert_array_equal(contacts[f"d_{component}_min_lower"][mine], ranges["d_min_lower"][:, k])
                    self.assertTrue((smallest <= contacts[f"d_{component}"][mine] * (1 + 1e-9) + 1e-5).all())
                    self.assertGreater((contacts[f"d_{component}"][mine] - smallest).max(), 0.1)
                outcomes = ranges["d_min_outcome"][()]
            self.assertEqual([runs[f"d_min_{name}"][row] for name in ("known", "imprecise", "failed")],
                             [(outcomes == value).sum() for value in (5, 2, 3)])
        count = 2 * len(contacts["run"])
        self.assertEqual(again["smallest_distances"], {"known": count, "imprecise": 0, "failed": 0})
        known = f"{count} of {count} known to 0.1 %, 0 imprecise, 0 failed"
        self.assertIn(f"\nsmallest distances: {known}\n", done.stdout)
        self.run_indet("report", "e")
        self.assertIn(f"Smallest distances: {known}.", (self.folder / "e/report.html").read_text())
        for figure in ("fig08", "fig10"):
            self.assertIn("set title 'smallest distance'", (self.folder / f"e/figures/{figure}.gp").read_text())
        self.assertIn("dR, smallest distance (Fig. 10)", (self.folder / "e/figures/comparison.csv").read_text())
        facts = json.loads(self.run_indet("inspect", "e", "--json").stdout)["facts"]
        self.assertTrue(facts["dR, dT: smallest distance"].startswith(f"mean {contacts['d_R_min'].mean():.1f} "))
        self.assertRegex(facts["smallest over canonical dR"], r"^median 0\.\d\d, ")
        (self.folder / "indet.toml").write_text("[ensemble]\nsmallest-distances = false\n")
        without = json.loads(self.run_indet("--config", "indet.toml", "ensemble", *arguments, "-o", "e", "--json").stdout)
        self.assertEqual(without["done"], 2)
        self.assertNotIn("smallest_distances", without)
        self.assertTrue(np.isnan(table(self.folder / "e/ensemble.h5", "contacts")["d_R_min"]).all())
        (self.folder / "wrong.toml").write_text('[ensemble]\nsmallest-distances = "some"\n')
        done = self.run_indet("--config", "wrong.toml", "ensemble", *arguments, "-o", "f", status=3)
        self.assertIn('wrong.toml:2: smallest-distances: "some" is neither true nor false', done.stderr)

    def test_threads_change_nothing(self):
        for threads in ("1", "3"):
            self.run_indet("ensemble", "--seeds", "1", "--disks", "12", "--samples", "40", "-o", threads,
                           "--threads", threads)
        self.assertEqual(program.content(self.folder / "1/ensemble.h5"), program.content(self.folder / "3/ensemble.h5"))
        self.assertGreater(len(table(self.folder / "1/ensemble.h5", "sampled")["run"]), 0)


class Processes(EnsembleTest):
    """Several of them, killed ones, and what they show."""

    def test_killed_runs_go_on_to_the_same_tables(self):
        self.made_ensemble("whole")
        kills = 0
        for delay in (0.15, 0.4, 0.8, 1.2):
            process = subprocess.Popen([program.INDET, "ensemble", *TINY, "-o", "killed", "--threads", "2"],
                                       cwd=self.folder, stdout=subprocess.DEVNULL)
            time.sleep(delay)
            kills += process.poll() is None
            process.send_signal(signal.SIGKILL)
            process.wait()
        self.assertGreater(kills, 0)
        self.ensemble("killed")
        self.assertEqual(program.content(self.folder / "killed/ensemble.h5"), program.content(self.folder / "whole/ensemble.h5"))
        leftovers = [path for path in (self.folder / "killed").rglob("*.tmp")]
        self.assertEqual(leftovers, [])

    def test_progress_counts_the_packings_that_are_there_already(self):
        arguments = ["ensemble", "--protocols", "md1", "--seeds", "3", "--disks", "50", "--uniform-seeds", "0", "--threads", "1", "-o", "e"]
        self.run_indet(*arguments, "--members", "0")
        here, terminal = pty.openpty()
        process = subprocess.Popen([program.INDET, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        shown = b""
        while b"of 3 packings" not in shown and process.poll() is None:
            shown += os.read(here, 1000)
        self.assertIn(b"1 of 3 packings", shown)
        process.kill()
        process.wait()
        os.close(here)

    def test_processes_share_a_folder(self):
        self.made_ensemble("alone")
        started = [subprocess.Popen([program.INDET, "ensemble", *TINY, "-o", "e", "--threads", "2", "--json"], cwd=self.folder,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(3)]
        for process in started:
            output, error = process.communicate(timeout=120)
            self.assertEqual((process.returncode, error), (0, ""))
            report = json.loads(output)
            self.assertEqual((report["done"] + report["skipped"], report["missing"]), (8, []))
        self.assertEqual(program.content(self.folder / "e/ensemble.h5"), program.content(self.folder / "alone/ensemble.h5"))
        for path in (self.folder / "e/members").iterdir():
            self.assertEqual(program.content(path), program.content(self.folder / "alone/members" / path.name))
        kept = [path for path in (self.folder / "e").rglob("*") if "tasks" not in path.parts]
        self.assertEqual(len(kept), 11)  # two files, the folder, and the members


if __name__ == "__main__":
    program.main()
