"""Packings with fixed disks, loaded walls and levers of their own, as a user meets them: files, results, messages.

Arguments: the indet executable, tests/data.
"""

import csv
import json
import math
import pathlib
import shutil
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

DATA = ""


def on_two_fixed(angle=math.pi / 6, mu=0.3):
    """The groove of program.groove, whose sides are fixed disks, one of them between the wall and the other."""
    scene = program.groove(angle, mu)
    s, c = math.sin(angle), math.cos(angle)
    scene["disks.csv"] = f"id,x,y,radius,mass,fixed\n0,0,0,1,1,\n5,{-3 * s!r},{-3 * c!r},2,,1\n7,{2 * s!r},{-2 * c!r},1,9,1\n"
    scene["walls.csv"] = f"id,px,py,nx,ny\n0,{-3 * s - 2!r},0,1,0\n"
    scene["contacts.csv"] = "a,b\n0,5\n7,0\n5,-1\n"
    return scene


def with_levers(levers, angle=math.pi / 6, mu=0.3):
    scene = program.groove(angle, mu)
    scene["contacts.csv"] = "a,b,lever_a,lever_b\n" + "".join(f"0,{-1 - i},{lever},\n" for i, lever in enumerate(levers))
    return scene


class FixedDisks(program.ProgramTest):
    def test_a_disk_on_two_of_them_is_a_groove(self):
        self.write("p", on_two_fixed())
        shown = json.loads(self.run_indet("--json", "import", "--format", "csv", "p", "-o", "p.h5").stdout)
        self.assertEqual((shown["disks"], shown["fixed_disks"], shown["contacts"]), (3, 2, 2))
        self.assertEqual(shown["without_equations"], 1)
        self.assertEqual(shown["loose_disks"], 0)
        self.assertEqual(shown["force_unit"], 1)
        shown = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "r.h5").stdout)
        self.assertEqual((shown["certified"], shown["dim"], shown["expected_dim"]), (8, 1, 1))
        mu, s, c = 0.3, 0.5, math.sqrt(0.75)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(list(file.attrs["schema_version"]), [2, 0])
            self.assertEqual(list(file["particles/disks/fixed"][:]), [0, 1, 1])
            self.assertNotIn("contacts/lever_a", file)
            np.testing.assert_allclose(file["ranges/delta_R"][:], mu * s / (c**2 - mu**2 * s**2), rtol=1e-12)
        self.assertEqual(json.loads(self.run_indet("--json", "verify", "--exact", "r.h5").stdout)["contradictions"], 0)
        self.assertIn("3 (2 fixed)", self.run_indet("inspect", "r.h5").stdout)

    def test_lines_are_named_where_contacts_are_left_out(self):
        scene = on_two_fixed()
        scene["contacts.csv"] = "a,b,mu\n5,-1,\n7,5,\n0,5,-1\n"
        self.write("p", scene)
        done = self.run_indet("import", "--format", "csv", "p", "-o", "p.h5", status=3)
        self.assertIn("contacts.csv:4: mu must not be negative", done.stderr)

    def test_a_frozen_base_gives_what_scipy_finds(self):
        self.run_indet("import", "--format", "csv", f"{DATA}/frozen-base", "-o", "p.h5")
        shown = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "r.h5").stdout)
        self.assertEqual((shown["dim"], shown["certified"]), (12, 192))
        self.run_indet("verify", "--exact", "r.h5")
        lines = pathlib.Path(DATA, "frozen-base", "expected.csv").read_text().splitlines()
        with h5py.File(self.folder / "r.h5") as file:
            ids = file["particles/disks/id"][:]
            bodies = [(ids[a], ids[b] if b >= 0 else b)
                      for a, b in zip(file["contacts/body_a"][:], file["contacts/body_b"][:])]
            for i, row in enumerate(csv.DictReader(line for line in lines if not line.startswith("#"))):
                self.assertEqual(bodies[i], (int(row["a"]), int(row["b"])))
                for name in ("R_min", "R_max", "T_min", "T_max"):
                    self.assertAlmostEqual(file[f"ranges/{name}"][i], float(row[name]), delta=1e-9)

    def test_pictures_hatch_them(self):
        lines = {}
        for name, scene in (("fixed", on_two_fixed()), ("free", on_two_fixed())):
            if name == "free":
                scene["disks.csv"] = scene["disks.csv"].replace(",1\n", ",0\n").replace(",,0", ",1,0")
            self.packing(scene, name)
            self.run_indet("export", f"{name}.h5", "-o", f"{name}.svg")
            lines[name] = (self.folder / f"{name}.svg").read_text().count("<path")
        self.assertGreater(lines["fixed"], lines["free"] + 10)

    def test_a_simulation_keeps_them_in_place(self):
        self.packing(on_two_fixed())
        for protocol in (["cd1"], ["md1", "--preset", "stiff"]):
            self.run_indet("simulate", "--protocol", *protocol, "--from", "p.h5", "--time-limit", "20", "-o", "s.h5")
            with h5py.File(self.folder / "s.h5") as file, h5py.File(self.folder / "p.h5") as start:
                self.assertEqual(list(file["particles/disks/fixed"][:]), [0, 1, 1])
                np.testing.assert_array_equal(file["particles/disks/position"][1:], start["particles/disks/position"][1:])
                self.assertEqual(len(file["contacts/R"]), 2)
            self.run_indet("analyze", "s.h5", "-o", "r.h5")
            self.run_indet("verify", "r.h5")

    def test_both_ways_of_sampling_take_them(self):
        scene = on_two_fixed()
        R = 0.5 / math.cos(math.pi / 6)
        scene["contacts.csv"] = f"a,b,R,T\n0,5,{R!r},0\n7,0,{R!r},0\n"
        self.packing(scene)
        for method in ("uniform", "perturb"):
            self.run_indet("sample", "p.h5", "--method", method, "-o", f"{method}.h5")
            self.run_indet("verify", f"{method}.h5")
            with h5py.File(self.folder / f"{method}.h5") as file:
                self.assertLess(file["sampling"].attrs["worst_residual"], 1e-9)


