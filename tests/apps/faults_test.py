"""Faults: damaged files, full and read-only disks, signals at random moments.

Always a message on stderr, the exit status that the README promises, and no file that is not whole.
Arguments: the indet executable, the LAMMPS dumps.
"""

import json
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402
from mounting import mount_namespace  # noqa: E402
from program import ProgramTest, groove, pyramid, run  # noqa: E402

LAMMPS = ""  # the folder with the dumps


MOUNT = mount_namespace()


class DamagedFiles(ProgramTest):
    def check(self, data, what):
        """Every subcommand that reads refuses the file, or reads what it always read; it never crashes."""
        file = self.folder / "damaged.h5"
        file.write_bytes(data)
        for command in (["inspect"], ["verify"], ["analyze", "-o", "out.h5"]):
            done = run([program.INDET, command[0], "damaged.h5", *command[1:]], self.folder)
            self.assertIn(done.returncode, (0, 1, 3, 4, 5), f"{what}: {command[0]}: {done.returncode} {done.stderr}")
            if done.returncode in (1, 3):
                self.assertTrue(done.stderr.startswith("indet: "), what)
                self.assertFalse((self.folder / "out.h5").exists(), what)
            (self.folder / "out.h5").unlink(missing_ok=True)
        return done

    def whole_file(self):
        packing = self.packing(pyramid())
        self.run_indet("analyze", packing, "-o", "r.h5")
        return (self.folder / "r.h5").read_bytes()

    def test_a_truncated_file_is_refused_at_any_length(self):
        data = self.whole_file()
        chance = random.Random(1)
        for length in [0, 1, 8, 96, len(data) - 1, *(chance.randrange(len(data)) for _ in range(6))]:
            done = self.check(data[:length], f"cut to {length} bytes")
            self.assertEqual(done.returncode, 3, f"cut to {length} bytes: {done.stderr}")

    def test_flipped_bits_never_crash(self):
        data = self.whole_file()
        chance = random.Random(2)
        for number in range(25):
            flipped = bytearray(data)
            place = chance.randrange(len(data))
            flipped[place] ^= 1 << chance.randrange(8)
            self.check(bytes(flipped), f"case {number}: bit of byte {place}")

    def test_headers_that_the_library_stumbles_over_are_refused(self):
        """HDF5 1.10 crashes on two of these, and reads the third for ever; all were found by fuzzing."""
        for file in sorted((pathlib.Path(LAMMPS).parent / "forged").iterdir()):
            shutil.copy(file, self.folder / "forged.h5")
            commands = [["inspect"], ["verify"], ["analyze", "-o", "out.h5"]]
            # Each of these waits until the time for a trial is over.
            for command in commands[-1:] if file.name == "endless.h5" else commands:
                done = run([program.INDET, command[0], "forged.h5", *command[1:]], self.folder)
                self.assertEqual(done.returncode, 3, f"{file.name}: {command[0]}: {done.stderr}")
                self.assertTrue(done.stderr.startswith("indet: forged.h5: "), done.stderr)
                self.assertEqual(self.files(), ["forged.h5"])

    def test_such_headers_are_refused_in_the_folder_of_an_ensemble(self):
        ensemble = ["ensemble", "--protocols", "cd1,md2", "--seeds", "1", "--disks", "6", "--samples", "0",
                    "--uniform-seeds", "0", "--no-solver-states", "-o", "e"]
        self.run_indet(*ensemble)
        shutil.copy(pathlib.Path(LAMMPS).parent / "forged/type.h5", self.folder / "e/members/md2-0000.h5")
        for command in (ensemble, ["merge", "e", "-o", "m"], ["report", "e"]):
            done = self.run_indet(*command, status=3)
            self.assertTrue(done.stderr.startswith("indet: e/members/md2-0000.h5: the file is damaged"), done.stderr)
        self.assertEqual(self.files(), ["e"])
        self.assertEqual(list((self.folder / "e").glob("report*")), [])
        (self.folder / "e/members/md2-0000.h5").unlink()
        again = json.loads(self.run_indet(*ensemble, "--json").stdout)
        self.assertEqual((again["done"], again["skipped"]), (1, 1))

    def test_wrong_types_and_shapes_are_refused_with_their_place(self):
        data = self.whole_file()

        def change(name, make):
            (self.folder / "damaged.h5").write_bytes(data)
            with h5py.File(self.folder / "damaged.h5", "r+") as file:
                old = file[name]
                attributes, value = dict(old.attrs), old[()]
                del file[name]
                new = make(file, name, value)
                for key, attribute in attributes.items():
                    new.attrs[key] = attribute
            done = run([program.INDET, "inspect", "damaged.h5"], self.folder)
            self.assertEqual(done.returncode, 3, f"{name}: {done.stdout}")
            self.assertIn(name.rsplit("/", 1)[-1], done.stderr)

        change("/contacts/normal", lambda f, n, v: f.create_dataset(n, data=v.astype("S8")))
        change("/contacts/normal", lambda f, n, v: f.create_dataset(n, data=v[:-1]))
        change("/contacts/normal", lambda f, n, v: f.create_dataset(n, data=v.ravel()))
        change("/particles/disks/mass", lambda f, n, v: f.create_dataset(n, data=v.reshape(-1, 1)))
        change("/contacts/body_a", lambda f, n, v: f.create_dataset(n, data=v.astype(float)))
        # 2^60 numbers that the file does not hold.
        change("/particles/disks/mass",
               lambda f, n, v: f.create_dataset(n, shape=(1 << 60,), chunks=(1 << 10,), dtype="f8"))
        change("/contacts/mu", lambda f, n, v: f.create_group(n))


