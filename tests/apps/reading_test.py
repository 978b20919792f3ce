"""A file is opened once on trial, in a process of its own, and once to be read.

Argument: the indet executable.
"""

import ctypes
import os
import pathlib
import struct
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

# inotify.h
IN_CLOSE_NOWRITE, IN_OPEN = 0x10, 0x20
IN_NONBLOCK = 0o4000
EVENT = struct.Struct("iIII")


class Openings:
    """How often any process opens a file. (Closings are watched too: of equal events in a row one is reported.)"""

    def __init__(self, path):
        library = ctypes.CDLL(None, use_errno=True)
        self.descriptor = library.inotify_init1(IN_NONBLOCK)
        mask = IN_OPEN | IN_CLOSE_NOWRITE
        if self.descriptor < 0 or library.inotify_add_watch(self.descriptor, os.fsencode(path), mask) < 0:
            raise OSError(ctypes.get_errno(), "inotify")

    def count(self):
        events = os.read(self.descriptor, 65536)
        os.close(self.descriptor)
        return sum(bool(mask & IN_OPEN) for _, mask, _, _ in EVENT.iter_unpack(events))


class Reading(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.packing(program.groove())
        self.run_indet("analyze", "p.h5")

    def test_a_file_is_opened_once_on_trial_and_once_to_be_read(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "5", "--every", "1", "-o", "s.h5")
        for file, command in [("p.h5", ["inspect", "p.h5"]), ("p.ranges.h5", ["inspect", "p.ranges.h5"]),
                              ("p.ranges.h5", ["verify", "p.ranges.h5"]),
                              ("p.ranges.h5", ["export", "p.ranges.h5", "-o", "p.svg"]),
                              ("p.h5", ["analyze", "p.h5"]), ("p.h5", ["sample", "p.h5", "--method", "uniform"]),
                              ("s.h5", ["trajectory", "s.h5", "-o", "s.svg"])]:
            with self.subTest(command=command):
                openings = Openings(self.folder / file)
                self.run_indet(*command)
                self.assertEqual(openings.count(), 2)

    def test_contacts_of_a_trajectory_join_bodies_that_are_there(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "5", "--every", "1", "-o", "s.h5")
        for name, body in (("body_b", -(2**31)), ("body_b", -9), ("body_b", 5), ("body_a", 5), ("body_a", -1)):
            with h5py.File(self.folder / "s.h5", "r+") as file:
                before = file[f"trajectory/contacts/{name}"][0]
                file[f"trajectory/contacts/{name}"][0] = body
            done = self.run_indet("trajectory", "s.h5", "-o", "s.svg", status=3)
            self.assertRegex(done.stderr, f"/trajectory/contacts: row 0 joins bodies .*{body}.*not both there")
            with h5py.File(self.folder / "s.h5", "r+") as file:
                file[f"trajectory/contacts/{name}"][0] = before

    def test_the_tables_of_an_ensemble_too(self):
        self.run_indet("ensemble", "--seeds", "1", "--disks", "5", "--protocols", "cd1", "--samples", "0",
                       "--uniform-seeds", "0", "-o", "e")
        openings = Openings(self.folder / "e/ensemble.h5")
        self.run_indet("inspect", "e")
        self.assertEqual(openings.count(), 2)


if __name__ == "__main__":
    program.main()