class Levers(program.ProgramTest):
    def test_files_and_tables_keep_them(self):
        self.packing(with_levers(["0.9", ""]))
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(list(file.attrs["schema_version"]), [2, 0])
            self.assertEqual(file.attrs["Conventions"], "H5MD-1.1 indet-2")
            np.testing.assert_array_equal(file["contacts/lever_a"][:], [0.9, np.nan])
            np.testing.assert_array_equal(file["contacts/lever_b"][:], [np.nan, np.nan])
            self.assertEqual(file["contacts/lever_a"].attrs["unit"], "length")
        self.run_indet("export", "r.h5", "-o", "table.csv")
        rows = list(csv.DictReader((self.folder / "table.csv").read_text().splitlines()))
        self.assertEqual([row["lever_a"] for row in rows], ["0.9", ""])
        self.assertAlmostEqual(float(rows[0]["x"]), -0.45)  # the point where the force acts
        self.run_indet("export", "r.h5", "-o", "table.csv")  # known as its own, and replaced
        for _ in range(2):
            self.run_indet("export", "r.h5", "--format", "csv", "-o", "scene")
        self.run_indet("import", "--format", "csv", "scene", "-o", "again.h5")
        with h5py.File(self.folder / "again.h5") as again, h5py.File(self.folder / "p.h5") as file:
            self.assertEqual(again.attrs["content_sha256"], file.attrs["content_sha256"])
        self.assertIn("of 1 of 2 contacts given, 0.9 … 1 of the radius", self.run_indet("inspect", "p.h5").stdout)

    def test_a_packing_without_them_is_of_version_1(self):
        self.packing(program.groove())
        with h5py.File(self.folder / "p.h5") as file:
            self.assertEqual(list(file.attrs["schema_version"]), [1, 1])
            self.assertNotIn("contacts/lever_a", file)
            self.assertNotIn("particles/disks/fixed", file)

    def test_torques_are_those_of_the_levers(self):
        """T_1 = −λ T_0 with λ = l_0/l_1, and the normal forces of zoo::wedge_with_levers."""
        s, c = 0.5, math.sqrt(0.75)
        ratio, T = 0.9, 0.05
        total, difference = (1 + (1 + ratio) * T * s) / c, -(1 - ratio) * T * c / s
        for levers, status in ((["0.9", ""], 0), (["", ""], 3)):
            scene = with_levers(levers)
            forces = [(0.5 * (total + difference), T), (0.5 * (total - difference), -ratio * T)]
            rows = [f"0,{-1 - i},{lever},{R!r},{t!r}" for i, (lever, (R, t)) in enumerate(zip(levers, forces))]
            scene["contacts.csv"] = "a,b,lever_a,R,T\n" + "\n".join(rows) + "\n"
            self.write(f"p{status}", scene)
            done = self.run_indet("import", "--format", "csv", f"p{status}", "-o", f"p{status}.h5", status=status)
            if status == 3:
                self.assertIn("net torque", done.stderr)

    def test_verify_notices_another_lever(self):
        self.packing(with_levers(["0.9", ""]))
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        self.run_indet("verify", "r.h5")
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["contacts/lever_a"][0] = 0.8
        self.assertIn("contradict", self.run_indet("verify", "r.h5", status=5).stdout)

    def test_samples_and_simulations_take_them(self):
        self.packing(with_levers(["0.9", "0.95"]))
        self.run_indet("sample", "p.h5", "--method", "uniform", "-o", "u.h5")
        self.run_indet("verify", "u.h5")
        for protocol in (["cd1"], ["md1", "--preset", "stiff"]):
            self.run_indet("simulate", "--protocol", *protocol, "--from", "p.h5", "--time-limit", "20", "-o", "s.h5")
            with h5py.File(self.folder / "s.h5") as file:
                levers = file["contacts/lever_a"][:]
                self.assertEqual(list(levers), [0.9, 0.95])
                self.assertAlmostEqual(np.dot(levers, file["contacts/T"][:]), 0, delta=1e-12)
                np.testing.assert_array_equal(file["simulation/lever_a"][:], levers)


