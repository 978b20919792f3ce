"""Names and other texts of users, whatever is in them, are the same in every file, and harmless on a terminal.

Argument: the indet executable.
"""

import pathlib
import sys
import tomllib

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

NAME = 'a"b\\c, #1\n\'\'\' """\r\nseed = 7 \x1b[31m\x7f µ\x9b '
TOML_NAME = '"' + "".join(f"\\u{ord(c):04X}" for c in NAME) + '"'


class Names(program.ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "scene.toml").write_text(
            f"disks = 2\n[[wall]]\nname = {TOML_NAME}\npoint = [0, 0]\nnormal = [0, 1]\n")
        self.run_indet("simulate", "--protocol", "cd1", "--scene", "scene.toml", "--seed", "4", "-o", "s.h5")

    def names_in(self, file):
        with h5py.File(self.folder / file) as content:
            return [name.decode() for name in content["walls/name"][()]]

    def test_a_stored_configuration(self):
        self.assertEqual(self.names_in("s.h5")[-1], NAME)
        scene = tomllib.loads(self.config_of("s.h5", "parameters"))
        self.assertEqual((scene["wall"][0]["name"], scene["seed"]), (NAME, 4))
        # It is a scene again.
        text = self.config_of("s.h5", "parameters").split("[simulat")[0]
        (self.folder / "again.toml").write_bytes(text.encode())
        self.run_indet("simulate", "--protocol", "cd1", "--scene", "again.toml", "-o", "t.h5")
        self.assertEqual(self.names_in("t.h5")[-1], NAME)
        self.run_indet("simulate", "--protocol", "cd2", "--from", "s.h5", "-o", 'f"\n.h5')
        self.run_indet("simulate", "--protocol", "cd2", "--from", 'f"\n.h5', "-o", "g.h5")
        with h5py.File(self.folder / "g.h5") as file:
            self.assertTrue(file["parameters"].attrs["config"].startswith("from = "))

    def test_a_csv_scene(self):
        self.run_indet("export", "s.h5", "--format", "csv", "-o", "scene")
        self.run_indet("import", "--format", "csv", "scene", "-o", "i.h5")
        self.assertEqual(self.names_in("i.h5"), self.names_in("s.h5"))

    def test_a_terminal(self):
        self.run_indet("analyze", "s.h5", "-o", "r.h5")
        for arguments in (["inspect", "s.h5"], ["inspect", "r.h5"], ["verify", "r.h5"], ["analyze", "s.h5", "-o", "r.h5"]):
            done = self.run_indet(*arguments)
            for character in "\x1b\x7f\x9b\r":
                self.assertNotIn(character, done.stdout + done.stderr)
        with h5py.File(self.folder / "s.h5", "r+") as file:
            file["parameters"].attrs["protocol"] = "\x1b[31mred"
            file["simulation"].attrs["reason"] = "\x1b[31mred"
        done = self.run_indet("inspect", "s.h5")
        self.assertIn(r"\x1b[31mred", done.stdout)
        self.assertNotIn("\x1b", done.stdout + done.stderr)
        self.assertNotIn("\x1b", self.run_indet("inspect", "\x1b[31mred", status=3).stderr)

    def test_an_ensemble(self):
        for name in ('a"b.h5', "c\\b.h5", "d\n.h5"):
            (self.folder / name).write_bytes((self.folder / "s.h5").read_bytes())
            self.run_indet("ensemble", f"./{name}", "--out", "e" + name, "--samples", "3")
            self.run_indet("merge", "e" + name, "--out", "m" + name)
            plan = tomllib.loads((self.folder / ("e" + name) / "ensemble.toml").read_text())
            self.assertEqual(plan["member"][0]["name"], name[:-3])


class Messages(program.ProgramTest):
    """They quote at most 200 bytes."""

    def assert_short(self, done):
        self.assertLess(len(done.stderr.encode()), 900, done.stderr)
        self.assertIn("x" * 100, done.stderr)
        self.assertIn("…", done.stderr)

    def test_of_options(self):
        long = "x" * 3000
        for arguments in (["simulate", "--dt", long], ["simulate", f"--disks={long}"], ["simulate", f"--preset={long}"],
                          ["analyze", f"--{long}"], [long], ["simulate", "--scene", long], ["ensemble", "--out", "e", "--members", long]):
            with self.subTest(arguments[:1]):
                done = program.run([program.INDET, *arguments], self.folder)
                self.assertIn(done.returncode, [2, 3])
                self.assert_short(done)

    def test_of_files(self):
        long = "x" * 3000
        for text in (f"{long} = 1", f"container = \"{long}\"", f"[[wall]]\n{long} = 1"):
            (self.folder / "s.toml").write_text(text)
            self.assert_short(self.run_indet("simulate", "--protocol", "cd1", "--scene", "s.toml", "-o", "s.h5", status=3))
        (self.folder / "s.toml").write_text('container = "zero \\u0000 byte"')
        self.assertIn("container", self.run_indet("simulate", "--protocol", "cd1", "--scene", "s.toml", "-o", "s.h5",
                                                  status=3).stderr)
        for file, old, new in (("disks.csv", "0,0,0,1,1", f"0,0,0,{long},1"), ("disks.csv", "id,x", f"{long},id,x"),
                               ("scene.toml", "gravity", f"{long} = 1\ngravity"), ("contacts.csv", "a,b", f"a,b,{long}")):
            with self.subTest(file=file, old=old):
                scene = program.groove()
                scene[file] = scene[file].replace(old, new)
                folder = self.write(f"p{abs(hash((file, old)))}", scene)
                self.assert_short(self.run_indet("import", "--format", "csv", folder.name, "-o", "p.h5", status=3))


if __name__ == "__main__":
    program.main()
