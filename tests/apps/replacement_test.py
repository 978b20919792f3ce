"""Which files a command may replace: those of the kind that it writes, others with --overwrite, what it reads never.

Argument: the indet executable.
"""

import json
import os
import pathlib
import stat
import struct
import subprocess
import sys
import threading
import zlib

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

STRANGER = "dear diary\n"
SIMULATE = ["simulate", "--protocol", "cd1", "--disks", "6", "--seed", "1", "--quiet"]
ENSEMBLE = ["ensemble", "--seeds", "1", "--disks", "5", "--protocols", "cd1", "--samples", "0", "--uniform-seeds", "0",
            "--quiet"]

# The command without its output, and the name of the output.
WRITERS = {"simulate": ([*SIMULATE, "-o"], "out.h5"),
           "import": (["import", "--format", "csv", "groove", "-o"], "out.h5"),
           "analyze": (["analyze", "groove.h5", "-o"], "out.h5"),
           "sample": (["sample", "moving.h5", "--samples", "4", "-o"], "out.h5"),
           "sample uniform": (["sample", "groove.h5", "--method", "uniform", "-o"], "out.h5"),
           "export svg": (["export", "groove.h5", "-o"], "out.svg"),
           "export pdf": (["export", "groove.h5", "-o"], "out.pdf"),
           "export png": (["export", "groove.h5", "-o"], "out.png"),
           "export csv": (["export", "groove.h5", "-o"], "out.csv"),
           "export vtkhdf": (["export", "groove.h5", "-o"], "out.vtkhdf"),
           "export extxyz": (["export", "groove.h5", "-o"], "out.extxyz"),
           "trajectory": (["trajectory", "moving.h5", "-o"], "out.svg"),
           "animation": (["trajectory", "moving.h5", "--animate", "-o"], "out.svg")}


