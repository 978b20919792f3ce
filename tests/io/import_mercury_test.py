"""Packings of MercuryDPM, read as a user reads them: from restart files, and from .data and .fstat.

Argument: the indet executable.
"""

import gzip
import json
import pathlib
import shutil

import h5py
import numpy as np

from importing import BOTH, DATA, ImportTest, WALLS, program

FORMAT = ("--format", "mercurydpm")


class MercuryDpm(ImportTest):
    SQUARE = "mercurydpm/SquarePackingSelfTest.restart"
    MOVING = "mercurydpm/PolydisperseInsertionBoundarySelfTest.restart"

    def test_a_packing_almost_at_rest(self):
        message = self.read(self.SQUARE, "--format", "mercurydpm", status=3)
        self.assertRegex(message, r"on disk \d+ the net force is \S+e-05 mg, above 1e-06 mg")
        shown = self.read(self.SQUARE, "--format", "mercurydpm", "--balance-tol", "1e-3")
        self.assertEqual((shown["disks"], shown["walls"], shown["contacts"]), (25, 1, 25))
        self.assertEqual(shown["gravity"], [0, -1])
        self.assertLess(shown["force_residual"], 1e-4)
        self.assertEqual(shown["torque_residual"], 0)
        with h5py.File(self.folder / "p.h5") as file:
            np.testing.assert_array_equal(file["contacts/mu"][:], 0)
            np.testing.assert_allclose(file["particles/disks/mass"][:], 1)
            np.testing.assert_allclose(file["walls/normal"][:], [[0, 1]], atol=1e-15)
        # Five columns of five disks: the contact k from the top carries k weights, and nothing else can be.
        shown = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "r.h5").stdout)
        self.assertEqual(shown["dim"], 0)
        with h5py.File(self.folder / "r.h5") as file:
            np.testing.assert_allclose(sorted(file["ranges/R_max"][:]), np.repeat([1, 2, 3, 4, 5], 5), rtol=1e-9)

    def test_a_moving_packing_is_refused(self):
        message = self.read(self.MOVING, "--format", "mercurydpm", status=3)
        self.assertIn("there is no gravity", message)
        self.assertIn("--force-unit F", message)
        message = self.read(self.MOVING, "--format", "mercurydpm", "--force-unit", "0.01", status=3)
        self.assertIn("the forces do not balance", message)
        self.assertRegex(message, r"motion: the packing is not at rest; disk \d+ has the kinetic energy")

    def test_signs(self):
        """The forces of contacts and walls sum to the force that the file has of each particle."""
        self.read(self.MOVING, "--format", "mercurydpm", "--force-unit", "0.01", "--balance-tol", "100")
        forces, ids = {}, []
        for line in pathlib.Path(DATA, self.MOVING).read_text().splitlines():
            words = line.split()
            if words and words[0] == "BaseParticle" and "position" in words and not line.startswith(" "):
                at = words.index("force")
                forces[int(words[2])] = [float(word) for word in words[at + 1:at + 3]]
        with h5py.File(self.folder / "p.h5") as file:
            ids = file["particles/disks/id"][:]
            summed = np.zeros((len(ids), 2))
            n = file["contacts/normal"][:]
            force = file["contacts/R"][:][:, None] * n + file["contacts/T"][:][:, None] * np.c_[n[:, 1], -n[:, 0]]
            for a, b, f in zip(file["contacts/body_a"][:], file["contacts/body_b"][:], force, strict=True):
                summed[a] += f
                if b >= 0:
                    summed[b] -= f
        np.testing.assert_allclose(summed, [forces[i] for i in ids], atol=1e-11)

    def test_bad_files(self):
        for old, new, message in [
                ("MercuryDPM 1.0", "Mercury 1.0", "copy.restart:1: this is not a restart file of MercuryDPM"),
                ("Boundaries 0", "Boundaries 1\nPeriodicBoundary id 0 normal 1 0 0",
                 "copy.restart:19: the packing is periodic"),
                ("Particles 25", "Particles 24", "particle 24 is not in"),
                ("particleWallIds 0 2", "particleWallIds 0 9", "copy.restart:46: there is no wall 9"),
                ("particleWallIds 0 2", "particleWallIds 0", "copy.restart:46: particleWallIds must be followed by"),
                ("InfiniteWall id 2", "IntersectionOfWalls id 2", "copy.restart:16: wall 2 is a IntersectionOfWalls"),
                (" radius 0.5", "", "copy.restart:20: radius is missing"),
                (" invMass 1", " invMass one", "copy.restart:20: invMass must be followed by a number"),
                ("Interactions 25", "Interactions 26", "copy.restart: the file ends too early"),
                ("position 0.5 0.499934083168255 0", "position 0.5 0.499934083168255 0.3",
                 "copy.restart:21: particle 1 lies -0.3 off the plane xy of the first one")]:
            with self.subTest(message):
                path = self.folder / "copy.restart"
                shutil.copy(pathlib.Path(DATA, self.SQUARE), path)
                self.changed(path, (old, new))
                self.assertIn(message, self.read(path, "--format", "mercurydpm", status=3))

    def test_fixed_particles_and_old_walls(self):
        path = self.folder / "copy.restart"
        shutil.copy(pathlib.Path(DATA, self.SQUARE), path)
        self.changed(path, (" invMass 1", " invMass 0"),
                     ("position 0 0 0 orientation 0.707106781186548 0 0 -0.707106781186548", "normal 0 -1 0 position 0 0 0"))
        shown = self.read(path, "--format", "mercurydpm", "--balance-tol", "1e-3")
        self.assertEqual((shown["fixed_disks"], shown["contacts"], shown["without_equations"]), (1, 24, 1))

    def test_friction_of_species(self):
        path = self.folder / "copy.restart"
        shutil.copy(pathlib.Path(DATA, self.SQUARE), path)
        self.changed(path, ("dissipation 230.258509299404", "dissipation 230.258509299404 slidingFrictionCoefficient 0.25"))
        self.read(path, "--format", "mercurydpm", "--balance-tol", "1e-3")
        with h5py.File(self.folder / "p.h5") as file:
            np.testing.assert_array_equal(file["contacts/mu"][:], 0.25)


