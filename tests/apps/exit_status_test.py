"""What the program returns, says and leaves behind when it is done, cannot go on, or is stopped.

Arguments: the indet executable, the LAMMPS dumps.
"""

import json
import pathlib
import signal
import subprocess
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

DATA = ""


class Usage(program.ProgramTest):
    def test_wrong_usage_is_2_and_points_to_the_help(self):
        packing = self.packing(program.groove())
        before = self.files()
        for arguments, message in [([], "A subcommand is required"),
                                   (["analyse", packing], "analyse"),
                                   (["analyze"], "packing is required"),
                                   (["analyze", packing, "--formulation", "best"], "best"),
                                   (["analyze", packing, "--states", "none"], "--states"),
                                   (["--threads", "-1", "analyze", packing], "--threads"),
                                   (["--threads", "many", "analyze", packing], "--threads")]:
            with self.subTest(arguments):
                done = self.run_indet(*arguments, status=2)
                self.assertIn(message, done.stderr)
                self.assertLess(max(map(len, done.stderr.splitlines())), 200)
                self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), before)

    def test_help_and_version_are_0(self):
        for arguments in [["--help"], ["--version"], *([name, "--help"] for name in
                                                       ["import", "analyze", "inspect", "verify", "export"])]:
            self.assertEqual(self.run_indet(*arguments).stderr, "")


class BadInput(program.ProgramTest):
    def test_a_bad_file_is_3_and_nothing_is_written(self):
        (self.folder / "text.h5").write_text("no HDF5")
        before = self.files()
        for name, message in [("none.h5", "none.h5: there is no such file"),
                              ("text.h5", "text.h5: cannot be opened as an HDF5 file")]:
            for command in ["analyze", "inspect", "verify", "export"]:
                self.assertIn(message, self.run_indet(command, name, status=3).stderr)
        self.assertEqual(self.files(), before)

    def test_an_output_that_cannot_be_written_is_3(self):
        packing = self.packing(program.groove())
        before = self.files()
        done = self.run_indet("analyze", packing, "-o", "none/r.h5", status=3)
        self.assertIn("none/r.h5", done.stderr)
        self.assertEqual(self.files(), before)

    def test_a_file_that_exists_stays_when_the_input_is_bad(self):
        self.packing(program.groove())
        digest = (self.folder / "p.h5").read_bytes()
        scene = program.groove()
        scene["disks.csv"] = "id,x,y,radius,mass\n0,0,0,-1,1\n"
        self.write("bad", scene)
        done = self.run_indet("import", "--format", "csv", "bad", "-o", "p.h5", status=3)
        self.assertIn("disks.csv:2", done.stderr)
        self.assertEqual((self.folder / "p.h5").read_bytes(), digest)


class NoAdmissibleState(program.ProgramTest):
    def test_a_disk_on_an_incline_rolls(self):
        done = self.run_indet("analyze", self.packing(program.incline()), status=4)
        self.assertIn("cannot stand", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^  disk 0 ")
        self.run_indet("verify", "p.ranges.h5")

    def test_the_moving_disks_are_named_by_their_ids(self):
        scene = program.pyramid(mu=0.2)
        scene["disks.csv"] = scene["disks.csv"].replace("\n2,", "\n77,")
        scene["contacts.csv"] = scene["contacts.csv"].replace("2,", "77,")
        # A disk that rests on the floor beside them does not take part.
        scene["disks.csv"] += "5,10,1,1,1\n"
        scene["contacts.csv"] += "5,-1\n"
        report = json.loads(self.run_indet("analyze", self.packing(scene), "--json", status=4).stdout)
        self.assertEqual(report["status"], "empty")
        self.assertEqual({disk["id"] for disk in report["moving_disks"]}, {0, 1, 77})
        falling = next(disk for disk in report["moving_disks"] if disk["id"] == 77)
        self.assertLess(falling["motion"][1], 0)
        with h5py.File(self.folder / "p.ranges.h5") as file:
            self.assertEqual(file["equilibrium"].attrs["status"], "empty")
            self.assertEqual(list(file["equilibrium/motion"][3]), [0, 0, 0])

    def test_enough_friction_is_0(self):
        self.run_indet("analyze", self.packing(program.pyramid(mu=0.27)))


class Hairline(program.ProgramTest):
    """A groove so shallow that double precision sees one direction of its walls: δR is 1e-14, and would be 1."""

    ANGLE, MU = 1e-13, 0.1

    def test_exact_arithmetic_decides_what_rounding_hides(self):
        packing = self.packing(program.groove(self.ANGLE, self.MU))
        done = self.run_indet("analyze", packing)
        self.assertRegex(done.stdout, r"The rank is ambiguous.*Exact arithmetic decided, for the numbers as they are\.")
        self.run_indet("verify", "p.ranges.h5")
        report = json.loads(self.run_indet("--json", "analyze", packing, "--overwrite").stdout)
        self.assertEqual((report["exact"], report["doubtful"], report["certified"]), (True, False, 8))
        self.assertLess(report["hairline"], 1e-9)
        # The difference of two values near 1/2, each rounded once.
        self.assertAlmostEqual(report["max_delta_R"] / (self.MU * self.ANGLE), 1, places=2)

    def test_without_a_budget_the_doubt_stays_and_is_said(self):
        packing = self.packing(program.groove(self.ANGLE, self.MU))
        done = self.run_indet("analyze", packing, "--exact-budget", "0", status=5)
        self.assertIn("Every result is marked imprecise; --accuracy exact decides", done.stdout)
        self.run_indet("analyze", packing, "--accuracy", "exact", "--overwrite")
        for arguments in (["--accuracy", "exact"], ["--accuracy", "estimate"], ["--method", "barrier"]):
            done = self.run_indet("analyze", packing, "--exact-budget", "1", *arguments, status=2)
            self.assertIn("--exact-budget has no effect", done.stderr)


class Nothing(program.ProgramTest):
    """A scene with nothing to balance is a packing like any other."""

    def test_a_disk_that_nothing_touches_or_pulls(self):
        self.write("p", {"disks.csv": "id,x,y,radius,mass\n7,0,0,1,1\n", "contacts.csv": "a,b\n",
                         "scene.toml": "gravity = [0, 0]\nforce_unit = 1\n"})
        done = self.run_indet("import", "--format", "csv", "p", "-o", "p.h5")
        self.assertRegex(done.stdout, r"(?m)^largest net force   0.00e\+00 mg$")
        self.assertIn("loose disks         1, the first is disk 7", done.stdout)
        done = self.run_indet("analyze", "p.h5")
        self.assertNotIn("nan", done.stdout)
        self.run_indet("verify", "p.ranges.h5")


class Interrupted(program.ProgramTest):
    def test_a_signal_stops_the_analysis_and_leaves_no_file(self):
        self.run_indet("import", "--format", "lammps", "--atoms", f"{DATA}/atoms.dump", "--contacts",
                       f"{DATA}/contacts.dump", "--friction", "0.3", "-o", "p.h5")
        for number in [signal.SIGINT, signal.SIGTERM]:
            with self.subTest(number):
                process = subprocess.Popen([program.INDET, "analyze", "p.h5"], cwd=self.folder,
                                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                program.wait_until_under_way(process, number, 0.2)
                process.send_signal(number)
                output, errors = process.communicate(timeout=60)
                self.assertEqual(process.returncode, 128 + number, errors)
                self.assertEqual(output, "")
                self.assertEqual(errors, "indet: interrupted; nothing was written\n")
                self.assertEqual(self.files(), ["p.h5"])


if __name__ == "__main__":
    program.main("DATA")
