"""No result depends on the units of a scene: lengths, masses and accelerations are scaled, and every number that is
stored scales as its unit says.

Powers of two are exact in doubles, so that the same bits must come out. Powers of ten round the input, and the results
may move by what that is worth.

Arguments: the indet executable.
"""

import json
import pathlib
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402
from units import Units, assert_scaled, numbers  # noqa: E402

# Exponents of length, mass and acceleration.
POWERS = [(40, 0, 0), (-40, 0, 0), (0, 40, 0), (0, -40, 0), (0, 0, 40), (0, 0, -40), (40, -40, 40), (-40, 40, 40)]


class ScaledScenes(program.ProgramTest):
    def make(self, name, scene):
        """Everything that the program does with a scene: {file: its numbers}."""
        packing = self.packing(scene, name)
        self.run_indet("analyze", packing, "-o", f"{name}.ranges.h5")
        self.run_indet("sample", packing, "--samples", "20", "-o", f"{name}.perturb.h5")
        self.run_indet("sample", "--method", "uniform", "--shape", "--states", "8", "--covariance", packing, "-o",
                       f"{name}.uniform.h5")
        for part in ("ranges", "perturb", "uniform"):
            self.run_indet("verify", f"{name}.{part}.h5")
        compared = json.loads(self.run_indet("--json", "compare", packing).stdout)
        return ({part: numbers(self.folder / f"{name}{part}.h5") for part in ("", ".ranges", ".perturb", ".uniform")},
                compared)

    def simulated(self, seed):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "10", "--seed", seed, "-o", f"{seed}.h5")
        return self.folder / f"{seed}.h5"

    def test_powers_of_two_change_no_bit(self):
        for seed in (1, 2):
            origin = self.simulated(seed)
            for force_unit in (0.0, 1e-5):  # mg, and one that is not that of the problem
                expected, compared = self.make(f"s{seed}-{force_unit}", Units().scene(origin, force_unit))
                for powers in POWERS if force_unit == 0 and seed == 1 else POWERS[-1:]:
                    units = Units.of_powers(powers)
                    name = f"s{seed}-{force_unit}-{'_'.join(map(str, powers))}"
                    found, again = self.make(name, units.scene(origin, force_unit))
                    for part, values in expected.items():
                        with self.subTest(seed=seed, powers=powers, file=part):
                            assert_scaled(self, values, found[part], units)
                    for method, other in zip(compared["methods"], again["methods"], strict=True):
                        method.pop("seconds", None), other.pop("seconds", None)
                        self.assertEqual(method, other)

    def test_powers_of_ten_move_results_by_the_rounding_of_the_input_alone(self):
        origin = self.simulated(3)
        packing = self.packing(Units().scene(origin), "one")
        self.run_indet("analyze", packing, "-o", "one.ranges.h5")
        expected = numbers(self.folder / "one.ranges.h5")
        mg = expected["equilibrium@force_unit"][0]
        sensitivity = np.nanmax(expected["ranges/sensitivity"][0]) / mg
        for powers in [(12, 0, 0), (-12, 0, 0), (0, 12, 0), (0, -12, 0), (0, 0, 12), (0, 0, -12)]:
            units = Units(*(10.0**power for power in powers))
            name = "_".join(map(str, powers))
            scaled = self.packing(units.scene(origin), name)
            self.run_indet("analyze", scaled, "-o", f"{name}.ranges.h5")
            self.run_indet("verify", f"{name}.ranges.h5")
            found = numbers(self.folder / f"{name}.ranges.h5")
            for path in ("R_min", "R_max", "T_min", "T_max"):
                value = expected[f"ranges/{path}"][0] / mg
                again = found[f"ranges/{path}"][0] / found["equilibrium@force_unit"][0]
                with self.subTest(powers=powers, path=path):
                    np.testing.assert_allclose(again, value, rtol=1e-13, atol=1e-14 * max(1, sensitivity))
            for key in ("dim", "nullity", "rank", "certified", "objectives"):
                self.assertEqual(found[f"equilibrium@{key}"][0], expected[f"equilibrium@{key}"][0])
            shown = json.loads(self.run_indet("--json", "sample", "--method", "uniform", scaled, "-o",
                                              f"{name}.uniform.h5").stdout)
            self.run_indet("verify", f"{name}.uniform.h5")
            self.assertEqual(shown["stopped_by"], "convergence")
            self.assertLess(shown["worst_residual"], 1e-12)

    def test_what_import_accepts_as_balanced_does_not_depend_on_the_unit_of_force_that_the_scene_names(self):
        R = 0.5 / np.cos(np.pi / 6)
        # A unit up to 1000 times off is the internal one.
        for relative, status in ((0, 0), (1e-10, 0), (0.01, 3)):
            for unit in (None, 1e-12, 1e-5, 1e-2, 30.0, 1e5, 1e7):
                scene = program.groove(mu=0)
                force = R * (1 + relative)
                scene["contacts.csv"] = f"a,b,R,T\n0,-1,{force!r},0\n0,-2,{force!r},0\n"
                if unit is not None:
                    scene["scene.toml"] += f"force_unit = {unit!r}\n"
                name = f"{relative}-{unit}"
                self.write(name, scene)
                with self.subTest(relative=relative, unit=unit):
                    done = self.run_indet("import", "--format", "csv", name, "-o", f"{name}.h5", status=status)
                    self.assertEqual(done.stderr == "", status == 0)

    def test_a_simulation_keeps_forces_that_are_small_in_the_unit_that_the_scene_names_alone(self):
        scene = {"disks.csv": "id,x,y,radius,mass\n0,0,1,1,1\n1,5,1,1,1e-6\n",
                 "walls.csv": "id,px,py,nx,ny,name\n0,0,0,0,1,floor\n", "contacts.csv": "a,b\n0,-1\n1,-1\n"}
        for unit in (1.0, 1e5):
            packing = self.packing({**scene, "scene.toml": f"gravity = [0, -1]\nmu = 0.3\nforce_unit = {unit}\n"}, f"{unit}")
            self.run_indet("simulate", "--protocol", "cd1", "--from", packing, "--time-limit", "3", "-o", f"{unit}-s.h5")
            with h5py.File(self.folder / f"{unit}-s.h5") as file:
                np.testing.assert_allclose(file["contacts/R"][:], [1, 1e-6], rtol=1e-9)

    def test_a_uniform_sample_does_not_depend_on_the_unit_of_force_that_the_scene_names(self):
        results = {}
        for unit in (None, 1e-6, 1e-3, 1.0, 30000.0, 1e6):
            scene = program.groove()
            if unit is not None:
                scene["scene.toml"] += f"force_unit = {unit!r}\n"
            name = f"groove-{unit}"
            shown = json.loads(self.run_indet("--json", "sample", "--method", "uniform", "--shape", "--states", "5",
                                              self.packing(scene, name), "-o", f"{name}.s.h5").stdout)
            in_mg = unit or 1.0  # the disk weighs 1
            results[unit] = {key: shown[key] * in_mg for key in
                             ("r", "spread", "mean_norm", "norm_deviation", "inscribed_radius", "diameter_upper",
                              "mean_width")}
            results[unit]["log_volume"] = shown["log_volume"] + np.log(in_mg)
            with h5py.File(self.folder / f"{name}.s.h5") as file:
                for key in ("center", "deviation", "quantiles", "states"):
                    results[unit][key] = file["sampling"][key][:]
        R_min, R_max = 0.4920, 0.6983
        for unit, values in results.items():
            with self.subTest(unit=unit):
                self.assertTrue(R_min < values["center"][0] < R_max)
                for key, value in values.items():
                    np.testing.assert_allclose(value, results[None][key], rtol=1e-9, atol=1e-9, err_msg=key)


if __name__ == "__main__":
    program.main()
