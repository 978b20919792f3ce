"""Where options come from: flags > environment (INDET_*) > TOML file (--config) > defaults.

Arguments: the indet executable, the LAMMPS dumps.
"""

import json
import os
import pathlib
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

DATA = ""


class Configuration(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.packing(program.groove())

    def config(self, text, name="indet.toml"):
        (self.folder / name).write_text(text)
        return name

    def formulation(self, *arguments, **variables):
        done = self.run_indet("--json", *arguments, environment=os.environ | variables)
        return json.loads(done.stdout)["formulation"]

    def test_flags_come_before_the_environment_before_the_file(self):
        file = self.config('[analyze]\nformulation = "edge"\n')
        analyze = ["analyze", "p.h5"]
        self.assertEqual(self.formulation("--config", file, *analyze), "edge")
        self.assertEqual(self.formulation("--config", file, *analyze, INDET_FORMULATION="dual"), "dual")
        self.assertEqual(self.formulation("--config", file, *analyze, "--formulation", "nullspace",
                                          INDET_FORMULATION="dual"), "nullspace")
        self.assertEqual(self.formulation(*analyze, INDET_CONFIG=file), "edge")

    def test_global_options_come_from_all_three_too(self):
        file = self.config("json = true\nthreads = 2\n")
        json.loads(self.run_indet("--config", file, "inspect", "p.h5").stdout)
        json.loads(self.run_indet("inspect", "p.h5", environment=os.environ | {"INDET_JSON": "1"}).stdout)
        self.run_indet("--config", file, "analyze", "p.h5")
        self.assertEqual(tomllib.loads(self.config_of("p.ranges.h5"))["threads"], 2)

    def test_unknown_keys_are_bad_input_with_file_and_line(self):
        for text, message in [('threads = 1\n\n[analyze]\nformulatoin = "edge"\n', "indet.toml:4: formulatoin"),
                              ("thread = 1\n", "indet.toml:1: thread"),
                              ('[analyse]\nformulation = "edge"\n', "indet.toml:1: 'analyse' is not a subcommand"),
                              # A table of another subcommand is checked as well.
                              ('[analyze]\n[import]\nfritcion = 0.3\n', "indet.toml:3: fritcion"),
                              ("threads = \n", "indet.toml:1: "),
                              ("[analyze]\nformulation = { a = 1 }\n", "indet.toml:2: "),
                              ('\n[analyze]\nformulation = "best"\n', "indet.toml:3: formulation"),
                              ("threads = -1\n", "indet.toml:1: threads")]:
            with self.subTest(text):
                (self.folder / "p.ranges.h5").unlink(missing_ok=True)
                done = self.run_indet("--config", self.config(text), "analyze", "p.h5", status=3)
                self.assertIn(message, done.stderr)
                self.assertFalse((self.folder / "p.ranges.h5").exists())

    def test_a_file_that_is_not_there_is_bad_input(self):
        done = self.run_indet("--config", "none.toml", "analyze", "p.h5", status=3)
        self.assertIn("none.toml: there is no such file", done.stderr)

    def check_reads_back(self, written, group, *again):
        """The configuration in a file, given as --config, makes the same configuration."""
        first = self.config_of(written, group)
        file = self.config(first, "again.toml")
        (self.folder / written).unlink()
        self.run_indet("--config", file, *again)
        self.assertEqual(tomllib.loads(self.config_of(written, group)), tomllib.loads(first))

    def test_the_resolved_configuration_of_an_analysis_reads_back(self):
        self.run_indet("--threads", "1", "analyze", "p.h5", "--formulation", "edge", "-o", "r.h5")
        table = tomllib.loads(self.config_of("r.h5"))
        self.assertEqual(table["threads"], 1)
        self.assertEqual(table["analyze"], {"method": "auto", "accuracy": "standard", "contacts": "all", "duals": "none", "reactions": "auto", "seed": 1,
                                            "formulation": "edge", "extremal-states": "auto", "states-of": "all",
                                            "smallest-distances": False, "output": "r.h5"})
        self.check_reads_back("r.h5", "provenance", "analyze", "p.h5")

    def test_the_resolved_configuration_of_a_scene_without_defaults_reads_back(self):
        data = pathlib.Path(DATA)
        self.run_indet("import", "--format", "lammps", "--atoms", data / "atoms.dump", "--contacts",
                       data / "contacts.dump", "--friction", "0.3", "--gravity", "0,-1", "--columns",
                       "radius=radius,mass=mass", "-o", "q.h5")
        table = tomllib.loads(self.config_of("q.h5"))["import"]
        self.assertEqual((table["friction"], table["gravity"]), (0.3, [0, -1]))
        self.check_reads_back("q.h5", "parameters", "import")

    def test_the_resolved_configuration_of_an_import_reads_back(self):
        self.run_indet("import", "--format", "csv", "p", "-o", "q.h5", "--balance-tol", "1e-5")
        self.check_reads_back("q.h5", "parameters", "import", "p")


if __name__ == "__main__":
    program.main("DATA")
