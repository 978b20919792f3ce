"""Scenes in other units, and how the numbers of the program's files scale with them.

A power of two is exact in doubles: the same scene in units that differ by such powers must give the same bits.
"""

import h5py
import numpy as np

# Groups whose attributes are pure numbers, or in units of mg, r_max and √(r_max/g), but for those in SCALED.
PURE = ("equilibrium", "sampling", "extremal", "simulation", "uniform", "bias")
SCALED = {"equilibrium": {"force_unit": "force"},
          "parameters": {"mg": "force", "force_unit": "force", "gravity": "acceleration", "r_max": "length", "Lx": "length",
                         "Ly": "length", "mu": "1", "seed": "1"}}


class Units:
    """What a number of each unit is multiplied by."""

    def __init__(self, length=1.0, mass=1.0, acceleration=1.0):
        self.length, self.mass, self.acceleration = length, mass, acceleration
        self.force = mass * acceleration

    @classmethod
    def of_powers(cls, powers):
        """From exponents of two of length, mass and acceleration."""
        return cls(*(2.0**power for power in powers))

    def factor(self, unit):
        time = np.sqrt(self.length / self.acceleration)
        return {"1": 1, "mg": 1, "rad": 1, "r_max": 1, "mg r_max": 1, "sqrt(r_max/g)": 1, "s": 1, "length": self.length,
                "mass": self.mass, "time": time, "acceleration": self.acceleration, "force": self.force,
                "force2": self.force**2, "force/length": self.force / self.length, "force/radian": self.force, "mass*length^2": self.mass * self.length**2,
                "length/time": self.length / time, "rad/time": 1 / time,
                "force or force*length": self.force,
                "force, force, force*length": np.array([self.force, self.force, self.force * self.length])}[unit]

    def scene(self, packing, force_unit=0.0):
        """The CSV scene of a packing file in these units; `force_unit` in those of the file, 0: none is named."""
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
    """{path: (values, unit)} of every dataset of numbers, and of the attributes of PURE and SCALED."""
    found = {}
    with h5py.File(file) as content:
        def take(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind in "fiu":
                found[name] = (item[:], item.attrs["unit"])
            if not isinstance(item, h5py.Group) or name not in (*PURE, *SCALED):
                return
            for key, value in item.attrs.items():
                if not isinstance(value, str):
                    found[f"{name}@{key}"] = (np.asarray(value), SCALED.get(name, {}).get(key, "1"))
        # One by one: from the root, what has two names (in /VTKHDF) would be found under one of them only.
        for root, item in content.items():
            take(root, item)
            item.visititems(lambda name, thing, root=root: take(f"{root}/{name}", thing))
    return found


def assert_scaled(test, expected, found, units, times=()):
    """That the numbers of a file, as `numbers` gives them, are those of another times what their units are worth. Paths
    that start with one of `times` are seconds of run time, and are not compared."""
    test.assertEqual(expected.keys(), found.keys())
    for path, (value, unit) in expected.items():
        if path.startswith(tuple(times)):
            continue
        with test.subTest(path=path):
            factor = units.factor(unit)
            if unit == "force or force*length":  # torques on disks
                is_torque = (expected["reactions/body"][0] >= 0) & (expected["reactions/component"][0] == 2)
                factor = np.where(is_torque, units.force * units.length, units.force)[:, None]
            np.testing.assert_array_equal(found[path][0], value * factor)
