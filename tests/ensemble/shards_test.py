"""Shares of an ensemble: by --shard, as a task of a Slurm array, within a time budget, and stopped.

Argument: the indet executable.
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

TINY = ["ensemble", "--seeds", "4", "--disks", "12", "--samples", "5", "--protocols", "cd1,md2"]


def task(number, first=1, last=3, count=3, step=1, **more):
    """The environment of a task of a Slurm array, outside of a job with a limit."""
    names = {"ID": number, "MIN": first, "MAX": last, "COUNT": count, "STEP": step}
    return os.environ | {f"SLURM_ARRAY_TASK_{name}": str(value) for name, value in names.items()} | more


class Shards(program.ProgramTest):
    def members(self, folder):
        return sorted(path.stem for path in (self.folder / folder / "members").iterdir())

    def record(self, folder):
        return json.loads(next((self.folder / folder / "tasks").iterdir()).read_text())

    def test_shards_hold_each_seed_once_and_give_the_result_of_one_run(self):
        self.run_indet(*TINY, "-o", "alone")
        before = set()
        for number in (1, 2, 3):
            shown = self.run_indet(*TINY, "-o", "e", "--shard", f"{number}/3").stdout
            self.assertIn(f"shard {number}/3: ", shown)
            self.assertFalse((self.folder / "e/ensemble.h5").exists())
            new = set(self.members("e")) - before
            self.assertEqual({name.split("-")[1] for name in new if name.startswith("cd1")},
                             {name.split("-")[1] for name in new if name.startswith("md2")})
            before |= new
        self.assertEqual(len(before), 8)
        self.assertIn("8 there already", self.run_indet(*TINY, "-o", "e").stdout)
        self.assertEqual(program.content(self.folder / "e/ensemble.h5"), program.content(self.folder / "alone/ensemble.h5"))

    def test_a_task_of_an_array_does_its_share(self):
        done = self.run_indet(*TINY, "-o", "e", environment=task(5, first=1, last=5, step=2, SLURM_CPUS_PER_TASK="3",
                                                                 SLURM_ARRAY_JOB_ID="117", SLURMD_NODENAME="node2"))
        self.assertIn("shard 3/3: 2 computed", done.stdout)
        self.assertIn("--shard 3/3, as this is task 5 of a Slurm array", done.stderr)
        record = self.record("e")
        self.assertEqual((record["shard"], record["threads"], record["job"]), ("shard 3/3", 3, "117_5 on node2"))
        self.run_indet(*TINY, "-o", "whole", "--shard", "1/1", environment=task(2))
        self.assertTrue((self.folder / "whole/ensemble.h5").exists())

    def test_what_says_no_share_is_refused(self):
        gaps = self.run_indet(*TINY, "-o", "e", environment=task(7, first=3, last=7, count=2), status=2).stderr
        self.assertIn("has gaps", gaps)
        for text in ("0/3", "4/3", "3", "1/0", "one"):
            self.assertIn("expected K/N", self.run_indet(*TINY, "-o", "e", "--shard", text, status=2).stderr)
        self.assertIn("do not go together",
                      self.run_indet(*TINY, "-o", "e", "--shard", "1/2", "--members", "0", status=2).stderr)
        self.assertEqual(self.files(), [])

    def test_a_short_time_budget_leaves_the_rest_open(self):
        shown = self.run_indet(*TINY, "-o", "e", "--time-budget", "1e-9", "--threads", "1", status=6).stdout
        self.assertIn("1 computed, 0 there already, 0 failed, 7 left for want of time", shown)
        self.assertEqual(self.record("e")["state"], "out of time")
        self.assertTrue(self.record("e")["got_further"])
        self.run_indet(*TINY, "-o", "e", "--time-budget", "0")
        self.assertEqual(len(self.members("e")), 8)

    def test_usr1_stops_as_term_does(self):
        process = subprocess.Popen([program.INDET, "ensemble", "--seeds", "200", "-o", "e"], cwd=self.folder, stderr=subprocess.PIPE,
                                   text=True)
        self.addCleanup(process.kill)
        program.wait_until_under_way(process, signal.SIGUSR1, 0.5)
        process.send_signal(signal.SIGUSR1)
        _, errors = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 143, errors)
        self.assertIn("the same command goes on", errors)
        self.assertEqual(self.record("e")["state"], "stopped")


if __name__ == "__main__":
    program.main()
