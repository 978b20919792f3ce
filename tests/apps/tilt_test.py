"""simulate --tilt-rate: gravity turns until disks move.

Argument: the indet executable.
"""

import json
import math
import pathlib
import signal
import subprocess
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program

PHI = math.radians(10)
TILT = ["simulate", "--protocol", "cd1", "--from", "p.h5", "--tilt-rate"]


def residual(path):
    """Largest out-of-balance force or torque/r, in mg, under the gravity of the file, and how far forces leave the cones."""
    with h5py.File(path) as file:
        disks = file["particles/disks"]
        force = np.zeros((len(disks["mass"]), 3))
        force[:, :2] = disks["mass"][()][:, None] * file["parameters"].attrs["gravity"]
        c = file["contacts"]
        for a, b, n, R, T in zip(c["body_a"], c["body_b"], c["normal"], c["R"], c["T"]):
            f = R * n + T * np.array([n[1], -n[0]])
            force[a] += [*f, T]
            if b >= 0:
                force[b] += [*-f, T]
        outside = np.max(np.abs(c["T"]) - c["mu"][()] * c["R"])
        return np.abs(force).max() / file["parameters"].attrs["mg"], outside / file["parameters"].attrs["mg"]


class Tilt(program.ProgramTest):
    def groove_at_rest(self):
        """Forces of a disk in a groove of two walls, as a simulator leaves them. It leaves at ±10°."""
        self.packing(program.groove(PHI), name="g")
        self.run_indet("simulate", "--protocol", "cd2", "--from", "g.h5", "--time-limit", "20", "-o", "p.h5")

    def tilt(self, rate, *more, output="t.h5"):
        done = self.run_indet("--json", *TILT, rate, *more, "-o", output, "--overwrite")
        return json.loads(done.stdout)["tilt"]

    def test_the_disk_rolls_out_of_its_groove_where_the_linear_program_says(self):
        self.groove_at_rest()
        limit = json.loads(self.run_indet("--json", "limit", "p.h5", "--tilt").stdout)["limits"][0]["largest"]
        self.assertAlmostEqual(limit, PHI, 12)
        for rate in (0.5, -0.5):
            tilt = self.tilt(rate)
            # It has to roll 0.001 r_max first, with 2/3 of what is out of balance.
            delay = np.cbrt(9 * 0.001 * math.radians(0.5) ** 2)
            self.assertEqual([disk["id"] for disk in tilt["moved_disks"]], [0])
            self.assertAlmostEqual(math.copysign(1, rate) * tilt["angle"], PHI + delay, delta=0.03 * delay)
            self.assertEqual(tilt["ending"], "moved")

    def test_the_packing_that_is_written_balances_under_turned_gravity(self):
        self.groove_at_rest()
        before = residual(self.folder / "p.h5")
        self.assertLess(max(before), 1e-12)
        self.tilt(0.5, "--tilt-every", "0.7")
        self.assertLess(max(residual(self.folder / "t.h5")), 1e-12)
        with h5py.File(self.folder / "t.h5") as file:
            angle = file["tilt"].attrs["rest_angle"]
            gravity = file["parameters"].attrs["gravity"]
            np.testing.assert_allclose(gravity, [math.sin(angle), -math.cos(angle)], atol=1e-15)
            # Turned the other way it would not balance.
            self.assertAlmostEqual(math.degrees(angle), 10, delta=0.8)
            self.assertTrue(np.all(np.diff(file["tilt/angle"]) > 0))
            self.assertEqual(file["tilt/moved_at"][0], file["tilt"].attrs["angle"])
            self.assertEqual(file["tilt/angle"].attrs["unit"], "rad")
        self.run_indet("analyze", "t.h5")
        left = json.loads(self.run_indet("--json", "limit", "t.h5", "--tilt").stdout)["limits"][0]["largest"]
        self.assertAlmostEqual(left, PHI - angle, 9)

    def test_a_pile_tilts_as_its_mirror_image_does(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "12", "--seed", "4", "-o", "p.h5")
        with h5py.File(self.folder / "p.h5") as file:
            disks = file["particles/disks"]
            x, y = disks["position"][()].T
            radius, mass = disks["radius"][()], disks["mass"][()]
            ids = disks["id"][()]
            walls = list(zip(file["walls/point"][()], file["walls/normal"][()]))
            contacts = list(zip(*(file[f"contacts/{name}"][()] for name in ("body_a", "body_b", "R", "T"))))
        self.write("m", {
            "disks.csv": "id,x,y,radius,mass\n" + "".join(
                f"{i},{-a!r},{b!r},{r!r},{m!r}\n" for i, a, b, r, m in zip(ids, x.tolist(), y.tolist(), radius.tolist(), mass.tolist())),
            "walls.csv": "id,px,py,nx,ny,name\n" + "".join(
                f"{i},{-p[0]!r},{p[1]!r},{-n[0]!r},{n[1]!r},w{i}\n" for i, (p, n) in
                enumerate((p.tolist(), n.tolist()) for p, n in walls)),
            "contacts.csv": "a,b,R,T\n" + "".join(f"{a},{b},{R!r},{-T!r}\n" for a, b, R, T in
                                                  [(int(a), int(b), float(R), float(T)) for a, b, R, T in contacts]),
            "scene.toml": "gravity = [0, -1]\nmu = 0.3\n"})
        self.run_indet("import", "--format", "csv", "m", "-o", "mirror.h5")
        tilt = self.tilt(0.1, "--tilt-limit", "30")
        done = self.run_indet("--json", "simulate", "--protocol", "cd1", "--from", "mirror.h5", "--tilt-rate", "-0.1", "--tilt-limit", "30",
                              "-o", "t2.h5")
        mirrored = json.loads(done.stdout)["tilt"]
        self.assertEqual(len(tilt["moved_disks"]), 1)
        self.assertEqual([disk["id"] for disk in tilt["moved_disks"]], [disk["id"] for disk in mirrored["moved_disks"]])
        self.assertAlmostEqual(math.degrees(tilt["angle"]), -math.degrees(mirrored["angle"]), delta=0.01)

    def test_trajectory_shows_what_moves_and_the_report_tells_it(self):
        self.groove_at_rest()
        done = self.run_indet(*TILT, "0.5", "--every", "5", "-o", "t.h5")
        self.assertIn("disk 0 had moved by 0.001 r_max at 10.5", done.stdout)
        self.assertIn("at 0.00°: 2 contacts", done.stdout)
        with h5py.File(self.folder / "t.h5") as file:
            self.assertGreater(len(file["trajectory/time"]), 3)
            x = file["trajectory/position"][:, 0]
            self.assertGreater(np.linalg.norm(x[-1] - x[0]), 0.001)
        self.run_indet("trajectory", "t.h5", "-o", "t.svg")
        shown = self.run_indet("inspect", "t.h5").stdout
        self.assertIn("gravity turned from 0° to 10.5", shown)
        self.assertEqual(json.loads(self.run_indet("--json", "inspect", "t.h5").stdout)["tilt"]["moved"], 1)
        self.assertIn("/simulation, /tilt", self.run_indet("verify", "t.h5").stdout)

    def test_an_angle_at_which_nothing_moves(self):
        self.groove_at_rest()
        done = self.run_indet(*TILT, "1", "--tilt-limit", "5", "-o", "t.h5")
        self.assertIn("no disk had moved by 0.001 r_max", done.stdout)
        with h5py.File(self.folder / "t.h5") as file:
            self.assertEqual(file["tilt"].attrs["ending"], "angle limit")
            self.assertAlmostEqual(math.degrees(file["tilt"].attrs["rest_angle"]), 5, 12)
            self.assertTrue(np.isnan(file["tilt/moved_at"][0]))

    def test_forces_of_another_simulator_are_told(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "12", "--seed", "4", "-o", "p.h5")
        done = self.run_indet("simulate", "--protocol", "md1", "--from", "p.h5", "--tilt-rate", "1", "--tilt-limit", "0.1",
                              "--tilt-distance", "0.05", "-o", "t.h5")
        self.assertIn("its forces changed by", done.stderr)

    def test_options_without_effect_are_refused(self):
        self.groove_at_rest()
        for arguments, message in ((["simulate", "--protocol", "cd1", "--tilt-rate", "1"], "--from"),
                                   ([*TILT, "0"], "rate of the tilt"),
                                   ([*TILT, "1", "--resume"], "--resume has no effect"),
                                   ([*TILT, "1", "--checkpoint", "3"], "--checkpoint has no effect"),
                                   ([*TILT, "1", "--tilt-moved", "2"], "2 of 1 disks"),
                                   ([*TILT, "1", "--gravity", "0,-1"], "--gravity has no effect"),
                                   (["simulate", "--protocol", "cd1", "--from", "p.h5", "--tilt-limit", "3"], "without --tilt-rate"),
                                   (["simulate", "--protocol", "cd2", "--tilt-every", "1"], "without --tilt-rate")):
            with self.subTest(arguments):
                self.assertIn(message, self.run_indet(*arguments, "-o", "x.h5", status=3).stderr)
                self.assertFalse((self.folder / "x.h5").exists())
        self.assertIn("forces of contact 0 are not known", self.run_indet(
            "simulate", "--protocol", "cd1", "--from", "g.h5", "--tilt-rate", "1", "-o", "x.h5", status=3).stderr)

    def test_an_interrupt_ends_it(self):
        self.groove_at_rest()
        process = subprocess.Popen([program.INDET, *TILT, "1e-5", "-o", "t.h5"], cwd=self.folder, stderr=subprocess.PIPE)
        program.wait_until_under_way(process, signal.SIGINT, 0.1)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(10), 128 + signal.SIGINT)
        process.stderr.close()
        self.assertFalse((self.folder / "t.h5").exists())


if __name__ == "__main__":
    program.main()
