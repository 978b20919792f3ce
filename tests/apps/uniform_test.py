"""indet sample --method uniform as a user runs it; its files are read with h5py.

Arguments: the indet executable.
"""

import json
import math
import pathlib
import sys
import tomllib

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402


def pinched():
    """A disk between two vertical walls: R ≥ 1/(2μ) has no upper limit."""
    scene = program.groove()
    scene["walls.csv"] = "id,px,py,nx,ny,name\n0,-1,0,1,0,left\n1,1,0,-1,0,right\n"
    return scene


def balanced_pyramid():
    """The symmetric forces of a pyramid whose lower disks press on each other with 0.1."""
    sine = math.sqrt(3) / 2
    R = (1 + sine - 0.1) / (0.5 + 2 * sine * (1 + sine))
    T = 2 * sine * R - 1
    return program.pyramid(0.9, forces=[(1.5, -T), (1.5, T), (0.1, 0), (R, T), (R, -T)])


class Uniform(program.ProgramTest):
    def sample(self, *arguments, status=0):
        return json.loads(self.run_indet("--json", "sample", "--method", "uniform", *arguments, status=status).stdout)

    def test_the_groove_is_a_uniform_segment(self):
        phi, mu = math.pi / 6, 0.3
        delta_R = mu * math.sin(phi) / (math.cos(phi) ** 2 - (mu * math.sin(phi)) ** 2)
        delta_T = delta_R / math.tan(phi)
        length = math.sqrt(2) * math.hypot(delta_R, delta_T)
        R_min = 0.5 / (math.cos(phi) + mu * math.sin(phi))
        shown = self.sample(self.packing(program.groove(phi, mu)), "--states", "300", "--covariance", "--shape",
                            "-o", "s.h5")
        self.assertEqual(shown["stopped_by"], "convergence")
        self.assertAlmostEqual(shown["r"], length / math.sqrt(12), delta=4 * shown["r_error"])
        for name in ("diameter_lower", "diameter_upper", "mean_width"):
            self.assertAlmostEqual(shown[name], length, places=8)
        self.assertAlmostEqual(shown["log_volume"], math.log(length), delta=4 * shown["log_volume_error"])

        self.run_indet("verify", "s.h5")
        with h5py.File(self.folder / "s.h5") as file:
            group = file["sampling"]
            self.assertEqual(group.attrs["method"], "uniform")
            self.assertEqual(group.attrs["converged"], 1)
            self.assertGreaterEqual(group.attrs["ess"], 400)
            self.assertLessEqual(group.attrs["rhat"], 1.01)
            self.assertEqual(group.attrs["r"], shown["r"])
            for dataset in group.values():
                self.assertTrue(dataset.attrs["unit"])
                self.assertGreater(len(dataset.attrs["long_name"]), 3)
            shapes = {name: dataset.shape for name, dataset in group.items()}
            self.assertEqual(shapes, {"center": (4,), "covariance": (4, 4), "deviation": (4,), "quantile_levels": (5,), "quantiles": (4, 5),
                                      "rhat": (4,), "bulk_ess": (4,), "tail_ess": (4,), "states": (300, 4)})
            R, T = group["states"][:, 0], group["states"][:, 1]
            np.testing.assert_allclose(2 * R * math.cos(phi) - 2 * T * math.sin(phi), 1, atol=1e-12)
            np.testing.assert_allclose(group["states"][:, 2], R, atol=1e-12)
            self.assertTrue(np.all(np.abs(T) <= mu * R + 1e-12))
            error = 4 * 0.5 / math.sqrt(group.attrs["ess"])
            levels = group["quantile_levels"][()]
            np.testing.assert_allclose((group["quantiles"][0] - R_min) / delta_R, levels, atol=error)
            covariance = group["covariance"][()]
            np.testing.assert_allclose(covariance, covariance.T)
            np.testing.assert_allclose(np.sqrt(np.diag(covariance)), group["deviation"], rtol=1e-10)
            # On the segment, all forces are linear in one number.
            np.testing.assert_allclose(np.linalg.eigvalsh(covariance)[:3], 0, atol=1e-12)
            np.testing.assert_allclose(covariance[0, 1] * delta_R, covariance[0, 0] * delta_T, rtol=1e-9)
            self.assertAlmostEqual(group["deviation"][0], delta_R / math.sqrt(12), delta=0.1 * delta_R)

    def test_covariances_are_written_on_request(self):
        packing = self.packing(program.pyramid(0.9))
        self.run_indet("sample", packing, "--method", "uniform", "--effective", "4000", "--states", "1000000",
                       "--covariance", "-o", "s.h5")
        self.run_indet("sample", packing, "--method", "uniform", "-o", "without.h5")
        self.run_indet("verify", "s.h5")
        self.run_indet("verify", "without.h5")
        with h5py.File(self.folder / "s.h5") as file, h5py.File(self.folder / "without.h5") as without:
            group = file["sampling"]
            self.assertEqual(group["covariance"].attrs["unit"], "force2")
            states = group["states"][()]
            expected = np.cov(states, rowvar=False, bias=True)
            np.testing.assert_allclose(group["covariance"][()], expected, atol=1e-10 * np.abs(expected).max())
            self.assertNotIn("covariance", without["sampling"])

    def test_the_text_says_what_was_found(self):
        text = self.run_indet("sample", self.packing(program.groove()), "--method", "uniform", "-o", "s.h5").stdout
        for part in ("dimension 1, 1 independent block", "radius r = ", "converged after", "written to s.h5"):
            self.assertIn(part, text)
        self.assertIn("of the uniform distribution, dimension 1, converged", self.run_indet("inspect", "s.h5").stdout)

    def test_a_limit_is_5_and_said(self):
        packing = self.packing(program.groove())
        shown = self.sample(packing, "--effective", "100000", "--limit", "1000", status=5)
        self.assertEqual(shown["stopped_by"], "limit")
        self.assertEqual(shown["converged"], 0)
        text = self.run_indet("sample", packing, "--method", "uniform", "--effective", "100000", "--limit", "1000",
                              status=5).stdout
        self.assertIn("NOT converged (limit 1000)", text)

    def test_no_limit_to_the_forces_is_3_and_the_ray_is_named(self):
        packing = self.packing(pinched())
        before = self.files()
        done = self.run_indet("sample", packing, "--method", "uniform", "-o", "s.h5", status=3)
        self.assertIn("contact 0 (0–wall left) by R +1", done.stderr)
        self.assertIn("contact 1 (0–wall right) by R +1", done.stderr)
        self.assertEqual(self.files(), before)

    def test_no_contact_state_is_4(self):
        packing = self.packing(program.incline())
        before = self.files()
        self.run_indet("sample", packing, "--method", "uniform", "-o", "s.h5", status=4)
        self.assertEqual(self.files(), before)

    def test_a_point_is_its_own_sample(self):
        shown = self.sample(self.packing(program.groove(math.pi / 6, 0)), "-o", "s.h5")
        self.assertEqual(shown["stopped_by"], "point")
        self.assertEqual(shown["r"], 0)
        with h5py.File(self.folder / "s.h5") as file:
            R = 0.5 / math.cos(math.pi / 6)
            self.run_indet("verify", "s.h5")
            np.testing.assert_allclose(file["sampling/center"][()], [R, 0, R, 0], atol=1e-14)

    def test_threads_change_nothing_and_seeds_do(self):
        packing = self.packing(program.pyramid(0.9))
        states = []
        for threads, seed in [("1", "3"), ("3", "3"), ("1", "4")]:
            self.run_indet("--threads", threads, "sample", packing, "--method", "uniform", "--seed", seed, "--states", "9",
                           "-o", "s.h5")
            with h5py.File(self.folder / "s.h5") as file:
                states.append(file["sampling/states"][()])
        np.testing.assert_array_equal(states[0], states[1])
        self.assertTrue(np.any(states[0] != states[2]))

    def test_options_without_sense_are_2(self):
        packing = self.packing(program.groove())
        for arguments in (["--chains", "1"], ["--effective", "10"], ["--limit", "5"], ["--states", "-1"]):
            self.run_indet("sample", packing, "--method", "uniform", *arguments, status=2)

    def test_options_that_the_method_does_not_read_are_2_and_named(self):
        packing = self.packing(balanced_pyramid())
        before = self.files()
        for method, arguments, reader in [("uniform", ["--samples", "9"], "--method perturb"),
                                          ("uniform", ["--width", "0.4"], "--method perturb"),
                                          ("uniform", ["--distance", "1"], "--method perturb"),
                                          ("uniform", ["--tolerance", "1e-5"], "--method perturb"),
                                          ("uniform", ["--sweeps", "9"], "--method perturb"),
                                          ("uniform", ["--volume-sweeps", "99"], "--shape"),
                                          ("perturb", ["--effective", "500"], "--method uniform"),
                                          ("perturb", ["--limit", "5000"], "--method uniform"),
                                          ("perturb", ["--states", "1"], "--method uniform"),
                                          ("perturb", ["--covariance"], "--method uniform"),
                                          ("perturb", ["--shape"], "--method uniform"),
                                          ("perturb", ["--volume-sweeps", "99"], "--method uniform")]:
            with self.subTest(arguments):
                done = self.run_indet("sample", packing, "--method", method, *arguments, "-o", "s.h5", status=2)
                self.assertIn(f"{arguments[0]} has no effect without {reader}", done.stderr)
                self.assertEqual(self.files(), before)

    def test_stored_configurations_read_back(self):
        packing = self.packing(balanced_pyramid())
        for arguments in (["--method", "uniform", "--shape", "--volume-sweeps", "99"], ["--samples", "9"]):
            with self.subTest(arguments):
                self.run_indet("sample", packing, *arguments, "-o", "s.h5")
                first = self.config_of("s.h5")
                (self.folder / "again.toml").write_text(first)
                (self.folder / "s.h5").unlink()
                self.run_indet("--config", "again.toml", "sample", packing)
                self.assertEqual(tomllib.loads(self.config_of("s.h5")), tomllib.loads(first))


if __name__ == "__main__":
    program.main()