class Reactions(program.ProgramTest):
    def of(self, file):
        """{(body code, component): (minimum, maximum)} of a file of ranges, and that their bounds hold them."""
        with h5py.File(self.folder / file) as content:
            group = content["reactions"]
            value, lower, upper = (group[name][:] for name in ("value", "lower", "upper"))
            self.assertTrue((lower <= value).all() and (value <= upper).all())
            finite = np.isfinite(value) & np.isfinite(lower) & np.isfinite(upper)
            self.assertLess(np.max(upper[finite] - lower[finite], initial=0), 1e-7)
            self.assertEqual(set(group["outcome"][:].ravel()) - {0, 1}, set())
            return {(int(b), int(c)): tuple(v) for b, c, v in zip(group["body"][:], group["component"][:], value)}

    def test_a_loaded_wall_bears_its_load_and_the_floor_the_weight_too(self):
        self.packing(program.between_plates(2.5, 3, mu=0.3))
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        found = self.of("r.h5")
        np.testing.assert_allclose(found[-1, 0], (5.5, 5.5), rtol=1e-13)
        np.testing.assert_allclose(found[-2, 0], (2.5, 2.5), rtol=1e-13)
        np.testing.assert_allclose(found[-1, 1], (0, 0), atol=1e-13)
        self.run_indet("verify", "r.h5")

    def test_of_a_groove_are_those_of_its_contacts(self):
        """Two fixed disks bear −(R n̂ + T t̂) of one contact each, n̂ = (s, c), t̂ = (c, −s) at the left one. Torques take
        T_0 = −T_1, so that 2 R c − 2 T s = 1: half of the weight on each."""
        self.packing(on_two_fixed())
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        found = self.of("r.h5")
        mu, s, c = 0.3, 0.5, math.sqrt(0.75)
        T_min, T_max = -mu * 0.5 / (c + mu * s), mu * 0.5 / (c - mu * s)
        np.testing.assert_allclose(found[1, 1], (-0.5, -0.5), rtol=1e-12)
        x = sorted(-((0.5 + T * s) / c * s + T * c) for T in (T_min, T_max))
        np.testing.assert_allclose(found[1, 0], x, rtol=1e-12)
        np.testing.assert_allclose(found[1, 2], (2 * T_min, 2 * T_max), rtol=1e-12)  # its radius is 2
        self.run_indet("verify", "r.h5")

    def test_of_a_box_contain_those_of_all_states_that_are_stored(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "12", "--seed", "3", "-o", "p.h5")
        shown = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "r.h5").stdout)["reactions"]
        found = self.of("r.h5")
        self.assertGreaterEqual(len(found), 4)
        with h5py.File(self.folder / "r.h5") as file:
            names = [name.decode() for name in file["walls/name"][:]]
            states, b = file["extremal/states"][:], file["contacts/body_b"][:]
            for (body, component), (low, high) in found.items():
                sums = states[:, component::2][:, b == body].sum(axis=1)
                self.assertLessEqual(low, sums.min() + 1e-9)
                self.assertGreaterEqual(high, sums.max() - 1e-9)
        for entry in shown:
            body = -1 - names.index(entry["name"])
            self.assertEqual((entry["minimum"], entry["maximum"]), found[body, int(entry["component"] == "T")])
        self.assertIn("reactions (mg)", self.run_indet("inspect", "r.h5").stdout)
        self.run_indet("verify", "r.h5")

    def test_grow_without_limit_where_forces_do(self):
        self.packing(program.groove(math.radians(80), 0.3))
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        found = self.of("r.h5")
        self.assertEqual(found[-1, 0][1], math.inf)
        self.assertTrue(math.isfinite(found[-1, 0][0]))
        self.run_indet("verify", "r.h5")

    def test_verify_notices_each_changed_number(self):
        self.packing(on_two_fixed())
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        for name, row, value in (("value", (0, 0), -0.3), ("value", (0, 1), -0.1), ("body", 0, 2), ("component", 0, 1),
                                 ("vertex", (0, 0), -1), ("states", (0, 0), 9.0), ("lower", (0, 0), 0.5),
                                 ("upper", (0, 1), -0.6), ("outcome", (0, 0), 3)):
            shutil.copy(self.folder / "r.h5", self.folder / "changed.h5")
            with h5py.File(self.folder / "changed.h5", "r+") as file:
                file["reactions"][name][row] = value
            with self.subTest(name=name):
                shown = json.loads(self.run_indet("--json", "verify", "changed.h5", status=5).stdout)
                self.assertGreater(shown["contradictions"], 0)


