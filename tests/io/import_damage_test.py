"""Files of other codes with numbers that no packing at rest has, and options that say nothing.

Argument: the indet executable.
"""

import bz2
import lzma
import pathlib
import re
import shutil

from importing import DATA, ImportTest, WALLS, program

LAMMPS = ("lammps", "--format", "lammps", "--friction", "0.3")
LIGGGHTS = ("liggghts", "--format", "liggghts", "--friction", "0.3", "--gravity", "0,-9.81", "--walls", WALLS)
YADE = ("yade/soft", "--format", "yade", "--gravity", "0,-9.81")
SQUARE = "mercurydpm/SquarePackingSelfTest.restart"


class Damage(ImportTest):
    def with_field(self, format_, file, line, column, value):
        """What import says of a file one field of which (both counted from 0) was replaced."""
        shutil.rmtree(self.folder / "copy", ignore_errors=True)
        folder = self.copy(format_[0])
        lines = (folder / file).read_text().splitlines(keepends=True)
        fields = lines[line].split()
        fields[column] = value
        lines[line] = " ".join(fields) + "\n"
        (folder / file).write_text("".join(lines))
        return self.read(folder, *format_[1:], status=3)

    def test_forces_that_are_no_numbers_are_not_unknown_ones(self):
        """A simulation that has diverged."""
        for value in ("nan", "inf", "-inf"):
            for format_, file, line, column, place in [
                    (LAMMPS, "contacts.dump", 9, 6, "contacts.dump:10: the force of atoms"),  # fy
                    (LAMMPS, "contacts.dump", 9, 7, "contacts.dump:10: the force of atoms"),  # p1
                    (LIGGGHTS, "contacts.dump", 9, 5, "contacts.dump:10: the force of c_pl is not finite"),
                    (LIGGGHTS, "atoms.dump", 9, 21, "atoms.dump:10: the force of f_force_wy is not finite"),
                    (YADE, "interactions.txt", 1, 5, "interactions.txt:2: the force is not finite"),
                    (YADE, "interactions.txt", 1, 10, "interactions.txt:2: the force is not finite"),  # fsz
                    (YADE, "interactions.txt", 1, 4, "interactions.txt:2: the normal is not finite"),
                    (YADE, "interactions.txt", 1, 11, "interactions.txt:2: pd must be a finite number")]:
                with self.subTest(place, value=value):
                    self.assertIn(place, self.with_field(format_, file, line, column, value))
            path = self.folder / "copy.restart"
            for force in (f"{value} 5 0", f"0 {value} 0", f"0 5 {value}"):
                text = pathlib.Path(DATA, SQUARE).read_text()
                path.write_text(text.replace("force -0 5.00034066192058 0", f"force {force}", 1))
                self.assertIn("copy.restart:46: the force is not finite", self.read(path, "--format", "mercurydpm", status=3))

    def test_a_wall_of_lammps_with_such_a_force(self):
        text = pathlib.Path(DATA, "lammps/atoms.dump").read_text().splitlines()
        flag, force = (text[8].split().index(name) - 2 for name in ("f_wy[1]", "f_wy[3]"))
        line = next(i for i, row in enumerate(text) if i > 8 and float(row.split()[flag]) == 1)
        message = self.with_field(LAMMPS, "atoms.dump", line, force, "nan")
        self.assertRegex(message, rf"atoms\.dump:{line + 1}: .*(is not a finite number|is not finite)")

    def test_places_off_the_plane_and_radii(self):
        for column, value, message in [(4, "nan", "lies nan off the plane xy"), (5, "-1", "radius must be positive"),
                                       (5, "nan", "off the plane|radius must be")]:
            self.assertRegex(self.with_field(YADE, "bodies.txt", 10, column, value), rf"bodies\.txt:11: .*({message})")
        path = self.folder / "copy.restart"
        for old, new, message in [
                ("radius 0.5 ", "radius -0.5 ", ":20: radius must be positive"),
                ("0.499934083168255 0 ", "0.499934083168255 nan ", ":20: particle 0 lies nan off the plane xy"),
                ("gravity 0 -1 0", "gravity 0 -1 -1", ":10: gravity (which --gravity replaces) points out of the plane xy"),
                ("gravity 0 -1 0", "gravity 0 nan 0", ":10: gravity (which --gravity replaces) is not finite"),
                ("particleDimensions 2", "particleDimensions 4", ":10: particleDimensions must be 2 or 3"),
                ("Particles 25", "Particles -1", ":19: Particles must not be negative, but is -1")]:
            with self.subTest(message):
                text = pathlib.Path(DATA, SQUARE).read_text()
                self.assertIn(old, text)
                path.write_text(text.replace(old, new, 1))
                self.assertIn("copy.restart" + message, self.read(path, "--format", "mercurydpm", status=3))
        path.write_text(pathlib.Path(DATA, SQUARE).read_text().replace("gravity 0 -1 0", "gravity 0 0 -1"))
        self.read(path, "--format", "mercurydpm", "--gravity", "0,-1", "--balance-tol", "1e-3")
        path.write_text("")
        self.assertIn("copy.restart: the file is empty", self.read(path, "--format", "mercurydpm", status=3, output="q.h5"))

    def test_files_that_are_no_text(self):
        data = pathlib.Path(DATA, "lammps/atoms.dump").read_bytes()
        path = self.folder / "other.dump"
        for content, message in [(bytes.fromhex("28b52ffd") + data, "is packed by zstd; unpack it first (gzip alone is understood)"),
                                 (lzma.compress(data), "is packed by xz; unpack it first"),
                                 (bz2.compress(data), "is packed by bzip2; unpack it first"),
                                 (b"PK\3\4" + data, "is packed by zip; unpack it first"),
                                 (data[:100] + bytes(8) + data[100:], "the byte 0x00 is not UTF-8 text")]:
            path.write_bytes(content)
            done = self.run_indet("import", "--format", "lammps", "--friction", "0.3", "--atoms", path, "--contacts", path,
                                  "-o", "p.h5", status=3)
            self.assertRegex(done.stderr, rf"other\.dump(:\d+)?: {re.escape(message)}")

    def test_all_disks_fixed(self):
        self.assertIn("all its atoms are fixed, so that there is nothing to balance",
                      self.read(*LAMMPS, "--fixed", "type=1", status=3))
        self.assertIn("all its bodies are fixed", self.read(*YADE, "--fixed", "0-999", status=3))

    def test_types_that_no_type_can_be(self):
        """2³² + 1 is not 1."""
        for types in ("4294967297-4294967297", "1-99999999999", "-1-1", "1-99999999999999999999"):
            self.assertIn(f'friction "type:{types}=0.1": the forms are',
                          self.read("lammps", "--format", "lammps", "--friction", f"0.3,type:{types}=0.1", status=2))

    def test_values_that_say_nothing(self):
        for option in ("--timestep", "--force-unit"):
            message = self.read(*LAMMPS, option, "", status=2)
            self.assertRegex(message, rf"{option}: .*(the value is empty|is not a (whole )?number)")
        for value in ("0", "-1", "nan", "x"):
            message = self.read(*LAMMPS, "--force-unit", value, status=2)
            self.assertIn(f'--force-unit: "{value}" is not a number > 0', message)
            self.assertIsNone(re.search(r"\d{50}", message))


if __name__ == "__main__":
    program.main()
