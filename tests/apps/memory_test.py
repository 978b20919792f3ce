"""A simulation that cannot have the memory that it needs is refused before it begins.

Argument: the indet executable.
"""

import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402


class Memory(program.ProgramTest):
    def bytes_in(self, text):
        number, unit = re.match(r"([\d.]+) (MB|GB)", text).groups()
        return float(number) * {"MB": 2**20, "GB": 2**30}[unit]

    def refusal(self, disks, limit=""):
        """What is needed and what is available, as the message says."""
        done = subprocess.run(f"{limit} '{program.INDET}' simulate --protocol cd1 --disks {disks} -o p.h5", shell=True,
                              cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertEqual(self.files(), [])
        found = re.search(r"a simulation of (\d+) disks takes about (.*) of memory, but (.*) are available", done.stderr)
        self.assertIsNotNone(found, done.stderr)
        self.assertEqual(int(found[1]), disks)
        needed, available = self.bytes_in(found[2]), self.bytes_in(found[3])
        self.assertGreater(needed, available)
        return needed, available

    def test_more_disks_than_the_machine_has_memory_for(self):
        disks = self.too_many()
        needed, available = self.refusal(disks)
        self.assertGreater(needed, 1000 * disks)  # the start alone takes 650 bytes a disk
        self.assertLess(needed, 20000 * disks)
        self.assertLess(available, 2 * self.machine())

    def test_more_disks_than_the_limit_of_address_space_has_room_for(self):
        _, available = self.refusal(2_000_000, "ulimit -v 4000000;")
        self.assertLess(available, 4000000 * 1024)

    def test_an_ensemble_of_such_packings_is_refused_too(self):
        done = self.run_indet("ensemble", "--seeds", "1", "--protocols", "cd1", "--disks", self.too_many(), "-o", "e",
                              status=3)
        self.assertIn("of memory, but", done.stderr)
        self.assertEqual(self.files(), [])

    def test_a_few_disks_are_no_matter(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "5", "-o", "p.h5")

    def too_many(self):
        return 2_000_000_000 if self.machine() > 400 * 2**30 else 100_000_000

    def machine(self):
        text = pathlib.Path("/proc/meminfo").read_text()
        return 1024 * sum(int(re.search(rf"{name}:\s*(\d+)", text)[1]) for name in ("MemTotal", "SwapTotal"))


if __name__ == "__main__":
    program.main()
