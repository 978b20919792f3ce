"""`indet limit`: tilts, loads and friction of small scenes with known answers, their files, messages and pictures.

Argument: the indet executable.
"""

import json
import math
import pathlib
import re
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402


class Limits(program.ProgramTest):
    def limits(self, *arguments, status=0):
        return json.loads(self.run_indet("--json", "limit", *arguments, status=status).stdout)["limits"]

    def test_a_groove_tilts_by_its_angle(self):
        packing = self.packing(program.groove(0.4))
        tilt, = self.limits(packing, "--tilt")
        self.assertEqual((tilt["load"], tilt["unit"], tilt["status"]), ("tilt", "rad", "stands"))
        self.assertAlmostEqual(tilt["largest"], 0.4, delta=1e-15)
        self.assertAlmostEqual(tilt["smallest"], -0.4, delta=1e-15)
        low, high = tilt["largest_bounds"]
        self.assertLessEqual(low, tilt["largest"])
        self.assertLess(high - low, 1e-15)
        with h5py.File(self.folder / "p.limits.h5") as file:
            group = file["limits/0"]
            self.assertEqual(group.attrs["kind"], "tilt")
            self.assertEqual(group["value"][1], tilt["largest"])
            # Gravity of 1 along one normal: that contact bears all, the other one nothing.
            np.testing.assert_allclose(np.sort(np.abs(group["forces"][1])), [0, 0, 0, 1], atol=1e-14)
            self.assertEqual(np.abs(group["motion"][()]).max(), 1)
        self.assertIn(" 0 contradictions", self.run_indet("verify", "--exact", "p.limits.h5").stdout)
        self.assertIn("tilt: gravity", self.run_indet("inspect", "p.limits.h5").stdout)

    def test_never(self):
        tilt, = self.limits(self.packing(program.groove(1.4)), "--tilt")
        self.assertEqual((tilt["largest"], tilt["smallest"]), ("inf", "-inf"))
        self.assertIn("never", self.run_indet("limit", "p.h5", "--tilt").stdout)

    def test_what_cannot_stand(self):
        packing = self.packing(program.incline())
        tilt, load, friction = self.limits(packing, "--tilt", "--load", "disk=0,0,1", "--friction", status=4)
        self.assertEqual(tilt["status"], "does not stand")
        # Gravity along the normal of the incline: the disk stands there, and nowhere else.
        self.assertAlmostEqual(tilt["largest"], tilt["smallest"], delta=1e-14)
        self.assertAlmostEqual(abs(tilt["largest"]), math.pi / 6, delta=1e-14)
        # Held up by as much as it weighs.
        self.assertEqual((load["smallest"], load["largest"], load["status"]), (1, 1, "does not stand"))
        self.assertEqual(friction["status"], "no state")
        self.run_indet("verify", "--exact", "p.limits.h5")
        self.assertEqual(friction["at_smallest"]["moving_disks"], [0])

    def test_no_friction_is_needed(self):
        friction, = self.limits(self.packing(program.groove(0.4)), "--friction")
        self.assertEqual((friction["smallest"], friction["status"]), (0, "stands"))
        self.assertIn("no friction is needed", self.run_indet("inspect", "p.limits.h5").stdout)
        self.run_indet("verify", "--exact", "p.limits.h5")

    def test_friction_of_a_pyramid(self):
        packing = self.packing(program.pyramid(0.5))
        all_of_it, = self.limits(packing, "--friction")
        # Two contacts of the lower disks press on each other, too: some friction is needed, at most tan 15°.
        self.assertLessEqual(all_of_it["smallest"] * 0.5, math.tan(math.pi / 12) + 1e-12)
        self.assertEqual(all_of_it["largest"], "inf")
        self.assertTrue(all_of_it["attained"])
        walls, = self.limits(packing, "--friction", "--friction-of", "walls")
        self.assertAlmostEqual(walls["smallest"] * 0.5, (2 - math.sqrt(3)) / 3, delta=1e-12)
        listed, = self.limits(packing, "--friction", "--friction-of", "0,1")
        self.assertEqual(listed["smallest"], walls["smallest"])

    def test_loads_by_option_and_by_file(self):
        packing = self.packing(program.between_plates(1.0, mu=0.3))
        by_option, = self.limits(packing, "--load", "wall=plate,1,0+disk=0,0,-2e+0")
        (self.folder / "load.toml").write_text(
            '[[wall]]\nname = "plate"\nforce = [1, 0]\n[[disk]]\nid = 0\nforce = [0, -2]\n')
        by_file, = self.limits(packing, "--load", "load.toml")
        for key in ("smallest", "largest", "smallest_bounds", "largest_bounds"):
            self.assertEqual(by_option[key], by_file[key])
        # The plate presses with 1 + λ ≥ 0, the floor bears 2 + 3 λ ≥ 0.
        self.assertAlmostEqual(by_option["smallest"], -2 / 3, delta=1e-15)
        self.assertEqual(by_option["largest"], "inf")
        self.run_indet("verify", "--exact", "p.limits.h5")

    def test_a_map_of_two_loads(self):
        # A disk in a groove bears what leads into it: |F_x| ≤ tan 0.4 · (−F_y), with its weight of 1.
        packing = self.packing(program.groove(0.4))
        limits = self.limits(packing, "--load", "disk=0,1,0", "--load", "disk=0,0,1", "--map", "16")
        self.assertEqual(len(limits), 8)
        slope = math.tan(0.4)
        ends = [(limit["map_angle"], limit["largest"]) for limit in limits]
        ends += [(limit["map_angle"] + math.pi, limit["smallest"]) for limit in limits]
        for angle, multiple in ends:
            width = abs(math.cos(angle)) + slope * math.sin(angle)
            if width > 1e-12:
                self.assertAlmostEqual(abs(multiple), slope / width, delta=1e-12)
            else:
                self.assertIn(multiple, ("inf", "-inf"))
        self.assertIn("  90.00°  1\n", self.run_indet("inspect", "p.limits.h5").stdout)
        self.run_indet("verify", "--exact", "p.limits.h5")
        self.run_indet("export", "p.limits.h5", "--style", "yield-curve", "-o", "y.svg")
        self.assertGreater((self.folder / "y.svg").stat().st_size, 1000)
        for number in ("3", "7", "x", "5000"):
            self.run_indet("limit", packing, "--load", "disk=0,1,0", "--load", "disk=0,0,1", "--map", number, status=2)
        self.run_indet("limit", packing, "--load", "disk=0,1,0", "--map", "8", status=2)
        self.run_indet("limit", packing, "--tilt", "--overwrite")
        done = self.run_indet("export", "p.limits.h5", "--style", "yield-curve", status=3)
        self.assertIn("--map", done.stderr)

    def test_a_limit_at_nothing(self):
        # A smooth disk between floor and wall can be pushed towards the wall alone.
        scene = program.groove()
        scene["walls.csv"] = "id,px,py,nx,ny,name\n0,0,-1,0,1,floor\n1,-1,0,1,0,left\n"
        scene["scene.toml"] = "gravity = [0, -1]\nmu = 0\n"
        load, tilt = reversed(self.limits(self.packing(scene), "--tilt", "--load", "disk=0,1,0"))
        self.assertEqual((load["smallest"], load["largest"], load["status"]), ("-inf", 0, "stands"))
        self.assertEqual((tilt["largest"], tilt["status"]), (0, "stands"))
        self.assertIn(" 0 contradictions", self.run_indet("verify", "--exact", "p.limits.h5").stdout)

    def test_a_disk_that_touches_nothing(self):
        scene = program.groove()
        scene["disks.csv"] += "1,9,9,1,1\n"
        limits = self.limits(self.packing(scene), "--tilt", "--load", "disk=0,0,1", "--friction", status=4)
        self.assertEqual([limit["status"] for limit in limits], ["no state"] * 3)
        self.run_indet("verify", "--exact", "p.limits.h5")

    def test_a_loose_disk_is_left_out_and_named(self):
        scene = program.groove(0.4)
        scene["disks.csv"] += "7,20,1,1,1\n"
        scene["walls.csv"] += "2,0,0,0,1,floor\n"
        scene["contacts.csv"] += "7,-3\n"
        packing = self.packing(scene)
        self.assertEqual(self.limits(packing, "--tilt")[0]["largest"], 0)
        tilt, = self.limits(packing, "--tilt", "--ignore-below", "5")
        self.assertEqual(tilt["left_out"], [7])
        self.assertAlmostEqual(tilt["largest"], 0.4, delta=1e-15)
        with h5py.File(self.folder / "p.limits.h5") as file:
            self.assertEqual(list(file["limits/0/left_out"]), [1])
            self.assertEqual(file["limits/0/forces"].shape, (2, 6))
        self.run_indet("verify", "--exact", "p.limits.h5")
        self.assertIn("without disk 7", self.run_indet("inspect", "p.limits.h5").stdout)

    def test_pictures(self):
        packing = self.packing(program.pyramid(0.5))
        self.run_indet("limit", packing, "--load", "disk=2,1,0", "--quiet")
        for arguments in (["--style", "mechanism"], ["--style", "mechanism", "--limit", "0:smallest"],
                          ["--state", "limit"]):
            self.run_indet("export", "p.limits.h5", *arguments, "-o", "m.svg")
            self.assertGreater((self.folder / "m.svg").stat().st_size, 1000)
        # A packing that cannot stand is drawn with its motion.
        self.packing(program.incline(), name="i")
        self.run_indet("analyze", "i.h5", status=4)
        self.run_indet("export", "i.ranges.h5", "--style", "mechanism", "-o", "i.svg")
        done = self.run_indet("export", packing, "--style", "mechanism", status=3)
        self.assertIn("indet limit p.h5", done.stderr)
        done = self.run_indet("export", "p.limits.h5", "--style", "mechanism", "--limit", "3:largest", status=3)
        self.assertIn("there is no limit 3; the file has 1 limit", done.stderr)
        done = self.run_indet("export", "p.limits.h5", "--style", "steps", status=3)
        self.assertIn("there are no steps to disk=2,1,0 of ", done.stderr)

    def test_a_picture_of_steps(self):
        self.run_indet("limit", self.packing(program.groove(0.4)), "--tilt", "--steps", "4", "--quiet")
        self.run_indet("export", "p.limits.h5", "--style", "steps", "--limit", "smallest", "-o", "s.svg")
        picture = (self.folder / "s.svg").read_text()
        for colour in ("10%,10%,10%", "0%,44.7%,69.8%", "0%,50%,35%", "83.5%,36.9%,0%"):
            self.assertEqual(len(re.findall(f"fill:none[^>]*stroke:rgb\\({colour}", picture)), 4 + 1)  # one of the legend

    def test_steps(self):
        packing = self.packing(program.groove(0.4))
        tilt, load, friction = self.limits(packing, "--tilt", "--load", "gravity=0,0.5", "--friction", "--steps", "4")
        # A segment whose length is as sin(0.4 − θ), as 1 − λ/2, and about as the factor.
        for end in (tilt["at_smallest"], tilt["at_largest"], load["at_largest"], friction["at_smallest"]):
            self.assertEqual(len(end["steps"]), 5)
            self.assertEqual({step["dim"] for step in end["steps"]}, {1})
            self.assertEqual(end["dim"] if end is not friction["at_smallest"] else 0, 0)
        steps = tilt["at_largest"]["steps"]
        for k, step in enumerate(steps[:4]):
            self.assertAlmostEqual(step["value"], 0.1 * k, delta=1e-15)
            share = math.sin(0.4 - 0.1 * k) / math.sin(0.4)
            for name in ("mean_delta_R", "largest_delta_T", "mean_width", "inscribed_radius"):
                self.assertAlmostEqual(step[name], share * steps[0][name], delta=1e-9)
        self.assertNotIn("steps", load["at_smallest"])
        with h5py.File(self.folder / "p.limits.h5") as file:
            group = file["limits/1/steps"]
            self.assertTrue(np.isnan(group["value"][0]).all())
            self.assertTrue((group["dim"][0] == -1).all())
            np.testing.assert_array_equal(group["mean_delta_R"][1], [s["mean_delta_R"] for s in load["at_largest"]["steps"]])
            for name in group:
                self.assertEqual(group[name].shape, (2, 5))
        text = self.run_indet("inspect", "p.limits.h5").stdout
        self.assertEqual(text.count("on the way there"), 4)
        self.assertEqual(text.count("just before"), 4)
        shown = json.loads(self.run_indet("inspect", "--json", "p.limits.h5").stdout)
        self.assertEqual(shown["limits"][0]["at_largest"]["steps"], steps)
        self.assertIn(" 0 contradictions", self.run_indet("verify", "--exact", "p.limits.h5").stdout)

    def test_steps_to_nowhere(self):
        done = self.run_indet("limit", self.packing(program.groove(1.4)), "--tilt", "--steps", "2")
        self.assertIn("warning: --steps: no way to go", done.stderr)
        done = self.run_indet("limit", self.packing(program.incline(), name="i"), "--tilt", "--steps", "2", status=4)
        self.assertIn("warning: --steps: no way to go", done.stderr)

    def test_forged_steps(self):
        """What cannot be a section of one convex set, and steps of an end that there is no way to."""
        self.run_indet("limit", self.packing(program.groove(0.4)), "--load", "gravity=0,0.5", "--steps", "4")
        for field, place, number, status, text in (
                ("mean_delta_R", (1, 2), 0.1, 5, "those beside it tell that it is at least"),
                ("inscribed_radius", (1, 2), 0.1, 5, "those beside it tell that it is at least"),
                ("inscribed_radius", (1, 1), 0.9, 5, "inscribed_radius[1] cannot be"),
                ("value", (1, 2), 0.9, 5, "steps/value[2]"),
                ("dim", (1, 2), -1, 5, "mean_delta_R[2] cannot be"),
                ("dim", (0, 2), 1, 3, "/limits/0/steps/dim: tells of an end that there is no way to"),
                ("value", (1, 0), math.nan, 3, "/limits/0/steps/value: is NaN in part")):
            (self.folder / "bad.h5").write_bytes((self.folder / "p.limits.h5").read_bytes())
            with h5py.File(self.folder / "bad.h5", "r+") as file:
                data = file[f"limits/0/steps/{field}"]
                data[place] = number
            done = self.run_indet("verify", "bad.h5", status=status)
            self.assertIn(text, done.stdout + done.stderr)

    def test_messages(self):
        packing = self.packing(program.pyramid(0.5))
        for status, arguments, text in (
                (2, [], "--tilt, --load or --friction"),
                (2, ["--ignore-below", "3"], "--tilt"),
                (2, ["--tilt", "--friction-of", "walls"], "without --friction"),
                (2, ["--tilt", "--steps", "0"], "from 1 to 1000"),
                (2, ["--tilt", "--steps", "1.5"], "from 1 to 1000"),
                (2, ["--steps", "3"], "--tilt, --load or --friction"),
                (2, ["--load", "disk=1,1,0", "--load", "disk=1,0,1", "--map", "8", "--steps", "3"], "not to those of a --map"),
                (2, ["--load", "disk=1,2"], "expected disk=ID"),
                (2, ["--load", "disk=1,x,0"], '"x" is not a finite number'),
                (2, ["--load", "disk=1,nan,0"], "not a finite number"),
                (2, ["--load", "disk=1,1,0,"], '"" is not a finite number'),
                (3, ["--load", "gravity=1,0", "--load", "gravity=-2,0", "--map", "8"], "span no plane"),
                (3, ["--load", "disk=9,1,0"], "there is no disk 9"),
                (3, ["--load", "wall=lid,1,0"], 'there is no wall "lid"; the walls are floor'),
                (3, ["--load", "wall=floor,1,0"], "is fixed along its normal"),
                (3, ["--load", "stress=1,1,0"], "is not imposed"),
                (3, ["--load", "gravity=0,0"], "the load is 0"),
                (3, ["--load", "none.toml"], "there is no such file")):
            done = self.run_indet("limit", packing, *arguments, status=status)
            self.assertIn(text, done.stderr)
            self.assertFalse((self.folder / "p.limits.h5").exists())
        for text, reason in (("gravity = 3\n", "load.toml:1: gravity must be 2 numbers"),
                             ("[[disk]]\nforce = [1, 2]\n", "load.toml:1: [[disk]] needs an id"),
                             ("weight = 1\n", 'unknown key "weight"'), ("x = \n", "load.toml:1: ")):
            (self.folder / "load.toml").write_text(text)
            self.assertIn(reason, self.run_indet("limit", packing, "--load", "load.toml", status=3).stderr)
        free = program.groove()
        free["scene.toml"] = "gravity = [0, 0]\nmu = 0.3\nforce_unit = 1\n"
        self.packing(free, name="f")
        self.assertIn("there is none", self.run_indet("limit", "f.h5", "--tilt", status=3).stderr)


if __name__ == "__main__":
    program.main()
