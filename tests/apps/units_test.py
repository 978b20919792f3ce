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

# Exponents of length, mass and acceleration.
POWERS = [(40, 0, 0), (-40, 0, 0), (0, 40, 0), (0, -40, 0), (0, 0, 40), (0, 0, -40), (40, -40, 40), (-40, 40, 40)]


class Units:
    """What a number of each unit is multiplied by."""

    def __init__(self, length, mass, acceleration):
        self.length, self.mass, self.acceleration = length, mass, acceleration
        self.force = mass * acceleration

    def factor(self, unit):
        velocity = np.sqrt(self.length * self.acceleration)
        return {"1": 1, "mg": 1, "rad": 1, "length": self.length, "mass": self.mass, "force": self.force,
                "force2": self.force**2, "force/radian": self.force, "mass*length^2": self.mass * self.length**2,
                "length/time": velocity, "rad/time": velocity / self.length,
                "force, force, force*length": np.array([self.force, self.force, self.force * self.length])}[unit]

    def scene(self, packing, force_unit=0.0):
        """The CSV scene of a packing file in these units."""
        with h5py.File(packing) as file:
            disks = file["particles/disks"]
            columns = np.column_stack([disks["position"][:] * self.length, disks["radius"][:] * self.length,
                                       disks["mass"][:] * self.mass])
            walls = np.column_stack([file["walls/point"][:] * self.length, file["walls/normal"][:]])
            contacts = file["contacts"]
            bodies = np.column_stack([contacts["body_a"][:], contacts["body_b"][:]])
            forces = np.column_stack([contacts["normal"][:], contacts["mu"][:][:, None],
                                      contacts["R"][:][:, None] * self.force, contacts["T"][:][:, None] * self.force])
            gravity = file["parameters"].attrs["gravity"] * self.acceleration
        text = f"gravity = [{float(gravity[0])!r}, {float(gravity[1])!r}]\n"
        if force_unit > 0:
            text += f"force_unit = {force_unit * self.force!r}\n"

        def rows(*tables):
            return "\n".join(",".join(repr(value) for row in line for value in np.atleast_1d(row).tolist())
                             for line in zip(*tables, strict=True)) + "\n"

        return {"disks.csv": "id,x,y,radius,mass\n" + rows(np.arange(len(columns)), columns),
                "walls.csv": "id,px,py,nx,ny\n" + rows(np.arange(len(walls)), walls),
                "contacts.csv": "a,b,nx,ny,mu,R,T\n" + rows(bodies, forces), "scene.toml": text}


def numbers(file):
    """{path: (values, unit)} of every dataset of numbers, and of the attributes that are pure numbers or in mg."""
    found = {}
    with h5py.File(file) as content:
        def take(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu":
                found[name] = (item[:], item.attrs["unit"])
            if isinstance(item, h5py.Group) and name in ("equilibrium", "sampling", "extremal"):
                for key, value in item.attrs.items():
                    if isinstance(value, (int, float, np.number)):
                        found[f"{name}@{key}"] = (np.asarray(value), "force" if key == "force_unit" else "1")
        content.visititems(take)
    return found


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
                expected, compared = self.make(f"s{seed}-{force_unit}", Units(1, 1, 1).scene(origin, force_unit))
                for powers in POWERS if force_unit == 0 else POWERS[-1:]:
                    units = Units(*(2.0**power for power in powers))
                    name = f"s{seed}-{force_unit}-{'_'.join(map(str, powers))}"
                    found, again = self.make(name, units.scene(origin, force_unit))
                    for part, values in expected.items():
                        self.assertEqual(values.keys(), found[part].keys())
                        for path, (value, unit) in values.items():
                            with self.subTest(seed=seed, powers=powers, file=part, path=path):
                                np.testing.assert_array_equal(found[part][path][0], value * units.factor(unit))
                    for method, other in zip(compared["methods"], again["methods"], strict=True):
                        method.pop("seconds", None), other.pop("seconds", None)
                        self.assertEqual(method, other)

    def test_powers_of_ten_move_results_by_the_rounding_of_the_input_alone(self):
        origin = self.simulated(3)
        packing = self.packing(Units(1, 1, 1).scene(origin), "one")
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
