"""Levers, friction and ranges of packings that other codes made.

Argument: the indet executable.
"""

import pathlib

import h5py
import numpy as np

from importing import BOTH, DATA, ImportTest, NONE, PAIRS, WALLS, program


class Levers(ImportTest):
    def tried(self, shown):
        return shown["lever_choice"]["tried"]

    def test_the_arm_with_which_torques_balance_is_found(self):
        for arguments, levers, disks, contacts, force, torques in [
                (("lammps", "--format", "lammps", "--friction", "0.3"), NONE, 220, 376, 1.4e-11, {NONE: 1.8e-15}),
                (("lammps-granular", "--format", "lammps", "--friction", "0.3"), PAIRS, 220, 375, 1.4e-11,
                 {PAIRS: 1.1e-14, NONE: 1.4e-3, BOTH: 1.6e-3}),
                (("liggghts", "--format", "liggghts", "--friction", "0.3", "--walls", WALLS, "--gravity", "0,-9.81"),
                 BOTH, 100, 179, 1.9e-12, {BOTH: 4.0e-15, NONE: 6.3e-4}),
                (("yade/soft", "--format", "yade", "--gravity", "0,-9.81"), BOTH, 100, 171, 2.9e-10,
                 {BOTH: 7.9e-11, NONE: 1.3e-3}),
                (("yade/stiff", "--format", "yade", "--gravity", "0,-9.81"), BOTH, 100, 168, 1.7e-8,
                 {BOTH: 1.3e-8, NONE: 2.8e-5}),
        ]:
            with self.subTest(arguments[0]):
                shown = self.read(*arguments)
                self.assertEqual((shown["disks"], shown["contacts"], shown["walls"]), (disks, contacts, 3))
                self.assertEqual(shown["lever_choice"]["levers"], levers)
                self.assertEqual(len(self.tried(shown)), 4)
                self.assertLess(shown["force_residual"], 1.5 * force)
                for choice, residual in torques.items():
                    # The independent scripts show two digits; rounding may differ where nothing but it is left.
                    self.assertLess(self.tried(shown)[choice], max(1.1 * residual, 10 * residual * (residual < 1e-13)))
                    self.assertGreater(self.tried(shown)[choice], 0.1 * residual)
                self.assertAlmostEqual(shown["torque_residual"], self.tried(shown)[levers], delta=1e-14)
                self.assertEqual(shown["coulomb_violations"], 0)
                self.assertEqual(shown["warnings"], [])

    def test_levers_are_those_of_the_overlap(self):
        self.read("lammps-granular", "--format", "lammps", "--friction", "0.3")
        with h5py.File(self.folder / "p.h5") as file:
            radius, gap = file["particles/disks/radius"][:], file["contacts/gap"][:]
            a, b = file["contacts/body_a"][:], file["contacts/body_b"][:]
            pairs = b >= 0
            np.testing.assert_allclose(file["contacts/lever_a"][:][pairs], (radius[a] + gap / 2)[pairs], rtol=1e-15)
            np.testing.assert_allclose(file["contacts/lever_b"][:][pairs], (radius[b] + gap / 2)[pairs], rtol=1e-15)

    def test_all_of_it_is_shown(self):
        done = self.run_indet("import", "--format", "yade", pathlib.Path(DATA, "yade/soft"), "--gravity", "0,-9.81",
                              "-o", "p.h5")
        self.assertIn(f"lever arms          {BOTH} (", done.stdout)
        self.assertRegex(done.stdout, r"pair=radius,wall=radius +1\.3\de-03 mg r")

    def test_threads_change_nothing_but_provenance(self):
        digests = []
        for threads in ("1", "2"):
            self.run_indet("--threads", threads, "import", "--format", "yade", pathlib.Path(DATA, "yade/soft"),
                           "--gravity", "0,-9.81", "-o", "p.h5")
            with h5py.File(self.folder / "p.h5") as file:
                self.assertIn(f"threads = {threads}\n", file["provenance"].attrs["config"])
                digests.append((file.attrs["content_sha256"], file.attrs["text_sha256"]))
        self.assertEqual(digests[0], digests[1])

    def test_what_the_user_says_is_taken(self):
        shown = self.read("lammps-granular", "--format", "lammps", "--friction", "0.3", "--lever", "wall=radius")
        self.assertEqual(set(self.tried(shown)), {NONE, PAIRS})
        self.assertEqual(shown["lever_choice"]["levers"], PAIRS)
        message = self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81", "--lever", "radius", status=3,
                            output="q.h5")
        self.assertIn("the net torque (divided by its radius) is 0.001", message)
        self.assertIn("of 1 choice allowed, --lever pair=radius,wall=radius leaves the smallest torque, 0.0013", message)
        shown = self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81", "--lever", "radius",
                          "--balance-tol", "0.01")
        self.assertEqual(shown["lever_choice"]["levers"], NONE)

    def test_wrong_words_are_wrong_usage(self):
        for words in ["middle", "pair=middle", "disk=radius", "radius,radius", "radius,wall=radius"]:
            message = self.read("yade/soft", "--format", "yade", "--lever", words, status=2)
            self.assertIn("--lever: lever \"", message)

    def test_a_scene_with_levers_of_its_own_needs_none(self):
        scene = program.groove()
        scene["contacts.csv"] = "a,b,lever_a\n0,-1,0.9\n0,-2,0.9\n"
        self.write("p", scene)
        done = self.run_indet("import", "--format", "csv", "p", "--lever", "radius", "-o", "p.h5", status=3)
        self.assertIn("levers of their own", done.stderr)


