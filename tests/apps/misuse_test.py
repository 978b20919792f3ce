"""What the program says where something else was meant: a misspelt word, a file of another kind.

Arguments: the indet executable, the folder of the LAMMPS dumps.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

DATA = ""


class MisspeltWords(program.ProgramTest):
    def test_the_nearest_option_is_suggested(self):
        for arguments, meant in [(["simulate", "--protocol", "cd1", "--disk", "10", "-o", "s.h5"], "--disks"),
                                 (["simulate", "--protocol", "cd1", "--disks", "10", "--ouput", "s.h5"], "--output"),
                                 (["analyze", "p.h5", "--formulatoin=edge"], "--formulation"),
                                 (["analyze", "p.h5", "--contact", "3"], "--contacts"),
                                 (["analyze", "p.h5", "--thread", "3"], "--threads"),
                                 (["sample", "--metod", "uniform", "p.h5"], "--method"),
                                 (["--jsn", "inspect", "p.h5"], "--json"),
                                 (["analyse", "p.h5"], "analyze"),
                                 (["ensembel"], "ensemble")]:
            with self.subTest(arguments):
                done = self.run_indet(*arguments, status=2)
                self.assertIn(f"did you mean {meant}?", done.stderr)
                self.assertEqual((done.stdout, self.files()), ("", []))

    def test_nothing_is_suggested_where_nothing_is_near(self):
        for arguments in (["analyze", "p.h5", "--wavelength", "3"], ["paint"]):
            done = self.run_indet(*arguments, status=2)
            self.assertIn(arguments[-2] if len(arguments) > 1 else arguments[0], done.stderr)
            self.assertNotIn("did you mean", done.stderr)
            self.assertIn("--help", done.stderr)

    def test_the_nearest_key_of_a_configuration_is_suggested(self):
        (self.folder / "c.toml").write_text("[analyze]\nformulatoin = \"edge\"\n")
        done = self.run_indet("--config", "c.toml", "analyze", "p.h5", status=3)
        self.assertIn("did you mean formulation?", done.stderr)


class OtherFiles(program.ProgramTest):
    COMMANDS = ("analyze", "compare", "export", "sample")

    def assert_refused(self, name, *parts, commands=COMMANDS):
        for command in commands:
            with self.subTest(command=command, name=name):
                done = self.run_indet(command, name, status=3)
                self.assertTrue(done.stderr.startswith(f"indet: {name}: "), done.stderr)
                for part in parts:
                    self.assertIn(part, done.stderr)

    def test_an_ensemble_has_packings_of_its_own(self):
        self.run_indet("ensemble", "--seeds", "1", "--protocols", "cd1", "--disks", "6", "--samples", "0", "-o", "e")
        self.assert_refused("e/ensemble.h5", "file of an ensemble", "e/members", "for example e/members/cd1-0000.h5")
        self.assert_refused("e", "folder of an ensemble", "e/members/cd1-0000.h5", commands=("analyze", "compare", "export"))

    def test_a_csv_scene_is_a_folder_to_import(self):
        self.write("groove", program.groove())
        hint = "indet import --format csv"
        self.assert_refused("groove/contacts.csv", "a CSV scene is a folder", hint, commands=(*self.COMMANDS, "inspect"))
        self.assert_refused("groove/scene.toml", "a CSV scene is a folder", hint)
        self.assert_refused("groove", hint + " groove -o", commands=("analyze", "inspect", "export"))

    def test_a_lammps_dump_is_to_be_imported(self):
        (self.folder / "atoms.dump").write_bytes((pathlib.Path(DATA) / "atoms.dump").read_bytes())
        self.assert_refused("atoms.dump", "a LAMMPS dump", "--format lammps --atoms")

    def test_a_start_of_another_kind(self):
        self.write("groove", program.groove())
        done = self.run_indet("simulate", "--protocol", "cd2", "--from", "groove/contacts.csv", "-o", "s.h5", status=3)
        self.assertIn("indet import --format csv", done.stderr)


if __name__ == "__main__":
    program.main("DATA")
