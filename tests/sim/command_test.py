"""Runs simulate, sample and trajectory as a user does, and reads their files with h5py.

Argument: the indet executable.
"""

import json
import pathlib
import signal
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

INDET = program.INDET = sys.argv.pop()
SMALL = ["--disks", "15", "--seed", "2"]


def residual(path):
    """Largest out-of-balance force or torque/r of a file's packing, in mg, recomputed from its datasets."""
    with h5py.File(path) as file:
        disks = file["particles/disks"]
        mass, radius = disks["mass"][()], disks["radius"][()]
        force = np.zeros((len(mass), 3))
        force[:, :2] = mass[:, None] * file["parameters"].attrs["gravity"]
        c = file["contacts"]
        for a, b, n, R, T in zip(c["body_a"], c["body_b"], c["normal"], c["R"], c["T"]):
            f = R * n + T * np.array([n[1], -n[0]])
            force[a] += [*f, T]
            if b >= 0:
                force[b] += [*-f, T]
        return np.abs(force).max() / file["parameters"].attrs["mg"]


class SimulateTest(program.ProgramTest):
    def test_every_protocol_makes_a_balanced_packing(self):
        self.run_indet("simulate", "--protocol", "cd1", *SMALL, "-o", "cd1.h5")
        for protocol, more in (("md1", SMALL), ("cd2", ["--from", "cd1.h5"]), ("md2", ["--from", "cd1.h5"]),
                               ("md2", ["--from", "cd1.h5", "--preset", "paper"])):
            out = self.run_indet("--json", "simulate", "--protocol", protocol, *more, "-o", "p.h5").stdout
            result = json.loads(out)
            self.assertEqual(result["protocol"], protocol)
            self.assertLessEqual(result["residual"], 1e-12)
            self.assertLess(residual(self.folder / "p.h5"), 1e-11)
        self.run_indet("analyze", "p.h5", "-o", "ranges.h5")

    def test_inspect_shows_simulation_trajectory_and_samples(self):
        self.run_indet("simulate", "--protocol", "cd1", *SMALL, "--width", "12", "--every", "0.5", "-o", "p.h5")
        shown = json.loads(self.run_indet("--json", "inspect", "p.h5").stdout)
        with h5py.File(self.folder / "p.h5") as file:
            self.assertEqual(shown["simulation"]["steps"], file["simulation"].attrs["steps"])
            self.assertEqual(shown["simulation"]["reason"], file["simulation"].attrs["reason"])
            self.assertEqual(shown["trajectory"]["frames"], len(file["trajectory/time"]))
            self.assertEqual((shown["Lx"], file["parameters"].attrs["Lx"]), (12, 12))
            self.assertEqual(shown["Ly"], file["parameters"].attrs["Ly"])
        self.assertNotIn("sampling", shown)
        self.run_indet("sample", "p.h5", "--samples", "5", "-o", "s.h5")
        shown = json.loads(self.run_indet("--json", "inspect", "s.h5").stdout)
        self.assertEqual(shown["sampling"]["samples"], 5)
        self.assertEqual(shown["Lx"], 12)
        self.assertNotIn("simulation", shown)
        text = self.run_indet("inspect", "p.h5").stdout + self.run_indet("inspect", "s.h5").stdout
        for line in ("contact dynamics", "trajectory", "samples", "Lx = 12"):
            self.assertIn(line, text)

    def test_unlike_friction_needs_a_choice(self):
        scene = ["--disks", "15", "--seed", "2", "--mu", "0.4", "--wall-mu", "0.2"]
        self.run_indet("simulate", "--protocol", "cd1", *scene, "-o", "p.h5")
        with h5py.File(self.folder / "p.h5", "r+") as file:
            row = np.flatnonzero(file["contacts/body_b"][()] >= 0)[0]
            file["contacts/mu"][row] = 0.5
        done = self.run_indet("simulate", "--protocol", "md2", "--from", "p.h5", "-o", "q.h5", status=3)
        self.assertIn("--mu", done.stderr)
        self.run_indet("simulate", "--protocol", "md2", "--from", "p.h5", "--mu", "0.6", "-o", "q.h5")
        with h5py.File(self.folder / "q.h5") as file:
            self.assertEqual(set(file["contacts/mu"][()]), {0.6})

    def test_says_before_a_long_simulation_what_to_expect(self):
        done = self.run_indet("simulate", "--protocol", "cd1", "--disks", "3200", "--time-limit", "0.002", "-o", "long.h5", status=5)
        self.assertIn("3200 disks by contact dynamics take about 3 minutes of processor time", done.stderr)
        done = self.run_indet("simulate", "--protocol", "cd1", *SMALL, "-o", "short.h5")
        self.assertNotIn("processor time", done.stderr)

    def test_scene_file_is_used_and_flags_override_it(self):
        (self.folder / "scene.toml").write_text(
            'disks = 7\ncontainer = "funnel"\nfriction = { disk = 0.5, wall = 0.4 }\n[[wall]]\npoint = [0, -1]\nnormal = [0, 1]\n')
        self.run_indet("simulate", "--protocol", "cd1", "--scene", "scene.toml", "--wall-mu", "0.2", "-o", "p.h5")
        with h5py.File(self.folder / "p.h5") as file:
            self.assertEqual(len(file["particles/disks/id"]), 7)
            self.assertEqual(len(file["walls/point"]), 5)
            mu = {bool(b < 0): m for b, m in zip(file["contacts/body_b"], file["contacts/mu"])}
        self.assertEqual(mu[True], 0.2)
        self.assertEqual(mu.get(False, 0.5), 0.5)

    def test_bad_input_is_refused_and_nothing_is_written(self):
        (self.folder / "scene.toml").write_text("disks = 7\nradii = 3\n")
        done = self.run_indet("simulate", "--protocol", "cd1", "--scene", "scene.toml", "-o", "p.h5", status=3)
        self.assertIn("scene.toml:2: radii", done.stderr)
        done = self.run_indet("simulate", "--protocol", "md1", "--preset", "paper", "--damping-method", "explicit", "--dt",
                              "1e-4", "-o", "p.h5", status=3)
        self.assertIn("not stable", done.stderr)
        self.run_indet("simulate", "--protocol", "cd1", "--stiffness", "3", "-o", "p.h5", status=3)
        self.assertFalse((self.folder / "p.h5").exists())

    def test_walls_that_cannot_be_are_refused(self):
        wall = "disks = 7\n[[wall]]\nname = \"ramp\"\npoint = [0, {}]\nnormal = {}\n"
        for text, message in [
                (wall.format(-1, "[0.609, 0.812]"), "scene.toml:5: normal must have length 1, but has length 1.015; "
                                                    "in this direction that is [0.6, 0.8]"),
                (wall.format(-1, "[0, 0]"), "scene.toml:5: normal must have length 1, but has length 0"),
                (wall.format(-1, "[nan, 0]"), "scene.toml:5: normal must be finite, but is nan"),
                (wall.format(20, "[0.6, 0.8]"), "inside wall ramp: the grid of 1 × 7 cells fills 0 ≤ x ≤ 2.2, "
                                                "0 ≤ y ≤ 14; move the wall"),
                (wall.format(-1, "[0, -1]"), "inside wall ramp: the grid"),
        ]:
            with self.subTest(message):
                (self.folder / "scene.toml").write_text(text)
                done = self.run_indet("simulate", "--protocol", "cd1", "--scene", "scene.toml", "-o", "p.h5", status=3)
                self.assertIn(message, done.stderr)
                self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["scene.toml"])

    def test_trajectory_is_drawn(self):
        self.run_indet("simulate", "--protocol", "cd1", *SMALL, "--every", "0.5", "-o", "t.h5")
        with h5py.File(self.folder / "t.h5") as file:
            frames = len(file["trajectory/time"])
            self.assertEqual(file["trajectory/position"].shape, (frames, 15, 2))
            self.assertEqual(file["trajectory/first_contact"][-1], len(file["trajectory/contacts/R"]))
        self.run_indet("trajectory", "t.h5", "-o", "strip.svg", "--frames", "3")
        self.run_indet("trajectory", "t.h5", "-o", "film.svg", "--animate")
        circles = lambda name: len(xml.etree.ElementTree.parse(self.folder / name).findall(
            ".//{http://www.w3.org/2000/svg}circle"))
        self.assertEqual(circles("strip.svg"), 3 * 15)
        self.assertEqual(circles("film.svg"), frames * 15)
        self.run_indet("simulate", "--protocol", "cd1", *SMALL, "-o", "n.h5")
        self.assertIn("--every", self.run_indet("trajectory", "n.h5", "-o", "x.svg", status=3).stderr)

    def test_interrupted_run_resumes_to_the_same_bytes(self):
        run = ["simulate", "--protocol", "cd1", "--disks", "80", "--every", "2"]
        self.run_indet(*run, "-o", "whole.h5")
        process = subprocess.Popen([INDET, *run, "--checkpoint", "0.1", "-o", "p.h5"], cwd=self.folder,
                                   stderr=subprocess.DEVNULL)
        while not (self.folder / "p.h5.checkpoint").exists():
            self.assertIsNone(process.poll(), "it ended before its first checkpoint")
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 128 + signal.SIGINT)
        self.assertFalse((self.folder / "p.h5").exists())
        self.assertTrue((self.folder / "p.h5.checkpoint").exists())
        self.run_indet(*run, "--mu", "0.4", "--resume", "-o", "p.h5", status=3)
        self.run_indet(*run, "--resume", "-o", "p.h5")
        self.assertFalse((self.folder / "p.h5.checkpoint").exists())
        with h5py.File(self.folder / "p.h5") as p, h5py.File(self.folder / "whole.h5") as q:
            self.assertEqual(p.attrs["content_sha256"], q.attrs["content_sha256"])

    def test_samples_do_not_depend_on_threads(self):
        self.run_indet("simulate", "--protocol", "cd1", *SMALL, "-o", "p.h5")
        radii = set()
        for threads in (1, 2):
            out = self.run_indet("--json", "--threads", threads, "sample", "p.h5", "--samples", "40", "--chains", "4", "-o",
                                 "s.h5").stdout
            radii.add(json.loads(out)["r"])
        self.assertEqual(len(radii), 1)
        with h5py.File(self.folder / "s.h5") as file:
            self.assertEqual(file["sampling"].attrs["r"], radii.pop())
            self.assertEqual(len(file["sampling/center"]), 2 * len(file["contacts/R"]))


if __name__ == "__main__":
    unittest.main()