class RangesOfRealPackings(ImportTest):
    def test_of_liggghts(self):
        self.read("liggghts", "--format", "liggghts", "--friction", "0.3", "--walls", WALLS, "--gravity", "0,-9.81")
        self.assertEqual(self.analyze()["dim"], 58)

    def test_of_yade(self):
        for kind, dim in [("soft", 42), ("stiff", 37)]:
            self.read(f"yade/{kind}", "--format", "yade", "--gravity", "0,-9.81")
            self.assertEqual(self.analyze()["dim"], dim)


class Friction(ImportTest):
    SMOOTH = "lammps-cases/smooth-walls"

    def test_smooth_walls_give_the_ranges_of_the_scene_that_has_them(self):
        for friction in ["disk=0.4,wall=0", "0.4,wall=0", "disk=0.4,wall:wl=0,wall:wr=0,wall:wb=0", "type:1-1=0.4,wall=0",
                         "0.9,wall=0.1,type:1-1=0.4,wall:wl=0,wall:wr=0,wall:wb=0"]:
            with self.subTest(friction):
                shown = self.lammps(self.SMOOTH, friction=friction)
                self.assertEqual(shown["warnings"], [])
                with h5py.File(self.folder / "p.h5") as file:
                    np.testing.assert_array_equal(file["contacts/mu"][:],
                                                  np.where(file["contacts/body_b"][:] < 0, 0, 0.4))
        shown = self.analyze()
        self.assertEqual(shown["dim"], 11)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertAlmostEqual(file["ranges/delta_R"][:].mean(), 3.537, delta=5e-4)
        self.expect_ranges(pathlib.Path(DATA, self.SMOOTH, "scene/expected.csv"))

    def test_smooth_walls_give_the_ranges_of_the_csv_scene(self):
        self.run_indet("import", "--format", "csv", pathlib.Path(DATA, self.SMOOTH, "scene"), "-o", "p.h5")
        self.analyze()
        self.expect_ranges(pathlib.Path(DATA, self.SMOOTH, "scene/expected.csv"))

    def test_friction_that_no_tangential_force_shows_is_a_warning(self):
        warnings = self.lammps(self.SMOOTH)["warnings"]
        self.assertEqual(len(warnings), 3)
        for name, warning in zip(["wb", "wl", "wr"], warnings, strict=True):
            self.assertIn(f"the tangential forces at wall {name} (", warning)
            self.assertIn("are all 0, but the friction there is 0.4", warning)

    def test_it_may_stand_in_a_column_of_pairs(self):
        folder = self.copy(self.SMOOTH)
        lines = (folder / "contacts.dump").read_text().splitlines()
        lines = [line + (" c_mu" if line.startswith("ITEM: ENTRIES") else f" {0.4 + i / 1000}" if i > 8 else "")
                 for i, line in enumerate(lines)]
        (folder / "contacts.dump").write_text("\n".join(lines) + "\n")
        self.lammps(folder, "--columns", "mu=c_mu", friction="wall=0")
        with h5py.File(self.folder / "p.h5") as file:
            pairs = file["contacts/body_b"][:] >= 0
            self.assertEqual(len(set(file["contacts/mu"][:][pairs])), pairs.sum())
            self.assertAlmostEqual(file["contacts/mu"][:].max(), 0.4 + (len(lines) - 1) / 1000)
        self.assertIn("only that of walls can be given",
                      self.lammps(folder, "--columns", "mu=c_mu", friction="0.4", status=3, output="q.h5"))

    def test_of_other_codes_is_in_the_files_unless_it_is_given(self):
        for friction, pair, wall in [((), 0.3, 0.3), (("--friction", "wall=0.2"), 0.3, 0.2),
                                     (("--friction", "0.5,wall:2=0.1"), 0.5, 0.5)]:
            self.read("yade/soft", "--format", "yade", "--gravity", "0,-9.81", *friction)
            with h5py.File(self.folder / "p.h5") as file:
                mu, b = file["contacts/mu"][:], file["contacts/body_b"][:]
                names = [name.decode() for name in file["walls/name"][:]]
            np.testing.assert_allclose(mu[b >= 0], pair, rtol=1e-15)
            for i, name in enumerate(names):
                np.testing.assert_allclose(mu[b == -(i + 1)], 0.1 if "wall:2" in str(friction) and name == "2" else wall)

    def test_what_cannot_be(self):
        for friction, message in [("disk=0.4", "give it with --friction MU or wall=MU"),
                                  ("wall=0", "the friction of atoms"),
                                  ("0.4,wall:lid=0", "there is no wall lid to have a friction; the walls are wb, wl, wr"),
                                  ("0.4,type:1-2=0", "there is no atom of type 2 to have a friction")]:
            shown = self.lammps(self.SMOOTH, friction=friction, status=3)
            self.assertIn(message, shown)
        for friction in ["-1", "nan", "disk", "disk=", "disk=x", "wall:=1", "type:1=0.3", "disk=0.1,disk=0.2", "0.1,0.2"]:
            self.assertIn("--friction: ", self.lammps(self.SMOOTH, friction=friction, status=2))


if __name__ == "__main__":
    program.main()
