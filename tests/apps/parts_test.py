"""The analysis of one packing by several processes: indet analyze --out FOLDER --shard K/N, and indet merge.

Argument: the indet executable.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

BARRIER = ["--method", "barrier"]


def texts(path):
    with h5py.File(path) as file:
        return file.attrs["text_sha256"]


class Parts(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        """30 disks that all tests begin with; simulated once."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.packings = pathlib.Path(folder.name)
        for seed in (0, 1):
            program.run([program.INDET, "simulate", "--protocol", "cd1", "--disks", "30", "--seed", str(seed), "-o", f"{seed}.h5"],
                        cls.packings)

    def setUp(self):
        super().setUp()
        for seed, name in enumerate(("p.h5", "q.h5")):
            shutil.copy(self.packings / f"{seed}.h5", self.folder / name)

    def analyze(self, *arguments, **more):
        return self.run_indet("analyze", "p.h5", *BARRIER, *arguments, **more)

    def chunks(self, folder="f"):
        return sorted(path.name for path in (self.folder / folder / "chunks").iterdir())

    def expect_same(self, one, other):
        self.assertEqual(program.content(self.folder / one), program.content(self.folder / other))
        self.assertEqual(texts(self.folder / one), texts(self.folder / other))

    def test_shards_joined_are_one_analysis(self):
        self.analyze("-o", "whole.h5")
        seen = set()
        for number in (1, 2):
            shown = self.analyze("--out", "f", "--shard", f"{number}/2").stdout
            self.assertIn(f"shard {number}/2: ", shown)
            self.assertIn("without --shard joins the parts", shown)
            self.assertTrue(seen < set(self.chunks()))
            seen = set(self.chunks())
        self.assertFalse((self.folder / "f/ranges.h5").exists())
        shown = self.analyze("--out", "f").stdout
        self.assertIn("written to f/ranges.h5", shown)
        self.expect_same("f/ranges.h5", "whole.h5")
        self.assertEqual(self.run_indet("verify", "f/ranges.h5", "--json").returncode, 0)
        self.run_indet("merge", "f", "-o", "merged.h5")
        self.expect_same("merged.h5", "whole.h5")
        self.assertIn(f"{len(seen)} parts: {len(seen)} done", self.run_indet("status", "f").stdout)

    def test_a_chunk_is_an_ordinary_file_of_ranges(self):
        self.analyze("--out", "f", "--shard", "1/100")
        (chunk,) = self.chunks()
        first, last = (int(number) for number in chunk.removesuffix(".h5").split("-")[1:])
        self.analyze("--contacts", f"{first}-{last}", "--reactions", "all" if first == 0 else "none", "-o", "c.h5")
        self.expect_same(f"f/chunks/{chunk}", "c.h5")
        self.assertIn(f"{last - first + 1} of 50 contacts (a list)", self.run_indet("inspect", f"f/chunks/{chunk}").stdout)

    def test_states_distances_and_multipliers_are_joined(self):
        for number, more in enumerate((["--extremal-states", "canonical", "--smallest-distances"],
                                       ["--extremal-states", "canonical", "--states-of", "3,20"],
                                       ["--duals", "sample:5", "--seed", "3"],
                                       ["--contacts", "1-20,30", "--gap", "1e-4"])):
            with self.subTest(more):
                self.analyze(*more, "-o", "whole.h5")
                self.analyze(*more, "--out", f"f{number}", "--threads", "2")
                self.expect_same(f"f{number}/ranges.h5", "whole.h5")

    def test_folders_of_several_machines_are_merged(self):
        self.analyze("-o", "whole.h5")
        for number in (1, 2):
            self.analyze("--out", f"f{number}", "--shard", f"{number}/2")
        missing = self.run_indet("merge", "f1", "-o", "merged.h5", status=3).stderr
        self.assertIn("parts are missing", missing)
        self.assertIn("contacts-0", missing)
        self.run_indet("merge", "f1", "f2", "-o", "merged.h5")
        self.expect_same("merged.h5", "whole.h5")
        self.analyze("--gap", "1e-3", "--out", "other", "--shard", "1/100")
        self.assertIn("different analyses", self.run_indet("merge", "f1", "other", "-o", "m.h5", status=3).stderr)
        self.assertIn("no effect", self.run_indet("merge", "f1", "--allow-missing", "-o", "m.h5", status=2).stderr)

    def test_what_is_there_is_not_computed_again(self):
        self.analyze("--out", "f", "--shard", "1/2")
        times = {name: (self.folder / "f/chunks" / name).stat().st_mtime_ns for name in self.chunks()}
        damaged = self.chunks()[0]
        (self.folder / "f/chunks" / damaged).write_bytes(b"\x89HDF\r\n\x1a\n and no more")
        done = self.analyze("--out", "f")
        self.assertIn(damaged, done.stderr)
        self.assertIn("it is computed again", done.stderr)
        for name, time in times.items():
            self.assertEqual((self.folder / "f/chunks" / name).stat().st_mtime_ns == time, name != damaged)
        self.analyze("-o", "whole.h5")
        self.expect_same("f/ranges.h5", "whole.h5")

    def test_several_processes_on_one_shard(self):
        self.analyze("-o", "whole.h5")
        command = [program.INDET, "analyze", "p.h5", *BARRIER, "--out", "f", "--shard", "1/1", "--quiet", "--threads", "1"]
        processes = [subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True) for _ in range(3)]
        for process in processes:
            self.assertEqual(process.communicate(timeout=60)[1], "")
            self.assertEqual(process.returncode, 0)
        self.expect_same("f/ranges.h5", "whole.h5")
        self.assertEqual([path for path in self.files() if path.endswith(".tmp")], [])

    def test_a_short_time_budget_leaves_the_rest_open(self):
        shown = self.analyze("--out", "f", "--time-budget", "1e-9", "--threads", "1", status=6).stdout
        self.assertIn("1 computed, 0 there already, 0 failed", shown)
        self.assertIn("left for want of time", shown)
        record = json.loads(next((self.folder / "f/tasks").iterdir()).read_text())
        self.assertEqual((record["state"], record["got_further"]), ("out of time", True))
        self.analyze("--out", "f", "--time-budget", "0")

    def test_a_stopped_process_is_gone_on_with(self):
        long = ["--extremal-states", "canonical", "--smallest-distances", "--out", "f", "--threads", "1"]
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "60", "--quiet", "-o", "p.h5", "--overwrite")
        process = subprocess.Popen([program.INDET, "analyze", "p.h5", *BARRIER, *long], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        program.wait_until_under_way(process, signal.SIGTERM, 0.3)
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 143, errors)
        self.assertIn("the same command goes on", errors)
        self.assertFalse((self.folder / "f/ranges.h5").exists())
        self.analyze(*long)
        self.analyze(*long[:-4], "-o", "whole.h5")
        self.expect_same("f/ranges.h5", "whole.h5")

    def test_a_task_of_an_array_does_its_share(self):
        names = {"ID": 2, "MIN": 1, "MAX": 2, "COUNT": 2}
        array = os.environ | {f"SLURM_ARRAY_TASK_{name}": str(value) for name, value in names.items()}
        self.assertIn("shard 2/2: ", self.analyze("--out", "f", environment=array).stdout)
        self.analyze("-o", "whole.h5", environment=array)  # has no shares
        self.assertTrue((self.folder / "whole.h5").exists())

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not there")
    def test_a_submitted_analysis_is_one_analysis(self):
        self.analyze("-o", "whole.h5")
        submit = ["submit", "analyze", "p.h5", *BARRIER, "--out", "f", "--engine", "parallel"]
        self.assertIn("4 parts, about", self.run_indet(*submit, "--tasks", "2").stdout)
        self.assertIn("there are 4 parts to deal", self.run_indet(*submit, "--tasks", "5", status=2).stderr)
        self.run_indet(*submit, "--tasks", "2", "--run")
        self.expect_same("f/ranges.h5", "whole.h5")
        records = [json.loads(path.read_text()) for path in (self.folder / "f/tasks").iterdir()]
        self.assertEqual({record["shard"] for record in records}, {"shard 1/2", "shard 2/2"})

    def test_a_folder_of_another_analysis_is_left_alone(self):
        self.analyze("--out", "f", "--shard", "1/100")
        self.assertIn("has other options", self.analyze("--gap", "1e-3", "--out", "f", status=3).stderr)
        self.assertIn("of another packing", self.run_indet("analyze", "q.h5", *BARRIER, "--out", "f", status=3).stderr)
        self.run_indet("analyze", "q.h5", *BARRIER, "--out", "f", "--overwrite")
        self.run_indet("analyze", "q.h5", *BARRIER, "-o", "whole.h5")
        self.expect_same("f/ranges.h5", "whole.h5")
        (self.folder / "own").mkdir()
        (self.folder / "own/analysis.toml").write_text("mine\n")
        self.assertIn("own/analysis.toml", self.analyze("--out", "own", status=3).stderr)
        self.assertEqual((self.folder / "own/analysis.toml").read_text(), "mine\n")

    def test_what_cannot_be_dealt_is_refused_and_writes_nothing(self):
        for more, reason in ((["--out", "f"], "with --method barrier it does not"),
                             (["--out", "f", "--method", "lp"], "with --method barrier it does not"),
                             (["--out", "f", "--accuracy", "estimate"], "calibration"),
                             (["--out", "f", "--accuracy", "exact"], "together"),
                             (["--out", "f", *BARRIER, "--contacts", "sample:3"], "drawn"),
                             (["--out", "f", *BARRIER, "--extremal-states", "canonical", "--states-of", "largest:3"], "largest"),
                             (["--out", "f", *BARRIER, "-o", "r.h5"], "do not go together"),
                             (["--shard", "1/2"], "no effect without --out"),
                             (["--time-budget", "5"], "no effect without --out")):
            with self.subTest(more):
                self.assertIn(reason, self.run_indet("analyze", "p.h5", *more, status=2).stderr)
        for scene, reason in ((program.groove(angle=1.4), "without limit"), (program.incline(), "admissible")):
            packing = self.packing(scene, reason.replace(" ", "-"))
            self.assertIn(reason, self.run_indet("analyze", packing, *BARRIER, "--out", "f", status=3).stderr)
        self.assertFalse((self.folder / "f").exists())


if __name__ == "__main__":
    program.main()
