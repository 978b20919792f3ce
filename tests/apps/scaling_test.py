"""Whatever makes, shows and joins packings does not depend on the units of a scene either: simulate, ensemble, merge and
report give the same numbers and pages, inspect and export the same texts and pictures, but for what is in those units.

Lengths, masses and accelerations are scaled by powers of two, which are exact in doubles: the same bits must come out.

Arguments: the indet executable.
"""

import csv
import json
import math
import pathlib
import random
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402
from units import Units, assert_scaled, numbers  # noqa: E402

# Exponents of length, mass and acceleration. Length / acceleration is a square, so that times are exact too.
POWERS = [(40, -40, 60), (-60, 40, 40)]
# Columns of tables and keys of texts that are not in units of mg, r_max and √(r_max/g).
UNITS_OF_NAMES = {"x": "length", "y": "length", "px": "length", "py": "length", "gap": "length", "radius": "length",
                  "r_max": "length", "Lx": "length", "Ly": "length", "mass": "mass", "inertia": "mass*length^2",
                  "vx": "length/time", "vy": "length/time", "omega": "rad/time", "fx": "force", "fy": "force", "R": "force",
                  "T": "force", "gravity": "acceleration", "force_unit": "force", "start": "time", "end": "time",
                  # of reactions of walls
                  "minimum": "force", "maximum": "force", "minimum_bounds": "force", "maximum_bounds": "force"}
# Lines of `inspect` that show numbers in the scene's units, or name the file.
OWN_LINES = ("file ", "  disks ", "  gravity ", "  made in ", "written ", "contents ", "  SHA-256 ",
             "trajectory ")


def random_scene(seed):
    """A scene of simulate, as {key: (value, unit)}, and its walls as points and normals."""
    rng = random.Random(seed)
    smallest = rng.uniform(0.3, 2)
    largest = smallest * rng.uniform(1, 1.6)
    columns = rng.randint(2, 3)
    width = 2 * largest * columns * rng.uniform(1.02, 1.2)
    container = ("box", "funnel", "none")[seed % 3]
    scene = {"disks": (rng.randint(6, 9), "1"), "seed": (seed, "1"), "columns": (columns, "1"),
             "radius": ([smallest, largest], "length"), "density": (rng.uniform(0.2, 5), "mass/area"),
             "gravity": ([rng.uniform(-0.1, 0.1), -rng.uniform(0.5, 20)], "acceleration"), "width": (width, "length"),
             "friction": (rng.uniform(0.2, 0.6), "1"), "container": (container, "1")}
    if container != "none":
        return scene, []
    lean = rng.uniform(0.05, 0.3)
    across, up = math.cos(lean), math.sin(lean)
    return scene, [([0.0, 0.0], [0.0, 1.0]), ([0.0, 0.0], [across, up]), ([width, 0.0], [-across, up])]


def scene_text(scene, walls, units):
    def shown(value, factor):
        if isinstance(value, list):
            return "[" + ", ".join(shown(one, factor) for one in value) + "]"
        return json.dumps(value) if isinstance(value, (int, str)) else repr(float(value * factor))

    lines = []
    for key, (value, unit) in scene.items():
        factor = units.mass / units.length**2 if unit == "mass/area" else units.factor(unit)
        lines.append(f"{key} = {shown(value, factor)}")
    for point, normal in walls:
        lines += ["[[wall]]", f"point = {shown(point, units.length)}", f"normal = {normal}"]
    return "\n".join(lines) + "\n"


