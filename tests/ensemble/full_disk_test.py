"""Ensembles on full and read-only disks: the file and the reason are named, and the same command goes on once it can.

Arguments: the indet executable. Status 77 (skipped) where no file system can be mounted.
"""

import contextlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program
from mounting import mount_namespace

ENSEMBLE = ["ensemble", "--seeds", "2", "--protocols", "cd1,md2", "--disks", "12", "--samples", "5"]
MEMBERS = 4
INSIDE = "--inside"  # of a mount namespace
SKIPPED = 77


def mount(*arguments):
    subprocess.run(["mount", *map(str, arguments)], check=True)


class Disks(program.ProgramTest):
    """In the folder "small", a file system of its own."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        done = program.run([program.INDET, *ENSEMBLE, "-o", "alone"], folder.name)
        assert done.returncode == 0, done.stderr
        cls.alone = program.content(pathlib.Path(folder.name) / "alone/ensemble.h5")

    def setUp(self):
        super().setUp()
        self.small = self.folder / "small"
        self.small.mkdir()

    @contextlib.contextmanager
    def mounted(self, options):
        mount("-t", "tmpfs", "-o", options, "none", self.small)
        try:
            yield
        finally:
            subprocess.run(["umount", "--recursive", str(self.small)], check=True)

    def allow(self, option, folder=""):
        mount("-o", f"remount,{option}", self.small / folder)

    def ensemble(self, *more, status=0):
        return self.run_indet(*ENSEMBLE, "-o", "small/F", *more, status=status)

    def count(self):
        shown = json.loads(self.run_indet("status", "small/F", "--json").stdout)
        return {key: shown[key] for key in ("done", "running", "stale")} | {"open": shown["failed"] + shown["missing"]}

    def check_the_end(self, done):
        self.assertEqual(done.stderr, "")
        self.assertEqual(program.content(self.small / "F/ensemble.h5"), self.alone)

    def check_whole(self):
        """What has its name is whole, and nothing else is there."""
        there = [path.name for path in (self.small / "F").rglob("*") if path.is_file() and path.parent.name != "tasks"]
        for name in there:
            self.assertRegex(name, r"^(ensemble\.toml|\w+-\d+\.h5)$")
            if name.endswith(".h5"):
                self.run_indet("verify", f"small/F/members/{name}")
        return len(there) - 1

    def test_a_full_disk_leaves_the_packings_open(self):
        seen = set()
        for kilobytes in (4, 100, 300, 600):
            with self.subTest(kilobytes=kilobytes), self.mounted(f"size={kilobytes}k"):
                stopped = self.ensemble("--threads", "1", status=1)
                self.assertRegex(stopped.stderr.splitlines()[-1],
                                 r"^indet: small/F/(members/\w+-\d+|ensemble)\.h5: writing failed \(No space left on device\)$")
                done = self.check_whole()
                seen.add(done)
                self.assertEqual(self.count(), {"done": done, "running": 0, "stale": 0, "open": MEMBERS - done})
                self.allow("size=40m")
                self.check_the_end(self.ensemble())
        self.assertEqual((min(seen), max(seen), len(seen)), (0, MEMBERS, 3))

    def test_a_disk_without_room_for_names_leaves_the_packings_open(self):
        with self.mounted("size=40m,nr_inodes=6"):  # the root, F, ensemble.toml, tasks and a record in it, members
            stopped = self.ensemble(status=1)
            self.assertRegex(stopped.stderr.splitlines()[-1], r"^indet: small/F/members/.*: writing failed \(No space left on device\)$")
            self.allow("nr_inodes=100")
            self.check_the_end(self.ensemble())

    def test_a_read_only_folder_is_refused_before_anything_is_computed(self):
        with self.mounted("size=40m"):
            self.allow("ro")
            for command in (ENSEMBLE, ["submit", *ENSEMBLE]):
                refused = self.run_indet(*command, "-o", "small/F", status=3)
                self.assertRegex(refused.stderr, r"^indet: small/F\S*: cannot be written \(Read-only file system\)\n$")
            self.allow("rw")
            self.ensemble("--members", "0-1")
            records = os.listdir(self.small / "F/tasks")
            self.allow("ro")
            for more in ([], ["--shard", "1/2"]):
                refused = self.ensemble(*more, status=3)
                self.assertEqual(refused.stderr, "indet: small/F/ensemble.toml: cannot be written (Read-only file system)\n")
            self.assertEqual(os.listdir(self.small / "F/tasks"), records)
            self.assertEqual(self.count(), {"done": 2, "running": 0, "stale": 0, "open": 2})
            self.allow("rw")
            self.freeze_members()
            refused = self.ensemble(status=3)
            self.assertEqual(refused.stderr, "indet: small/F/members: cannot be written (Read-only file system)\n")
            self.allow("rw,bind", "F/members")
            self.check_the_end(self.ensemble())

    def test_a_folder_that_takes_no_more_files_ends_the_run(self):
        """Else each packing would fail on its own, after it was computed."""
        with self.mounted("size=40m"):
            process = subprocess.Popen([program.INDET, "ensemble", "--protocols", "md1", "--seeds", "40", "--disks", "30",
                                        "--samples", "5", "-o", "small/F"],
                                       cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            program.wait_until_under_way(process, signal.SIGTERM, 0.1)
            self.freeze_members()
            _, errors = process.communicate(timeout=120)
            self.assertEqual(process.returncode, 3, errors)
            self.assertRegex(errors, r"^indet: small/F/members/md1-\d+\.h5: cannot be written \(.*\)\n$")

    def freeze_members(self):
        members = self.small / "F/members"
        mount("--bind", members, members)
        self.allow("ro,bind", "F/members")


if __name__ == "__main__":
    if INSIDE in sys.argv:
        sys.argv.remove(INSIDE)
        program.main()
    namespace = mount_namespace()
    if namespace is None:
        print("skipped: no right to mount a file system")
        sys.exit(SKIPPED)
    os.execvp(namespace[0], [*namespace, sys.executable, *sys.argv, INSIDE])