@unittest.skipUnless(MOUNT, "no right to mount a file system")
class Disks(ProgramTest):
    def mounted(self, options, script):
        """Runs a script in a folder "small" that is a file system of its own."""
        (self.folder / "small").mkdir(exist_ok=True)
        return subprocess.run([*MOUNT, "sh", "-c", f"mount -t tmpfs {options} none small && {script}"], cwd=self.folder,
                              capture_output=True, text=True, timeout=120, check=False)

    def test_a_full_disk_leaves_nothing(self):
        packing = self.packing(groove())
        for size in ("4k", "8k", "16k", "24k"):
            done = self.mounted(f"-o size={size}", f"'{program.INDET}' analyze {packing} -o small/r.h5; "
                                                   "echo status $?; ls -A small")
            self.assertEqual(done.stdout, "status 1\n", size + done.stdout + done.stderr)
            self.assertIn("small/r.h5", done.stderr)

    def test_a_full_disk_leaves_the_file_that_was_there(self):
        packing = self.packing(groove())
        done = self.mounted("-o size=16k", f"echo old > small/r.h5; '{program.INDET}' analyze {packing} -o small/r.h5 --overwrite; "
                                           "echo status $?; cat small/r.h5; ls -A small")
        self.assertEqual(done.stdout, "status 1\nold\nr.h5\n", done.stderr)

    def test_output_that_is_lost_is_an_error(self):
        packing = self.packing(groove())
        ranges = self.folder / "lost.r.h5"
        subcommands = re.findall(r"^  ([a-z]+) {2,}", subprocess.run([program.INDET, "--help"], capture_output=True, text=True,
                                                                    check=True).stdout.split("Subcommands:")[-1], re.MULTILINE)
        self.assertGreater(len(subcommands), 10)
        commands = [[name, "--help"] for name in subcommands] + [
            ["--version"], ["analyze", packing, "-o", ranges, "--overwrite"], ["analyze", packing, "-o", ranges, "--overwrite", "--json"],
            ["inspect", packing], ["inspect", packing, "--json"], ["compare", packing], ["verify", ranges]]
        for command in commands:
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = subprocess.run([program.INDET, *map(str, command)], stdout=full, stderr=subprocess.PIPE, text=True,
                                      timeout=120, check=False, cwd=self.folder)
            self.assertEqual(done.returncode, 1, command)
            self.assertIn("No space left on device", done.stderr)

    def test_a_read_only_folder_is_bad_input(self):
        packing = self.packing(groove())
        done = self.mounted("-o ro", f"'{program.INDET}' analyze {packing} -o small/r.h5; echo status $?")
        self.assertEqual(done.stdout, "status 3\n", done.stderr)
        self.assertIn("small/r.h5", done.stderr)


# An analysis that takes a second and goes through all stages.
SOME = ["analyze", "p.h5", "--contacts", "sample:60"]


class LammpsPacking(ProgramTest):
    def setUp(self):
        super().setUp()
        self.run_indet("import", "--format", "lammps", "--atoms", f"{LAMMPS}/atoms.dump", "--contacts",
                       f"{LAMMPS}/contacts.dump", "--friction", "0.3", "-o", "p.h5")


class Memory(LammpsPacking):
    def test_a_limit_of_memory_never_hangs(self):
        if b"__asan_init" in pathlib.Path(program.INDET).read_bytes():
            self.skipTest("AddressSanitizer reserves terabytes")
        seen = set()
        for megabytes in (160, 200, 250, 300, 2000):
            limit = megabytes << 20
            done = subprocess.run([program.INDET, "--threads", "2", *SOME, "-o", "r.h5"], cwd=self.folder,
                                  capture_output=True, text=True, timeout=60, check=False,
                                  preexec_fn=lambda limit=limit: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            seen.add(done.returncode)
            self.assertIn(done.returncode, (0, 1), f"{megabytes} MB: {done.returncode} {done.stderr}")
            if done.returncode == 1:
                self.assertTrue(done.stderr.startswith("indet: "), f"{megabytes} MB: {done.stderr}")
                self.assertEqual(self.files(), ["p.h5"], megabytes)
            (self.folder / "r.h5").unlink(missing_ok=True)
        self.assertEqual(seen, {0, 1})


class Interruptions(LammpsPacking):

    def test_signals_at_random_moments(self):
        chance = random.Random(3)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL) * 3:
            process = subprocess.Popen([program.INDET, *SOME, "-o", "r.h5"], cwd=self.folder,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(chance.uniform(0, 0.8))
            process.send_signal(number)
            _, errors = process.communicate(timeout=120)
            allowed = {0, -signal.SIGKILL} if number == signal.SIGKILL else {0, 128 + number, -number}
            self.assertIn(process.returncode, allowed, errors)
            if process.returncode == 128 + number:
                self.assertIn("nothing was written", errors)
                self.assertEqual(self.files(), ["p.h5"])
            if (self.folder / "r.h5").exists():
                self.run_indet("inspect", "r.h5")
            for left in self.folder.glob(".r.h5.*"):
                self.assertEqual(number, signal.SIGKILL)
                left.unlink()
            (self.folder / "r.h5").unlink(missing_ok=True)

    def test_the_input_may_vanish_once_it_is_read(self):
        process = subprocess.Popen([program.INDET, *SOME, "-o", "r.h5"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        time.sleep(0.5)
        (self.folder / "p.h5").rename(self.folder / "q.h5")
        (self.folder / "p.h5").write_bytes(b"something else")
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, errors)
        self.run_indet("inspect", "r.h5")


if __name__ == "__main__":
    program.main("LAMMPS")