class Scaling(program.ProgramTest):
    def in_units(self, name, powers=(0, 0, 0)):
        """A folder for one choice of units, in which files have the same names as in others."""
        folder = self.folder / name
        folder.mkdir()
        return folder, Units.of_powers(powers)

    def call(self, folder, *arguments, status=0):
        done = program.run([program.INDET, *map(str, arguments)], folder)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout

    def shown(self, folder, *arguments):
        return json.loads(self.call(folder, "--json", *arguments))

    def assert_shown(self, expected, found, units, name=""):
        """That JSON is the same but for the units of its names, digests, times and provenance."""
        if name in ("content_sha256", "ranges_sha256", "provenance", "seconds", "config"):
            return
        if isinstance(expected, dict):
            self.assertEqual(expected.keys(), found.keys())
            for key, value in expected.items():
                self.assert_shown(value, found[key], units, key)
        elif isinstance(expected, list):
            self.assertEqual(len(expected), len(found))
            for value, other in zip(expected, found, strict=True):
                self.assert_shown(value, other, units, name)
        elif isinstance(expected, float):
            self.assertEqual(expected * units.factor(UNITS_OF_NAMES.get(name, "1")), found, name)
        elif name == "reason":  # names a place, in the scene's unit of length
            self.assertEqual(*(re.sub(r"at \(.*?\)", "", text) for text in (expected, found)))
        else:
            self.assertEqual(expected, found, name)

    def assert_inspected(self, folder, scaled, file, units):
        self.assert_shown(self.shown(folder, "inspect", file), self.shown(scaled, "inspect", file), units)

        def lines(where):
            return [line for line in self.call(where, "inspect", file).splitlines() if not line.startswith(OWN_LINES)]

        self.assertEqual(lines(folder), lines(scaled))

    def assert_table(self, expected, found, units):
        """That two CSV tables are the same: columns in the scene's units scaled, all others byte by byte."""
        expected, found = ([*csv.reader(path.read_text().splitlines())] for path in (expected, found))
        self.assertEqual(expected[0], found[0])
        for row, other in zip(expected[1:], found[1:], strict=True):
            for name, value, scaled in zip(expected[0], row, other, strict=True):
                unit = UNITS_OF_NAMES.get(name, "1")
                if unit == "1" or not value:
                    self.assertEqual(value, scaled, name)
                else:
                    self.assertEqual(float(value) * units.factor(unit), float(scaled), name)

    def simulate(self, folder, units, seed):
        (folder / "scene.toml").write_text(scene_text(*random_scene(seed), units))
        runs = [("cd1", ["--scene", "scene.toml"]),
                ("md1", ["--scene", "scene.toml", "--every", "1"]) if seed % 2 == 0 else ("md2", ["--from", "cd1.h5"])]
        return {protocol: self.shown(folder, "simulate", "--protocol", protocol, *options, "-o", f"{protocol}.h5")
                for protocol, options in runs}

    def test_simulations(self):
        for seed, powers in ((1, POWERS[0]), (2, POWERS[1]), (3, POWERS[0])):
            folder, units = self.in_units(f"{seed}")
            expected = self.simulate(folder, Units(), seed)
            scaled, units = self.in_units(f"{seed}-scaled", powers)
            found = self.simulate(scaled, units, seed)
            with self.subTest(seed=seed, powers=powers):
                self.assert_shown(expected, found, units)
                for protocol in expected:
                    assert_scaled(self, numbers(folder / f"{protocol}.h5"), numbers(scaled / f"{protocol}.h5"), units)
                self.assert_inspected(folder, scaled, f"{protocol}.h5", units)

    def test_exports_and_texts(self):
        for seed, powers in ((4, POWERS[0]), (5, POWERS[1])):
            self.run_indet("simulate", "--protocol", "cd1", "--disks", "8", "--seed", seed, "-o", f"{seed}.h5")
            results = []
            for powers_now in ((0, 0, 0), powers):
                folder, units = self.in_units(f"{seed}-{powers_now[0]}", powers_now)
                scene = folder / "scene"
                scene.mkdir()
                for name, text in units.scene(self.folder / f"{seed}.h5").items():
                    (scene / name).write_text(text)
                self.call(folder, "import", "--format", "csv", "scene", "-o", "p.h5")
                self.call(folder, "analyze", "p.h5", "-o", "r.h5")
                self.call(folder, "sample", "--method", "uniform", "--shape", "p.h5", "-o", "s.h5")
                for name, *options in (("forces.svg",), ("largest.svg", "--state", "max-norm"),
                                       ("delta.svg", "--style", "delta-R"), ("contacts.csv",),
                                       ("out", "--format", "csv", "--state", "T_max:1")):
                    self.call(folder, "export", "r.h5", *options, "-o", name)
                results.append(folder)
            expected, found = results
            with self.subTest(seed=seed, powers=powers):
                for name in ("r.h5", "s.h5"):
                    self.assert_inspected(expected, found, name, units)
                for name in ("forces.svg", "largest.svg", "delta.svg"):
                    self.assertEqual((expected / name).read_bytes(), (found / name).read_bytes(), name)
                self.assert_table(expected / "contacts.csv", found / "contacts.csv", units)
                for name in ("disks.csv", "walls.csv", "contacts.csv"):
                    self.assert_table(expected / "out" / name, found / "out" / name, units)
                gravity, again = (json.loads((folder / "out/scene.toml").read_text().partition("=")[2]) for folder in results)
                self.assertEqual([value * units.acceleration for value in gravity], again)

    def test_ensembles_and_their_reports(self):
        pages = []
        for powers in ((0, 0, 0), POWERS[0]):
            folder, units = self.in_units(f"{powers[0]}", powers)
            (folder / "scene.toml").write_text(scene_text(*random_scene(7), units))
            for number in ("0-1", "2-3"):
                self.call(folder, "ensemble", "--scene", "scene.toml", "--seeds", "1", "--samples", "40", "--members", number,
                          "-o", number)
            self.call(folder, "merge", "0-1", "2-3", "-o", "e")
            self.call(folder, "report", "e")
            text = (folder / "e/report.html").read_text()
            pages.append(text[:text.index("<h2>Run times</h2>")])
        expected, found = self.folder / "0/e", self.folder / f"{POWERS[0][0]}/e"
        for file in ("ensemble.h5", *(f"members/{path.name}" for path in (expected / "members").iterdir())):
            with self.subTest(file=file):
                assert_scaled(self, numbers(expected / file), numbers(found / file), units, times=("provenance/members",))
        self.assertEqual(*pages)
        self.assert_shown(self.shown(expected, "inspect", "ensemble.h5"), self.shown(found, "inspect", "ensemble.h5"), units)


if __name__ == "__main__":
    program.main()