class OldFiles(program.ProgramTest):
    def test_a_file_of_version_1_is_read_with_the_same_results(self):
        old = f"{DATA}/old/version-1.0.h5"
        self.assertTrue(json.loads(self.run_indet("--json", "inspect", old).stdout)["intact"])
        self.run_indet("verify", "--exact", old)
        self.run_indet("analyze", old, "-o", "r.h5")
        with h5py.File(old) as before, h5py.File(self.folder / "r.h5") as after:
            self.assertEqual(list(before.attrs["schema_version"]), [1, 0])
            self.assertEqual(list(after.attrs["schema_version"]), [1, 1])
            for group in ("particles", "walls", "contacts"):
                before[group].visititems(lambda name, thing, group=group: np.testing.assert_array_equal(
                    thing[()], after[group][name][()]) if isinstance(thing, h5py.Dataset) else None)
            for name in ("R_min", "R_max", "T_min", "T_max", "outcome"):
                np.testing.assert_allclose(after["ranges"][name][:], before["ranges"][name][:], rtol=1e-12, atol=1e-12)


class LoadedWalls(program.ProgramTest):
    def test_a_plate_shares_its_load(self):
        self.packing(program.between_plates(2.5, 3))
        shown = json.loads(self.run_indet("--json", "analyze", "p.h5", "-o", "r.h5").stdout)
        self.assertEqual((shown["dim"], shown["certified"]), (2, 24))
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(list(file.attrs["schema_version"]), [2, 0])
            np.testing.assert_array_equal(file["walls/load"][:], [[np.nan, np.nan], [2.5, np.nan]])
            np.testing.assert_allclose(file["ranges/R_max"][:], [3.5] * 3 + [2.5] * 3, rtol=1e-13)
        self.run_indet("verify", "--exact", "r.h5")
        self.run_indet("export", "r.h5", "--format", "csv", "-o", "scene")
        self.run_indet("import", "--format", "csv", "scene", "-o", "again.h5")
        with h5py.File(self.folder / "again.h5") as again, h5py.File(self.folder / "p.h5") as file:
            self.assertEqual(again.attrs["content_sha256"], file.attrs["content_sha256"])
        self.assertIn("plate (load_n = 2.5 mg)", self.run_indet("inspect", "r.h5").stdout)
        self.run_indet("export", "r.h5", "-o", "r.svg")
        self.assertGreater((self.folder / "r.svg").read_text().count("rgb(0%,50%,35%)"), 1)

    def test_loads_that_do_not_cancel_are_refused_with_their_sum(self):
        self.write("p", program.rack((1, 1, 1.5)))
        done = self.run_indet("import", "--format", "csv", "p", "-o", "p.h5", status=3)
        self.assertRegex(done.stderr, r"walls\.csv: nothing that is fixed takes the loads along .* their sum is 0\.5, not 0")
        self.assertNotIn("p.h5", self.files())

    def test_what_moves_is_named(self):
        self.packing(program.between_plates(2, 1, 0.3, tangential=0.25))
        done = self.run_indet("analyze", "p.h5", "-o", "r.h5", status=4)
        self.assertIn("wall plate", done.stdout)
        self.run_indet("verify", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            np.testing.assert_allclose(file["equilibrium/wall_motion"][:], [[0, 0], [0, 1]], atol=1e-12)

    def test_known_forces_must_balance_the_load(self):
        for load, status in ((2.5, 0), (2.4, 3)):
            scene = program.between_plates(load)
            scene["contacts.csv"] = "a,b,R,T\n0,-1,3.5,0\n0,-2,2.5,0\n"
            self.write(f"p{status}", scene)
            done = self.run_indet("import", "--format", "csv", f"p{status}", "-o", f"p{status}.h5", status=status)
            self.assertIn("on wall plate the net force is 0.1 mg" if status else "net force on a wall 0.00e+00",
                          done.stderr if status else done.stdout)

    def test_solvers_of_fixed_walls_refuse_them(self):
        scene = program.between_plates(2.5)
        scene["contacts.csv"] = "a,b,R,T\n0,-1,3.5,0\n0,-2,2.5,0\n"
        self.packing(scene)
        for arguments in (["sample", "p.h5", "-o", "s.h5"], ["simulate", "--protocol", "cd1", "--from", "p.h5", "-o", "s.h5"]):
            done = self.run_indet(*arguments, status=3)
            self.assertIn("wall plate is loaded", done.stderr)
            self.assertIn("--method uniform", done.stderr)
        self.assertNotIn("s.h5", self.files())


class BadInput(program.ProgramTest):
    def test_messages_name_file_line_and_reason(self):
        fixed, levers, plates = on_two_fixed(), with_levers(["0.9", ""]), program.between_plates(1)
        for number, (scene, file, text, message) in enumerate([
                (fixed, "disks.csv", "id,x,y,radius,mass,fixed\n0,0,0,1,1,2\n", "disks.csv:2: column fixed: must be 0 or 1"),
                (fixed, "disks.csv", "id,x,y,radius,mass,fixed\n0,0,0,1,1,yes\n", "disks.csv:2: column fixed"),
                (fixed, "disks.csv", "id,x,y,radius,mass,fixed\n0,0,0,1,,0\n", "disks.csv:2: column mass"),
                (levers, "contacts.csv", "a,b,lever_a\n0,-1,0\n", "contacts.csv:2: lever_a must be positive"),
                (levers, "contacts.csv", "a,b,lever_a\n0,-1,1\n0,-2,2.5\n", "contacts.csv:3: lever_a is 2.5, more than"),
                (levers, "contacts.csv", "a,b,lever_b\n0,-1,1\n", "contacts.csv:2: body b is a wall, which has no lever"),
                (levers, "contacts.csv", "a,b,lever_a\n0,-1,short\n", "contacts.csv:2: column lever_a"),
                (plates, "walls.csv", plates["walls.csv"].replace("plate,1", "plate,inf"), "walls.csv:3: column load_n"),
                (plates, "walls.csv", plates["walls.csv"].replace("plate,1", "plate,heavy"), "walls.csv:3: column load_n"),
        ]):
            with self.subTest(message):
                self.write(f"p{number}", {**scene, file: text})
                done = self.run_indet("import", "--format", "csv", f"p{number}", "-o", "p.h5", status=3)
                self.assertIn(message, done.stderr)
                self.assertNotIn("p.h5", self.files())

    def test_a_file_of_another_version_or_of_a_fixed_pair_is_refused(self):
        self.packing(on_two_fixed())
        for change, message in ((lambda f: f.attrs.modify("schema_version", [3, 0]), "has version 3 of the format"),
                                (lambda f: f["particles/disks/fixed"].__setitem__(0, 1), "nothing has to balance")):
            shutil.copy(self.folder / "p.h5", self.folder / "changed.h5")
            with h5py.File(self.folder / "changed.h5", "r+") as file:
                change(file)
            self.assertIn(message, self.run_indet("analyze", "changed.h5", "-o", "r.h5", status=3).stderr)
        self.assertNotIn("r.h5", self.files())


if __name__ == "__main__":
    program.main("DATA")
