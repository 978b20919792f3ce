"""`indet submit` where there is no Slurm: what it writes, what it refuses, and GNU parallel; and `indet status`.

Argument: the indet executable.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

TINY = ["ensemble", "--seeds", "4", "--disks", "12", "--samples", "5", "--protocols", "cd1,md2"]


class Submit(program.ProgramTest):
    def submit(self, *arguments, **more):
        return self.run_indet("submit", *TINY, *arguments, **more)

    def script(self, name, folder="e"):
        return (self.folder / folder / "cluster" / name).read_text()

    def test_the_scripts_are_printed_and_written_and_nothing_is_started(self):
        shown = self.submit("-o", "e", "--tasks", "2").stdout
        for name in ("array.sh", "finish.sh"):
            self.assertIn(self.script(name), shown)
            subprocess.run(["bash", "-n", self.folder / "e/cluster" / name], check=True)
        self.assertIn("nothing was started", shown)
        self.assertEqual(sorted(path.name for path in (self.folder / "e").iterdir()), ["cluster", "ensemble.toml"])

    def test_options_of_the_batch_system(self):
        self.submit("-o", "e", "--tasks", "3", "--partition", "long", "--account", "grains", "--mem", "2G", "--mem-to-collect", "13G", "--cpus", "2", "--time",
                    "1-00:30:00", "--line=--constraint=avx2", "--line=--nice=10")
        lines = self.script("array.sh").splitlines()
        for line in ("--partition=long", "--account=grains", "--mem=2G", "--cpus-per-task=2", "--time=1-00:30:00", "--constraint=avx2",
                     "--nice=10", "--array=1-3", "--requeue", "--open-mode=append", "--signal=B:USR1@75"):
            self.assertIn(f"#SBATCH {line}", lines)
        self.assertIn("#SBATCH --mem=13G", self.script("finish.sh").splitlines())
        self.assertNotIn("--array", self.script("finish.sh"))
        self.assertIn(" report e", self.script("finish.sh"))

    def test_the_command_of_a_task_is_what_was_given(self):
        folder = "it's a $(folder)"
        self.submit("-o", folder, "--limits", "0", "--no-solver-states", "--no-report")
        command = next(line for line in self.script("array.sh", folder).splitlines() if line.endswith("&") and " ensemble " in line)
        words = subprocess.run(["bash", "-c", f"printf '%s\\n' {command[:-1]}"], capture_output=True, text=True, check=True)
        words = words.stdout.splitlines()[1:]
        self.assertEqual(words[0], "ensemble")
        self.assertEqual(words[words.index("--out") + 1], folder)
        self.assertEqual(words[words.index("--protocols") + 1], "cd1,md2")
        self.assertIn("--no-solver-states", words)
        self.assertNotIn("--first-seed", words)
        self.assertNotIn("report", self.script("finish.sh", folder))
        self.run_indet(*words, "--dry-run")

    def test_what_cannot_be_submitted_is_refused(self):
        for arguments, reason in ((["--tasks", "5"], "there are 4 seeds and files to deal"), (["--time", "soon"], "--time soon: expected"),
                                  (["--partition", "a\nrm -rf x"], "must be one line"), (["--jobs", "2"], "--jobs has no effect"),
                                  (["--shard", "1/2"], "no option --shard"), (["--sees", "1"], "did you mean --seeds?")):
            with self.subTest(arguments):
                self.assertIn(reason, self.submit("-o", "e", *arguments, status=2).stderr)
                self.assertFalse((self.folder / "e").exists())
        self.assertIn("subcommand is required", self.run_indet("submit", status=2).stderr)
        (self.folder / "e").mkdir()
        (self.folder / "e/ensemble.h5").write_text("notes of mine")
        self.assertIn("ensemble.h5", self.submit("-o", "e", status=3).stderr)

    def test_without_slurm_it_says_so(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for tool in ("sh", "timeout", "grep"):
            (tools / tool).symlink_to(shutil.which(tool))
        done = program.run([program.INDET, "submit", *TINY, "-o", "e", "--run"], self.folder, os.environ | {"PATH": str(tools)})
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("sbatch", done.stderr)

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed")
    def test_gnu_parallel_computes_the_same(self):
        self.run_indet(*TINY, "-o", "alone")
        report = self.submit("-o", "e f", "--tasks", "3", "--engine", "parallel", "--jobs", "2", "--run", "--json")
        self.assertEqual(json.loads(report.stdout)["tasks"], 3)
        self.assertEqual(program.content(self.folder / "e f/ensemble.h5"), program.content(self.folder / "alone/ensemble.h5"))
        self.assertTrue((self.folder / "e f/report.html").exists())
        status = json.loads(self.run_indet("status", "e f", "--json").stdout)
        self.assertEqual((status["done"], status["starts"], status["collected"]), (8, 4, True))


class Status(program.ProgramTest):
    def test_it_tells_what_is_done_and_what_is_left(self):
        self.run_indet(*TINY, "-o", "e", "--shard", "1/2")
        shown = self.run_indet("status", "e", "--tasks", "2").stdout
        self.assertIn("8 packings: 4 done, 0 running, 0 stale, 0 failed, 4 missing", shown)
        self.assertRegex(shown, r"by stage, of 1 process: .*simulate \d")
        self.assertRegex(shown, r"left: about .* on 2 tasks of 1 thread")
        self.run_indet(*TINY, "-o", "e")
        self.assertIn("collected in e/ensemble.h5", self.run_indet("status", "e", "--watch").stdout)

    def test_what_was_computed_without_a_record_counts(self):
        self.run_indet(*TINY, "-o", "e")
        shutil.rmtree(self.folder / "e/tasks")
        self.assertEqual(json.loads(self.run_indet("status", "e", "--json").stdout)["done"], 8)

    def test_another_configuration_in_the_same_folder_starts_from_nothing(self):
        self.run_indet(*TINY, "-o", "e")
        self.run_indet("submit", *TINY, "--mu", "0.4", "-o", "e")
        status = json.loads(self.run_indet("status", "e", "--json").stdout)
        self.assertEqual((status["done"], status["missing"], status["collected"]), (0, 8, False))

    def test_other_folders_are_refused(self):
        (self.folder / "other").mkdir()
        self.assertIn("other is not the folder of an ensemble", self.run_indet("status", "other", status=3).stderr)


if __name__ == "__main__":
    program.main()