def numbers(*values, digits=10):
    """As MercuryDPM prints them."""
    return " ".join(f"{value:.{digits}g}" for value in values)


class DataAndFstat(ImportTest):
    MOVING = "mercurydpm/PolydisperseInsertionBoundarySelfTest"
    AT_WILL = ("--friction", "0", "--gravity", "0,0", "--force-unit", "0.01", "--balance-tol", "100")
    DENSITIES = "sphere:0=8,sphere:1=1"

    def read_moving(self, *arguments, name=None, density=DENSITIES, **keywords):
        return self.read(name or self.MOVING + ".data", *FORMAT, *self.AT_WILL, "--density", density, *arguments, **keywords)

    def columns(self, name, *columns):
        with h5py.File(self.folder / name) as file:
            return [file[column][()] for column in columns]

    def expect_same_packing(self, first, second, forces=1e-9):
        """Contacts, geometry to the ten digits of .data, forces to those of .fstat (relative to the largest)."""
        bodies = [self.columns(name, "contacts/body_a", "contacts/body_b") for name in (first, second)]
        np.testing.assert_array_equal(*bodies)
        for column, allowed in [("particles/disks/position", 1e-14), ("particles/disks/radius", 1e-9),
                                ("particles/disks/mass", 1e-9), ("particles/disks/inertia", 1e-9),
                                ("particles/disks/velocity", 1e-9), ("walls/normal", 1e-9),
                                ("contacts/normal", 1e-9), ("contacts/gap", 1e-9), ("contacts/R", forces), ("contacts/T", forces)]:
            (a,), (b,) = self.columns(first, column), self.columns(second, column)
            np.testing.assert_allclose(a, b, rtol=0, atol=allowed * np.abs(b).max() + 1e-15, err_msg=column)
        offsets = [np.sum(np.multiply(*self.columns(name, "walls/point", "walls/normal")), axis=1) for name in (first, second)]
        np.testing.assert_allclose(*offsets, rtol=0, atol=1e-11)

    def test_the_same_packing_as_its_restart_file(self):
        """The files of a self test of MercuryDPM at t = 0.5; its restart file was written at the same time."""
        self.read(self.MOVING + ".restart", *FORMAT, "--force-unit", "0.01", "--balance-tol", "100", output="restart.h5")
        for name in (".data", ".fstat"):
            shown = self.read_moving(name=self.MOVING + name)
            self.assertEqual((shown["disks"], shown["walls"], shown["contacts"]), (127, 4, 55))
            self.assertEqual(shown["duplicates"], 0)
            # The walls come in the order in which they are touched; 1, 2, 0, 3 in both files.
            self.expect_same_packing("p.h5", "restart.h5")

    def test_walls_lie_exactly_where_they_are_given(self):
        self.read_moving("--walls", "0=x:0,1=x:1,2=y:0,3=y:1")
        points, normals = self.columns("p.h5", "walls/point", "walls/normal")
        expected = [((1, 0), (-1, 0)), ((0, 0), (0, 1)), ((0, 0), (1, 0)), ((0, 1), (0, -1))]
        found = {tuple(normal): tuple(point) for point, normal in zip(points, normals, strict=True)}
        self.assertEqual(found, {normal: point for point, normal in expected})
        for walls, message in [
                ("1=x:0.9", r"\.fstat:\d+: wall 1 lies at \(1, 0\) with normal \(-1, 0\) by this contact; is its plane 1=x:0\.9\?"),
                ("1=y:1", r"\.fstat:\d+: wall 1 lies at .*; is its plane 1=y:1\?"),
                ("7=x:1", r"\.fstat: no particle touches wall 7 \(7=x:1\); the walls are 0, 1, 2, 3"),
                ("left=x:1", r"\.fstat: no particle touches wall left")]:
            self.assertRegex(self.read_moving("--walls", walls, status=3, output="q.h5"), message)
        self.assertIn("--walls: ", self.read_moving("--walls", "1=z:0", status=2, output="q.h5"))

    def test_a_frame_is_found_by_its_time(self):
        shown = self.read_moving("--time", "0.5")
        self.assertEqual((shown["disks"], shown["warnings"]), (127, self.read_moving()["warnings"]))
        message = self.read_moving("--time", "0.49", status=3, output="q.h5")
        self.assertIn("there is no frame at time 0.49 in both files; PolydisperseInsertionBoundarySelfTest.data has 0.49, 0.5, "
                      "PolydisperseInsertionBoundarySelfTest.fstat has 0.48, 0.5", message)

    def test_the_last_frame_of_both_is_read(self):
        folder = self.copy("mercurydpm")
        path = folder / pathlib.Path(self.MOVING + ".data").name
        lines = path.read_text().splitlines(keepends=True)
        last = next(i for i, line in enumerate(lines) if line.startswith("127 0.5 "))
        path.write_text("".join([*lines[last:], lines[last].replace(" 0.5 ", " 0.6 "), *lines[last + 1:]]))
        shown = self.read_moving(name=path)
        self.assertEqual(shown["contacts"], 55)
        self.assertIn(f"{path} ends at time 0.6, {path.with_suffix('.fstat')} at 0.5; the last frame of both, at 0.5, is read",
                      shown["warnings"])

    def test_names_with_numbers_and_gzip(self):
        folder = self.copy("mercurydpm")
        for kind in ("data", "fstat"):
            text = (folder / f"{pathlib.Path(self.MOVING).name}.{kind}").read_bytes()
            (folder / f"P.{kind}.0026").write_bytes(text)
            (folder / f"Q.{kind}.gz").write_bytes(gzip.compress(text))
        self.assertEqual(self.read_moving(name=folder / "P.data.0026")["contacts"], 55)
        self.assertEqual(self.read_moving(name=folder / "Q.fstat.gz")["contacts"], 55)

    def test_options(self):
        for density, message in [("8", 'density "8": the forms are'), ("cube=8", "the forms are"), ("sphere=0", "must be positive"),
                                 ("sphere=nan", "must be positive"), ("sphere:0=8,disk:1=1", "all spheres or all disks"),
                                 ("sphere=8,sphere=9", "given twice"), ("sphere:-1=8", "the forms are")]:
            self.assertIn("--density: density ", self.read_moving(density=density, status=2))
            self.assertIn(message, self.read_moving(density=density, status=2))
        self.assertRegex(self.read_moving(density="sphere:0=8", status=3), r"\.data:131: the density of species 1 is not known")
        self.assertRegex(self.read_moving(density="sphere=8,sphere:2=1", status=3),
                         r"\.data: there is no particle of species 2 to have a density")
        self.assertRegex(self.read(self.MOVING + ".data", *FORMAT, *self.AT_WILL, status=3),
                         r"\.data: it has no masses; give the density")
        self.assertRegex(self.read(self.MOVING + ".data", *FORMAT, "--density", "sphere=1", status=3),
                         r"\.fstat:\d+: the friction of particle.* is not known: give it with --friction MU")
        self.assertRegex(self.read_moving("--plane", "xz", status=3), r"\.data: the files are of two dimensions")
        self.assertRegex(self.read_moving("--fixed", "200", status=3), r'no particle is fixed by "200"')
        for option, value in [("--density", "sphere=1"), ("--walls", "0=x:0"), ("--time", "1")]:
            self.assertRegex(self.read(MercuryDpm.SQUARE, *FORMAT, option, value, status=3),
                             rf"SelfTest\.restart: {option} is for \.data and \.fstat files")
        self.assertIn("--density is for --format mercurydpm",
                      self.read("yade/soft", "--format", "yade", "--density", "sphere=1", status=2))
        # A species that has a density of its own; all others have the common one.
        self.read_moving(density="disk=2,disk:1=3")
        radius, mass, inertia = self.columns("p.h5", "particles/disks/radius", "particles/disks/mass", "particles/disks/inertia")
        frame = pathlib.Path(DATA, self.MOVING + ".data").read_text().splitlines()[128:]
        density = [3 if line.split()[-1] == "1" else 2 for line in frame]
        np.testing.assert_allclose(mass, np.pi * radius**2 * density, rtol=1e-14)
        np.testing.assert_allclose(inertia, 0.5 * mass * radius**2, rtol=1e-14)

    def test_bad_files(self):
        data, fstat = "copy.data", "copy.fstat"
        first, second = "0.5 1 102 0.9076597896", "0.5 102 1 0.9076597896"
        for name, old, new, message in [
                (data, "127 0.5 0 0 1 1", "128 0.5 0 0 1 1", "copy.data: the frame in line 128 announces 128 particles, but 127 lines follow"),
                (data, "127 0.5 0 0 1 1", "126 0.5 0 0 1 1", "copy.data:255: a frame must begin with the number of its particles"),
                (data, "127 0.5 0 0 1 1", "127 0.5 0 0 1", "copy.data:128: a frame must begin with a line of 6 or 8 numbers"),
                (data, "127 0.5 0 0 1 1", "127 now 0 0 1 1", 'copy.data:128: "now" is not the time of a frame'),
                (data, "127 0.5 0 0 1 1", "127 0.6 0 0 1 1", "there is no frame whose time both files have"),
                (data, " 0.01970254407 -0 -0 0\n0.920", " 0.01970254407 -0 0\n0.920", "copy.data:129: 7 fields, but there are 8 columns"),
                (data, " 0.01970254407 -0 -0 0\n0.920", " -0.01970254407 -0 -0 0\n0.920", "copy.data:129: radius must be positive"),
                (data, " 0.01970254407 -0 -0 0\n0.920", " r -0 -0 0\n0.920", 'copy.data:129: column radius: "r" is not a number'),
                (data, " 0.01970254407 -0 -0 0\n0.920", " 0.01970254407 -0 -0 0.5\n0.920",
                 "copy.data:129: the density of species 0.5 is not known"),
                (fstat, "# 0.5 1\n", "# when\n", 'copy.fstat:119: "when" is not the time of a frame'),
                (fstat, "# 0.5 1\n", "#\n", "copy.fstat:119: the first line of a frame must have its time"),
                (fstat, "# 0.5 1\n", "", "copy.fstat:121: three lines that begin with # must stand before"),
                (fstat, first, "0.5 1 1020 0.9076597896", "there is no particle 1020: "),
                (fstat, first, "0.5 1 1 0.9076597896", "particle 1 cannot touch itself"),
                (fstat, first, "0.5 1 103 0.9076597896", "do both files belong together?"),
                (fstat, first, "0.5 1 0.9076597896", "15 fields, but there are 16 columns"),
                (fstat, "0.5 56 -2", "0.5 56 -3", "copy.fstat:140: wall 2 is not the plane here that it is in line 122; curved"),
                (fstat, "0 1 0 0 -0 -0 -0\n", "0 0.8 0.6 0 -0 -0 -0\n", "curved and composed walls"),
                (fstat, "0 1 0 0 -0 -0 -0\n", "0 1 0 0.1 -0 -0 -0\n", "(nx, ny, nz) points out of the plane xy"),
                (fstat, "0 0.003491115967 0 1 0 0 -0 -0 -0", "0 0.003491115967 0.001 1 0 0 0 0.5 0",
                 "copy.fstat:122: (tx, ty, tz) must be a unit vector along the contact"),
                (fstat, "0.003491115967", "nan", "column normal_force: must be a finite number, but is nan")]:
            with self.subTest(message):
                for kind in ("data", "fstat"):
                    shutil.copy(pathlib.Path(DATA, f"{self.MOVING}.{kind}"), self.folder / f"copy.{kind}")
                path = self.folder / name
                frame = path.read_text().rindex("127 0.5" if name == data else "# 0.5 1")
                text = path.read_text()
                self.assertIn(old, text[frame:])
                path.write_text(text[:frame] + text[frame:].replace(old, new, 1))
                self.assertIn(message, self.read_moving(name=path, status=3))
        # One of the rows of a pair is missing, or says something else than the other.
        lines = pathlib.Path(DATA, f"{self.MOVING}.fstat").read_text().splitlines(keepends=True)
        here = next(i for i, line in enumerate(lines) if line.startswith(first))
        there = next(i for i, line in enumerate(lines) if line.startswith(second))
        shutil.copy(pathlib.Path(DATA, f"{self.MOVING}.data"), self.folder / data)
        for lines_now, message in [
                (lines[:there] + lines[there + 1:],
                 "particles 1 and 102 are listed from the side of 1 alone; is the file truncated, or is particle 102 fixed"),
                (lines + [lines[here]], "particles 1 and 102 are listed again from the side of 1"),
                (lines[:there] + [lines[here]] + lines[there + 1:], "particles 1 and 102 are listed twice from the side of 1"),
                (lines[:there] + [lines[there].replace(lines[there].split()[8], "0.005", 1)] + lines[there + 1:],
                 "the force of particles 102 and 1 is another one than in line"),
                (lines[:119], "copy.fstat: the file ends in the head of a frame; it is truncated")]:
            with self.subTest(message):
                (self.folder / fstat).write_text("".join(lines_now))
                self.assertRegex(self.read_moving(name=self.folder / data, status=3), message)
        (self.folder / fstat).unlink()
        self.assertIn("copy.fstat: there is no such file; it has the contacts of", self.read_moving(name=self.folder / data, status=3))
        (self.folder / fstat).write_text("\n")
        self.assertIn("copy.fstat: the file is empty", self.read_moving(name=self.folder / data, status=3))

    def write(self, packing, name, spatial=False, fixed=()):
        """Writes a packing as MercuryDPM does, of two dimensions or in the plane x, z of three (`fixed`: particles that
        MercuryDPM holds). t is along the tangential force on the particle that is listed first; at walls both
        vectors have the other sign."""
        disks, contacts = "particles/disks/", "contacts/"
        x, radius, v = self.columns(packing, disks + "position", disks + "radius", disks + "velocity")
        a, b, n, gap, R, T = self.columns(packing, *(contacts + c for c in ("body_a", "body_b", "normal", "gap", "R", "T")))

        def in_space(vector):
            return (vector[0], 0.25, vector[1]) if spatial else (*vector, 0)

        def direction(vector):
            return (vector[0], 0, vector[1]) if spatial else (*vector, 0)

        box = (0, 0, 0, 1, 1, 1) if spatial else (0, 0, 1, 1)
        with open(self.folder / f"{name}.data", "w") as file:
            print(numbers(len(x), 0.75, *box), file=file)
            for i in range(len(x)):
                if spatial:
                    print(numbers(*in_space(x[i]), digits=16), numbers(*direction(v[i]), radius[i], 0, 0, 0, 0, 0, 0, 3), file=file)
                else:
                    print(numbers(*x[i], digits=16), numbers(*v[i], radius[i], 0, 0, 3), file=file)
        with open(self.folder / f"{name}.fstat", "w") as file:
            print(f"# 0.75 1\n# {numbers(0, 0, 0, 1, 1, 1)}\n# {numbers(radius.min(), radius.max(), 0, 0, 0, 0)}", file=file)
            for k in range(len(a)):
                t = np.array([n[k][1], -n[k][0]]) * (1 if T[k] >= 0 else -1)
                point = x[a[k]] - n[k] * (radius[a[k]] + gap[k] / 2)
                sides = [(a[k], b[k], -1)] if b[k] < 0 else [(a[k], b[k], 1), (b[k], a[k], -1)]
                for i, j, sign in sides:
                    if i in fixed:
                        continue
                    print(numbers(0.75, i, j, *in_space(point), -gap[k], 0, R[k], abs(T[k]), *direction(sign * n[k]),
                                  *direction(sign * t)), file=file)

    def test_a_packing_with_friction_at_rest(self):
        """The packing of LIGGGHTS (disks, levers at the middle of the overlap), written as MercuryDPM does: its balance,
        its levers, its ranges."""
        gravity = ("--gravity", "0,-9.81")
        self.read("liggghts", "--format", "liggghts", "--friction", "0.3", *gravity, "--walls", WALLS, output="liggghts.h5")
        contacts = ",".join(map(str, range(0, 179, 4)))
        expected = self.ranges("liggghts.h5", contacts)
        (mass,), (radius,) = self.columns("liggghts.h5", "particles/disks/mass"), self.columns("liggghts.h5", "particles/disks/radius")
        density = mass / (np.pi * radius**2)
        np.testing.assert_allclose(density, density[0], rtol=1e-9)
        for spatial, more in [(False, ()), (True, ("--plane", "xz"))]:
            self.write("liggghts.h5", "N", spatial)
            shown = self.read(self.folder / "N.data", *FORMAT, "--friction", "0.3", *gravity, *more, "--density",
                              f"disk={density[0]:.17g}")
            self.assertEqual((shown["disks"], shown["walls"], shown["contacts"]), (100, 3, 179))
            self.assertEqual(shown["lever_choice"]["levers"], BOTH)
            self.assertLess(shown["force_residual"], 1e-7)  # forces of 100 mg, to ten digits
            self.assertLess(shown["torque_residual"], 1e-8)
            self.expect_same_packing("p.h5", "liggghts.h5")
            found = self.ranges("p.h5", contacts)
            self.assertEqual(set(found), set(expected))
            self.assertEqual(sum(np.isfinite(values).all() for values in found.values()), 45)
            for pair, values in expected.items():
                np.testing.assert_allclose(found[pair], values, rtol=1e-6, atol=1e-6 * mass.mean() * 9.81)

    def test_a_packing_almost_at_rest_has_the_ranges_of_its_restart_file(self):
        """Forces of the restart file, written as .fstat."""
        self.read(MercuryDpm.SQUARE, *FORMAT, "--balance-tol", "1e-3", output="restart.h5")
        self.write("restart.h5", "S")
        shown = self.read(self.folder / "S.data", *FORMAT, "--balance-tol", "1e-3", "--friction", "0",
                          "--density", "disk=1.27323954473516")  # that of the restart file
        self.assertLess(shown["force_residual"], 1e-4)
        self.expect_same_packing("p.h5", "restart.h5")
        expected = self.ranges("restart.h5")
        found = self.ranges("p.h5")
        self.assertEqual(set(found), set(expected))
        for pair, values in expected.items():
            np.testing.assert_allclose(found[pair], values, rtol=1e-9)

    def ranges(self, name, contacts="all"):
        """R_min … T_max of the contacts, by their bodies; walls by their normals, for files number them otherwise. NaN of
        contacts that are not asked for."""
        self.analyze(name, contacts)
        columns = self.columns("r.h5", "contacts/body_a", "contacts/body_b", "walls/normal",
                               *(f"ranges/{c}" for c in ("R_min", "R_max", "T_min", "T_max")))
        a, b, normals = columns[:3]
        keys = [(i, j if j >= 0 else tuple(np.round(normals[-j - 1]) + 0.0)) for i, j in zip(a, b, strict=True)]
        return dict(zip(keys, np.transpose(columns[3:]), strict=True))

    def test_fixed_particles_have_no_side(self):
        """Where MercuryDPM holds a particle, its pairs are listed once."""
        self.read("liggghts", "--format", "liggghts", "--friction", "0.3", "--gravity", "0,-9.81", "--walls", WALLS, output="l.h5")
        self.write("l.h5", "N", fixed=(17,))
        arguments = (self.folder / "N.data", *FORMAT, "--friction", "0.3", "--gravity", "0,-9.81", "--density", "disk=2500")
        message = self.read(*arguments, status=3)
        self.assertRegex(message, r"N\.fstat:\d+: particles \d+ and 17 are listed from the side of \d+ alone.*\(--fixed 17\)")
        shown = self.read(*arguments, "--fixed", "17", "--balance-tol", "1")
        (a,), (b,) = self.columns("l.h5", "contacts/body_a"), self.columns("l.h5", "contacts/body_b")
        left_out = int(np.sum((a == 17) & (b < 0)))
        self.assertEqual((shown["fixed_disks"], shown["contacts"]), (1, 179 - left_out))


if __name__ == "__main__":
    program.main()
