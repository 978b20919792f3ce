"""--quiet prints nothing but warnings and errors, whatever the subcommand.

Argument: the indet executable.
"""

import json
import pathlib
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program


class Quiet(program.ProgramTest):
    # Every subcommand but completion, whose script is asked for; each runs on what those before it left.
    COMMANDS = [
        ["simulate", "--protocol", "cd2", "--disks", "6", "--every", "1", "-o", "s.h5"],
        ["simulate", "--protocol", "cd2", "--from", "s.h5", "--tilt-rate", "1", "--tilt-limit", "0.5", "-o", "t.h5"],
        ["import", "--format", "csv", "p", "-o", "p.h5"],
        ["analyze", "p.h5"],
        ["analyze", "p.h5", "--method", "pivoting-paper", "--contacts", "sample:2", "-o", "r.h5"],
        ["limit", "p.h5", "--tilt", "--steps", "1"],
        ["compare", "p.h5"],
        ["inspect", "p.ranges.h5"],
        ["inspect", "s.h5"],
        ["verify", "p.ranges.h5", "--exact"],
        ["sample", "s.h5", "--samples", "2"],
        ["sample", "p.h5", "--method", "uniform", "--shape"],
        ["export", "p.ranges.h5", "-o", "p.svg"],
        ["trajectory", "s.h5", "-o", "t.svg"],
        ["ensemble", "--seeds", "1", "--disks", "6", "--samples", "0", "--dry-run", "-o", "e"],
        ["ensemble", "--seeds", "1", "--disks", "6", "--samples", "0", "-o", "e"],
        ["ensemble", "--seeds", "1", "--disks", "6", "--samples", "0", "--members", "0", "-o", "part"],
        ["ensemble", "--seeds", "1", "--disks", "6", "--samples", "0", "--shard", "1/2", "-o", "part"],
        ["submit", "ensemble", "--seeds", "1", "--disks", "6", "--samples", "0", "-o", "submitted"],
        ["status", "e"],
        ["merge", "e", "-o", "m"],
        ["inspect", "e"],
        ["report", "e"],
    ]

    def test_every_subcommand_is_quiet(self):
        self.write("p", program.pyramid())
        names = {command[0] for command in self.COMMANDS}
        shown = self.run_indet("--help").stdout.partition("Subcommands:")[2].partition("\n\n")[0].splitlines()
        known = {line.split()[0] for line in shown if line.startswith("  ") and not line.startswith("   ")}
        self.assertEqual(names | {"completion"}, known)
        for command in self.COMMANDS:
            with self.subTest(command):
                done = program.run([program.INDET, *command, "--quiet"], self.folder)
                self.assertIn(done.returncode, (0, 5), done.stderr)
                self.assertEqual(done.stdout, "")
                for line in done.stderr.splitlines():
                    self.assertTrue(line.startswith("warning: "), line)

    def test_the_document_that_is_asked_for_is_printed_all_the_same(self):
        packing = self.packing(program.groove())
        shown = json.loads(self.run_indet("analyze", packing, "--json", "--quiet").stdout)
        self.assertEqual(shown["certified"], 8)

    def test_errors_are_printed(self):
        self.assertIn("none.h5", self.run_indet("inspect", "none.h5", "--quiet", status=3).stderr)

    def test_what_verify_finds_wrong_is_printed(self):
        packing = self.packing(program.groove())
        self.run_indet("analyze", packing)
        with h5py.File(self.folder / "p.ranges.h5", "r+") as file:
            file["ranges/R_max"][0] += 0.1
        done = self.run_indet("verify", "p.ranges.h5", "--quiet", status=5)
        self.assertIn("R_max", done.stdout + done.stderr)


if __name__ == "__main__":
    program.main()