class ReplacementTest(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        """Files that all tests start from."""
        cls.made = {}
        test = cls()
        program.ProgramTest.setUp(test)
        cls.addClassCleanup(test.doCleanups)
        test.packing(program.groove(), "groove")
        test.run_indet("analyze", "groove.h5")
        test.run_indet(*SIMULATE, "--every", "1", "-o", "moving.h5")
        cls.made = {name: (test.folder / name).read_bytes() for name in ("groove.h5", "groove.ranges.h5", "moving.h5")}

    def setUp(self):
        super().setUp()
        for name, content in self.made.items():
            (self.folder / name).write_bytes(content)
        self.write("groove", program.groove())

    def runTest(self):
        """Only so that setUpClass can run the program."""

    def refused(self, *command, message):
        """The command ends with status 3, says why, and changes no file."""
        before = self.contents()
        done = self.run_indet(*command, status=3)
        self.assertIn(message, done.stderr)
        self.assertEqual(self.contents(), before)
        return done

    def contents(self):
        return {str(path.relative_to(self.folder)): path.read_bytes() for path in sorted(self.folder.rglob("*"))
                if path.is_file()}


class Kinds(ReplacementTest):
    def test_a_command_runs_again(self):
        for name, (command, output) in WRITERS.items():
            with self.subTest(name):
                self.run_indet(*command, output)
                first = (self.folder / output).read_bytes()
                self.run_indet(*command, output)
                self.assertEqual((self.folder / output).read_bytes()[:4], first[:4])
                (self.folder / output).unlink()

    def test_a_file_of_another_program_stays_without_overwrite(self):
        for name, (command, output) in WRITERS.items():
            with self.subTest(name):
                (self.folder / output).write_text(STRANGER)
                self.refused(*command, output, message=f"{output}: is there already, and not a file that indet wrote")
                self.run_indet(*command, output, "--overwrite")
                self.assertNotIn(STRANGER.encode(), (self.folder / output).read_bytes())
                (self.folder / output).unlink()

    def test_a_picture_or_table_of_another_program_stays(self):
        for output, text in [("out.svg", '<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg"/>\n'),
                             ("out.svg", '<svg xmlns="http://www.w3.org/2000/svg"/>\n'),
                             ("out.pdf", "%PDF-1.5\n1 0 obj << /Creator (TeX) >> endobj\n%%EOF\n"),
                             ("out.png", "\x89PNG\r\n\x1a\n" + 80 * "x"), ("out.csv", "contact,force\n1,2\n"),
                             ("out.extxyz", "1\nProperties=species:S:1:pos:R:3\nX 0 0 0\n")]:
            with self.subTest(output=output, text=text):
                (self.folder / output).write_bytes(text.encode("latin-1"))
                self.refused("export", "groove.h5", "-o", output, message="--overwrite")
                (self.folder / output).unlink()

    def test_the_mark_of_a_png_picture_is_a_valid_chunk(self):
        self.run_indet("export", "groove.h5", "-o", "out.png")
        content = (self.folder / "out.png").read_bytes()
        chunks, at = [], 8
        while at < len(content):
            length, = struct.unpack(">I", content[at:at + 4])
            kind, data = content[at + 4:at + 8], content[at + 8:at + 8 + length]
            self.assertEqual(struct.unpack(">I", content[at + 8 + length:at + 12 + length])[0], zlib.crc32(kind + data))
            chunks.append((kind, data))
            at += 12 + length
        self.assertEqual(chunks[1], (b"tEXt", b"Software\0indet"))
        self.assertEqual((chunks[0][0], chunks[-1][0]), (b"IHDR", b"IEND"))

    def test_an_indet_file_of_another_kind_stays(self):
        for command, output, message in [
                (SIMULATE, "groove.ranges.h5", "holds force ranges, and would be replaced by a packing"),
                (["import", "--format", "csv", "groove"], "groove.ranges.h5", "holds force ranges"),
                (["analyze", "groove.h5"], "moving.h5", "holds a packing, and would be replaced by force ranges"),
                (["sample", "moving.h5", "--samples", "4"], "groove.h5",
                 "holds a packing, and would be replaced by samples of contact states")]:
            with self.subTest(command=command):
                self.refused(*command, "-o", output, message=f"{output}: {message}")
                self.run_indet(*command, "-o", output, "--overwrite")
                (self.folder / output).write_bytes(self.made[output])

    def test_the_default_output_of_analyze_obeys_the_same_rule(self):
        (self.folder / "moving.ranges.h5").write_text(STRANGER)
        self.refused("analyze", "moving.h5", message="moving.ranges.h5: is there already")
        self.run_indet("analyze", "groove.h5")

    def test_a_damaged_file_is_no_file_of_indet(self):
        content = self.made["groove.h5"]
        for name, damaged in [("cut", content[:len(content) // 2]), ("zeroed", content[:512] + bytes(len(content) - 512))]:
            with self.subTest(name):
                (self.folder / "out.h5").write_bytes(damaged)
                self.refused("import", "--format", "csv", "groove", "-o", "out.h5", message="--overwrite")
                self.run_indet("import", "--format", "csv", "groove", "-o", "out.h5", "--overwrite")

    def test_a_file_that_was_not_written_to_its_end_stays(self):
        with h5py.File(self.folder / "groove.h5", "r+") as file:
            file.attrs["complete"] = 0
        self.refused(*SIMULATE, "-o", "groove.h5", message="not a file that indet wrote whole")

    def test_an_empty_file_is_replaced(self):
        (self.folder / "out.h5").touch()
        self.run_indet("analyze", "groove.h5", "-o", "out.h5")
        h5py.File(self.folder / "out.h5").close()

    def test_it_is_decided_before_anything_is_computed(self):
        (self.folder / "out.h5").write_text(STRANGER)
        command = [program.INDET, "simulate", "--protocol", "md2", "--disks", "3000", "-o", "out.h5"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=30, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)

    def test_a_folder_that_is_not_there_is_told_before_anything_is_computed(self):
        command = [program.INDET, "simulate", "--protocol", "md2", "--disks", "3000", "-o", "no/out.h5"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=30, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("no/out.h5: the folder no does not exist", done.stderr)

    def test_the_files_of_a_scene_are_looked_at_one_by_one(self):
        command = ["export", "groove.h5", "--format", "csv", "-o", "scene"]
        for _ in range(2):
            self.run_indet(*command)
        for name in ("disks.csv", "walls.csv", "contacts.csv", "scene.toml"):
            with self.subTest(name):
                written = (self.folder / "scene" / name).read_text()
                (self.folder / "scene" / name).write_text("# my own\n" + written)
                self.refused(*command, message=f"scene/{name}: is there already")
                self.run_indet(*command, "--overwrite")
        self.refused("export", "groove.h5", "--format", "csv", "-o", "groove", message="groove/disks.csv")

    def test_the_permission_is_not_part_of_a_configuration(self):
        self.run_indet(*SIMULATE, "-o", "out.h5", "--overwrite")
        self.assertNotIn("overwrite", self.config_of("out.h5"))
        (self.folder / "c.toml").write_text("[analyze]\noverwrite = true\n")
        self.refused("--config", "c.toml", "analyze", "groove.h5", "-o", "moving.h5", message="c.toml:2: overwrite")

    def test_a_checkpoint_takes_the_place_of_no_other_file(self):
        (self.folder / "out.h5.checkpoint").write_text(STRANGER)
        self.refused(*SIMULATE, "-o", "out.h5", message="out.h5.checkpoint: is there already")

    def test_help_tells_the_option(self):
        for command in ("simulate", "import", "analyze", "sample", "export", "trajectory", "ensemble", "merge", "report"):
            with self.subTest(command):
                self.assertIn("--overwrite", self.run_indet(command, "--help").stdout)


class Inputs(ReplacementTest):
    """What a run reads stays, under whatever name, and with --overwrite too."""

    def check(self, *command, output, message):
        for also in ([], ["--overwrite"]):
            self.refused(*command, "-o", output, *also, message=message)

    def test_the_input_is_never_the_output(self):
        for command, output in [(["analyze", "groove.h5"], "groove.h5"),
                                (["sample", "moving.h5", "--samples", "4"], "moving.h5"),
                                (["simulate", "--protocol", "cd2", "--from", "moving.h5"], "moving.h5"),
                                (["import", "--format", "csv", "groove"], "groove/disks.csv"),
                                (["import", "--format", "csv", "groove"], "groove/scene.toml")]:
            with self.subTest(command=command):
                self.check(*command, output=output, message=f"{output}: this run reads it")

    def test_neither_under_another_name(self):
        os.symlink("groove.h5", self.folder / "symbolic.h5")
        os.link(self.folder / "groove.h5", self.folder / "hard.h5")
        (self.folder / "sub").mkdir()
        for output in ("symbolic.h5", "hard.h5", "sub/../groove.h5", str(self.folder / "groove.h5")):
            with self.subTest(output):
                self.check("analyze", "groove.h5", output=output, message="is the file groove.h5, which this run reads")

    def test_pictures_and_tables_neither(self):
        for name in ("groove.svg", "groove.csv"):
            os.link(self.folder / "groove.h5", self.folder / name)
            self.check("export", "groove.h5", output=name, message="which this run reads")
        os.link(self.folder / "moving.h5", self.folder / "moving.svg")
        self.check("trajectory", "moving.h5", output="moving.svg", message="which this run reads")

    def test_a_scene_a_configuration_and_dumps_neither(self):
        (self.folder / "scene.toml").write_text("disks = 5\n")
        self.check("simulate", "--protocol", "cd1", "--scene", "scene.toml", output="scene.toml",
                   message="this run reads it")
        (self.folder / "c.toml").write_text("threads = 1\n")
        self.check("--config", "c.toml", "analyze", "groove.h5", output="c.toml", message="this run reads it")
        (self.folder / "atoms").write_text("")
        self.check("import", "--format", "lammps", "--friction", "0.3", "--atoms", "groove.h5", "--contacts", "atoms",
                   output="groove.h5", message="this run reads it")

    def test_a_checkpoint_is_not_written_over_what_is_read(self):
        (self.folder / "out.h5.checkpoint").write_bytes(self.made["moving.h5"])
        self.check("simulate", "--protocol", "cd2", "--from", "out.h5.checkpoint", output="out.h5",
                   message="out.h5.checkpoint: this run reads it")


class Ensembles(ReplacementTest):
    def test_an_ensemble_runs_again_and_grows(self):
        for seeds in ("1", "1", "2"):
            self.run_indet(*ENSEMBLE[:2], seeds, *ENSEMBLE[3:], "-o", "e")

    def test_files_of_others_in_the_folder_stay(self):
        self.run_indet(*ENSEMBLE, "-o", "model")
        member = next((self.folder / "model").rglob("cd1-*.h5")).relative_to(self.folder / "model")
        for name in ("ensemble.toml", "ensemble.h5", str(member)):
            with self.subTest(name):
                path = self.folder / "e" / name
                path.parent.mkdir(parents=True)
                path.write_text(STRANGER)
                self.refused(*ENSEMBLE, "-o", "e", message=f"e/{name}: is there already")
                self.refused("merge", "model", "-o", "e", message=f"e/{name}: is there already")
                self.run_indet("merge", "model", "-o", "e", "--overwrite")
                for file in sorted((self.folder / "e").rglob("*"), reverse=True):
                    file.rmdir() if file.is_dir() else file.unlink()
                (self.folder / "e").rmdir()

    def test_a_packing_that_is_read_stays(self):
        self.run_indet(*ENSEMBLE, "-o", "e")
        member = next((self.folder / "e").rglob("cd1-*.h5"))
        done = self.run_indet("ensemble", member, "-o", "e", "--samples", "0", "--uniform-seeds", "0", "--overwrite",
                              status=3)
        self.assertIn("which this run reads", done.stderr)

    def test_a_report_runs_again_and_replaces_no_other(self):
        self.run_indet(*ENSEMBLE, "-o", "e")
        for _ in range(2):
            self.run_indet("report", "e", "--quiet")
        (self.folder / "e/report.html").write_text("<!DOCTYPE html><title>mine</title>")
        self.refused("report", "e", message="e/report.html: is there already")
        self.run_indet("report", "e", "--quiet", "--overwrite")

    def test_a_folder_of_other_figures_stays(self):
        self.run_indet(*ENSEMBLE, "-o", "e")
        (self.folder / "e/figures").mkdir()
        (self.folder / "e/figures/fig03.svg").write_text(STRANGER)
        self.refused("report", "e", message="e/figures: holds files that this run did not make")


class Places(ReplacementTest):
    """What is no ordinary file."""

    def test_a_pipe_gets_the_contents_and_stays(self):
        os.mkfifo(self.folder / "pipe")
        received = []
        reader = threading.Thread(target=lambda: received.append((self.folder / "pipe").read_bytes()),
                                  daemon=True)
        reader.start()
        self.run_indet("analyze", "groove.h5", "-o", "pipe")
        reader.join(10)
        self.assertTrue(stat.S_ISFIFO((self.folder / "pipe").stat().st_mode))
        (self.folder / "copy.h5").write_bytes(b"".join(received))
        self.assertEqual(json.loads(self.run_indet("inspect", "copy.h5", "--json").stdout)["intact"], True)

    def device(self, name, minor):
        """A device in the folder of the test: as root, a defect would take the machine's own away."""
        try:
            os.mknod(self.folder / name, stat.S_IFCHR | 0o666, os.makedev(1, minor))
            (self.folder / name).open("wb").close()
        except OSError:
            self.skipTest("no right to make a device")

    def test_a_device_stays(self):
        self.device("null", 3)
        for command in (["analyze", "groove.h5"], SIMULATE, ["import", "--format", "csv", "groove"]):
            with self.subTest(command=command):
                self.run_indet(*command, "-o", "null")
                self.assertTrue(stat.S_ISCHR((self.folder / "null").stat().st_mode))
        self.assertEqual([name for name in self.files() if "null" in name], ["null"])

    def test_a_full_device_is_a_failure_and_stays(self):
        self.device("full", 7)
        done = self.run_indet("analyze", "groove.h5", "-o", "full", status=1)
        self.assertIn("full: writing failed (No space left on device)", done.stderr)
        self.assertTrue(stat.S_ISCHR((self.folder / "full").stat().st_mode))

    def test_a_link_stays_and_leads_to_the_new_file(self):
        (self.folder / "there").mkdir()
        os.symlink("there/r.h5", self.folder / "link.h5")
        for _ in range(2):  # first to nothing, then to a file
            self.run_indet("analyze", "groove.h5", "-o", "link.h5")
            self.assertEqual(os.readlink(self.folder / "link.h5"), "there/r.h5")
            self.assertEqual(os.listdir(self.folder / "there"), ["r.h5"])
            h5py.File(self.folder / "there/r.h5").close()

    def test_a_circle_of_links_is_refused(self):
        os.symlink("b.h5", self.folder / "a.h5")
        os.symlink("a.h5", self.folder / "b.h5")
        self.refused("analyze", "groove.h5", "-o", "a.h5", message="a.h5: cannot be written")

    def test_a_folder_is_refused(self):
        (self.folder / "sub").mkdir()
        for command in (["analyze", "groove.h5"], SIMULATE):
            self.refused(*command, "-o", "sub", message="sub: is a folder")
            self.refused(*command, "-o", "sub/", message="sub/: is a folder")

    def test_standard_output_holds_the_file_alone(self):
        os.symlink("/proc/self/fd/1", self.folder / "stdout")  # as /dev/stdout, which is the machine's own
        for redirect in ("> out.h5", "| cat > out.h5"):
            with self.subTest(redirect):
                done = subprocess.run(f"'{program.INDET}' analyze groove.h5 -o stdout {redirect}", shell=True,
                                      cwd=self.folder, capture_output=True, text=True, timeout=60, check=True)
                self.assertIn("polytope of contact states", done.stderr)
                self.assertNotIn(b"polytope of contact states", (self.folder / "out.h5").read_bytes())
                self.assertTrue(json.loads(self.run_indet("inspect", "out.h5", "--json").stdout)["intact"])
                (self.folder / "out.h5").unlink()
        self.assertTrue(os.path.islink(self.folder / "stdout"))


if __name__ == "__main__":
    program.main()
