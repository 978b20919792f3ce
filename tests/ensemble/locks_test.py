"""Ensembles on a file system that refuses locks.

Arguments: the indet executable, the library that is preloaded for that (no_locks.cc).
"""

import errno
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

NO_LOCKS = ""
ENOTSUPP = 524  # of the kernel, from NFS among others; it has no name in C
TINY = ["ensemble", "--seeds", "1", "--protocols", "cd1,md2", "--disks", "12", "--samples", "5"]


def without_locks(number, **more):
    return {**os.environ, "LD_PRELOAD": NO_LOCKS, "FLOCK_ERRNO": str(number), **more}


class Locks(program.ProgramTest):
    def run_without_locks(self, number, *arguments, status=0, **more):
        done = program.run([program.INDET, *arguments], self.folder, without_locks(number, **more))
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_locks_are_refused(self):
        for number in (errno.ENOLCK, ENOTSUPP):
            for function in ("flock", "lockf"):
                script = f"import fcntl, os\ntry: fcntl.{function}(os.open('.', os.O_RDONLY), fcntl.LOCK_SH)\nexcept OSError as e: print(e.errno)"
                done = program.run([sys.executable, "-c", script], self.folder, without_locks(number))
                self.assertEqual((done.stdout, done.stderr), (f"{number}\n", ""))

    def test_files_are_read_without_locks(self):
        for number in (errno.ENOLCK, ENOTSUPP):
            folder = f"e{number}"
            done = self.run_without_locks(number, *TINY, "-o", folder)
            self.assertIn("2 packings: 2 computed, 0 there already, 0 failed", done.stdout)
            self.assertNotIn("missing", done.stdout)
            self.assertIn("0 computed, 2 there already", self.run_without_locks(number, *TINY, "-o", folder).stdout)
            self.run_without_locks(number, "merge", folder, "-o", f"m{number}")
            self.run_without_locks(number, "inspect", folder)
            self.run_without_locks(number, "verify", f"{folder}/members/md2-0000.h5")
            self.run_without_locks(number, "report", folder)

    def test_two_processes_on_one_share(self):
        """As when a scheduler starts a task again whose first start still runs."""
        arguments = ["ensemble", "--seeds", "4", "--protocols", "cd1,md2", "--disks", "12", "--samples", "5"]
        self.run_indet(*arguments, "-o", "alone")
        for number in (errno.ENOLCK, ENOTSUPP):
            folder = f"e{number}"
            share = [program.INDET, *arguments, "-o", folder, "--shard", "1/2", "--threads", "1"]
            started = [subprocess.Popen(share, cwd=self.folder, env=without_locks(number), text=True, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE) for _ in range(2)]
            for process in started:
                output, errors = process.communicate(timeout=120)
                self.assertEqual((process.returncode, errors), (0, ""))
                self.assertIn(" 0 failed", output)
            members = os.listdir(self.folder / folder / "members")
            self.assertEqual(len(members), 4)
            rest = self.run_without_locks(number, *arguments, "-o", folder)
            self.assertIn("8 packings: 4 computed, 4 there already, 0 failed", rest.stdout)
            self.assertEqual(rest.stderr, "")
            for path in ["ensemble.h5", *(f"members/{name}" for name in members)]:
                self.assertEqual(program.content(self.folder / folder / path), program.content(self.folder / "alone" / path))

    def test_a_file_that_cannot_be_read_is_named_with_the_reason(self):
        done = self.run_without_locks(errno.ENOLCK, *TINY, "-o", "e", status=5, HDF5_USE_FILE_LOCKING="TRUE")
        self.assertIn("missing: cd1-0000", done.stdout)
        self.assertRegex(done.stderr, r"warning: e/members/cd1-0000\.h5: cannot be opened as an HDF5 file \(.*lock file")


if __name__ == "__main__":
    program.main("NO_LOCKS")
