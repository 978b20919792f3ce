"""Reads the files of write_samples.cc with h5py: a reader that shares no code with the writer."""

import pathlib
import re
import subprocess
import sys
import unittest

import h5py
import numpy as np

FOLDER, FORMAT = (sys.argv.pop() for _ in range(2))
# group, name, type ("attribute" of the group, or of the numbers of a dataset), shape, unit, meaning
FIELDS = [line.split("\t") for line in pathlib.Path(FOLDER, "fields.txt").read_text().splitlines()]


class Samples(unittest.TestCase):
    def setUp(self):
        self.file = h5py.File(f"{FOLDER}/ranges.h5", "r")
        self.addCleanup(self.file.close)

    def equal(self, path, expected, dtype):
        dataset = self.file[path]
        self.assertEqual(dataset.dtype, np.dtype(dtype), path)
        expected = np.asarray(expected)
        self.assertEqual(dataset.shape, expected.shape, path)
        np.testing.assert_array_equal(dataset[()], expected, path)

    def test_every_dataset_is_readable_and_labelled(self):
        found = []

        def check(name, thing):
            if not isinstance(thing, h5py.Dataset):
                return
            found.append("/" + name)
            self.assertIsInstance(thing.attrs["unit"], str)
            self.assertTrue(thing.attrs["unit"])
            self.assertGreater(len(thing.attrs["long_name"]), 3)
            self.assertIsNotNone(thing[()])

        self.file.visititems(check)
        self.assertEqual(len(found), 54 + 10, found)  # ten of /VTKHDF are not links to others

    def test_root(self):
        self.assertEqual(self.file.attrs["Conventions"], "H5MD-1.1 indet-1")
        self.assertEqual(list(self.file.attrs["schema_version"]), [1, 1])
        self.assertEqual(self.file.attrs["complete"], 1)
        self.assertEqual(list(self.file["h5md"].attrs["version"]), [1, 1])
        self.assertEqual(self.file["h5md/creator"].attrs["name"], "indet")
        self.assertIn("name", self.file["h5md/author"].attrs)

    def test_parameters(self):
        attrs = self.file["parameters"].attrs
        self.assertEqual(attrs["protocol"], "import csv")
        self.assertEqual(attrs["seed"], 17)
        self.assertEqual(attrs["config"], '[import]\nformat = "csv"\n')
        self.assertTrue(np.isnan(attrs["mu"]))
        self.assertEqual(list(attrs["gravity"]), [0, -2])
        self.assertEqual(attrs["mg"], 4)
        self.assertEqual(attrs["r_max"], 1)

    def test_disks(self):
        i = np.arange(3.0)
        group = "particles/disks/"
        self.equal(group + "id", [10, 11, 12], "<i4")
        self.equal(group + "position", [[0, 1], [2.5, 1], [1.25, 2.5612494995995996]], "<f8")
        self.equal(group + "angle", 0.1 * i, "<f8")
        self.equal(group + "velocity", np.stack([0.01 * i, 0.02 * i], 1), "<f8")
        self.equal(group + "angular_velocity", 0.03 * i, "<f8")
        self.equal(group + "radius", [1, 1, 1], "<f8")
        self.equal(group + "mass", 1 + i, "<f8")
        self.equal(group + "inertia", 0.5 + i, "<f8")
        self.equal(group + "load", np.stack([0.1 + i, 0.2 + i, 0.3 + i], 1), "<f8")
        self.assertEqual(self.file[group + "box"].attrs["dimension"], 2)
        self.assertEqual(list(self.file[group + "box"].attrs["boundary"]), ["none", "none"])

    def test_walls(self):
        self.equal("walls/id", [4, 9], "<i4")
        self.equal("walls/point", [[0.5, 0], [-1, 3]], "<f8")
        self.equal("walls/normal", [[0, 1], [1, 0]], "<f8")
        self.assertEqual(list(self.file["walls/name"].asstr()[()]), ["floor", "links ∥"])

    def test_contacts(self):
        self.equal("contacts/body_a", [0, 1, 0, 2, 2], "<i4")
        self.equal("contacts/body_b", [-1, -1, -2, 0, 1], "<i4")
        self.equal("contacts/mu", [0.5, 0.25, 0.125, 0, 1], "<f8")
        self.equal("contacts/R", [10, 11, 12, 13, 14], "<f8")
        self.equal("contacts/T", [-1, -2, -3, -4, np.nan], "<f8")
        normal = self.file["contacts/normal"][()]
        np.testing.assert_allclose(normal[3], [0.625, 0.7806247497997998], rtol=1e-14)
        np.testing.assert_allclose(normal[4], [-0.625, 0.7806247497997998], rtol=1e-14)
        np.testing.assert_allclose(self.file["contacts/gap"][()], 0, atol=1e-14)

    def test_equilibrium(self):
        attrs = self.file["equilibrium"].attrs
        expected = {
            "status": "unbounded", "unknowns": 9, "equations": 8, "rank": 6, "nullity": 4, "dim": 3, "blocks": 2,
            "rank_gap": 1e12, "smallest_accepted": 0.25, "largest_rejected": 1e-16, "rank_ambiguous": 1, "doubtful": 1,
            "residual": 1e-14, "force_unit": 4, "sliding": 1, "non_transmitting": 0, "objectives": 20,
            "determined": 2, "certified": 12, "imprecise": 3, "failed": 1, "unbounded": 4,
            "worst_primal_residual": 4.3e-14, "worst_dual_residual": 2.5e-15,
        }
        self.assertEqual(dict(attrs), expected)

    def test_ranges(self):
        i = np.arange(5.0)[:, None]
        j = np.arange(4.0)
        value = 100 + 10 * i + j
        value[2, 1] = np.inf
        value[3, 2] = np.nan
        for column, name in enumerate(["R_min", "R_max", "T_min", "T_max"]):
            self.equal(f"ranges/{name}", value[:, column], "<f8")
        self.equal("ranges/lower", 200 + 10 * i + j, "<f8")
        self.equal("ranges/upper", 300 + 10 * i + j, "<f8")
        self.equal("ranges/primal_residual", 1e-15 * (10 * i + j), "<f8")
        self.equal("ranges/dual_residual", -1e-16 * (10 * i + j), "<f8")
        self.equal("ranges/sensitivity", 0.5 * (10 * i + j), "<f8")
        self.equal("ranges/sensitivity_claim", (i + j) % 3, "u1")
        self.equal("ranges/outcome", (i + j) % 5, "u1")
        self.assertEqual(
            h5py.check_enum_dtype(self.file["ranges/outcome"].dtype),
            {"optimal": 0, "unbounded": 1, "imprecise": 2, "failed": 3, "not_requested": 4})
        self.equal("ranges/unique", (i * j) % 2, "u1")
        self.equal("ranges/vertex", (4 * i + j) % 8 - 1, "<i4")
        i = i[:, 0]
        for factor, name in [(1.5, "delta_R"), (2.5, "delta_T"), (3.5, "d_R"), (4.5, "d_T"), (0.125, "R_star"),
                             (-0.125, "T_star")]:
            self.equal(f"ranges/{name}", factor * i, "<f8")
        self.equal("extremal/rays", np.arange(10.0)[None, :], "<f8")
        ray = np.full((5, 4), -1)
        ray[2, 1] = 0
        self.equal("ranges/ray", ray, "<i4")

    def test_extremal(self):
        k = np.arange(7.0)[:, None]
        self.equal("extremal/states", 1000 * k + np.arange(10.0) + 0.5, "<f8")
        self.equal("extremal/norm", 7 - k[:, 0], "<f8")
        self.equal("extremal/active", k + np.arange(3.0), "<i4")
        self.assertEqual(self.file["extremal"].attrs["largest_norm"], 6)

    def test_reactions(self):
        k, end = np.arange(4.0)[:, None], np.arange(2.0)
        self.equal("reactions/body", [-1, -1, -2, -2], "<i4")
        self.equal("reactions/component", [0, 1, 0, 1], "<i4")
        for name, beside in (("value", 0), ("lower", -0.25), ("upper", 0.25)):
            self.equal(f"reactions/{name}", 20 + 10 * k + end + beside, "<f8")
        vertex, ray = (k + end) % 3, np.full((4, 2), -1.0)
        vertex[3, 1], ray[3, 1] = -1, 0
        self.equal("reactions/vertex", vertex, "<i4")
        self.equal("reactions/ray", ray, "<i4")
        self.equal("reactions/states", 100 * np.arange(3.0)[:, None] + np.arange(10.0) + 0.5, "<f8")
        self.equal("reactions/rays", np.arange(10.0)[None], "<f8")

    def test_provenance(self):
        group = self.file["provenance"]
        self.assertEqual(list(group.attrs["argv"]), ["indet", "analyze"])
        self.assertEqual(group["libraries"].attrs["GLPK"], "5.0")
        self.assertEqual(dict(group["timings"].attrs), {"ranges": 1.5, "rank": 0.25, "read": 0.5})
        self.assertEqual(dict(group["work"].attrs), {"method": "lp", "formulation": "edge", "solves": 11, "pivots": 57})

    def test_digests_as_documented(self):
        snippet = re.search(r"```python\n(.*?)```", pathlib.Path(FORMAT).read_text(), re.DOTALL).group(1)
        done = subprocess.run([sys.executable, "-c", snippet], cwd=FOLDER, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "True\nTrue\nTrue\n")

    def test_files_have_the_fields_of_the_list(self):
        sizes = {"2": 2, "3": 3, "4": 4, "N": 3, "W": 2, "M": 5, "2M": 10, "K": 7, "Q": 1, "d": 3, "P": 4, "S": 3, "U": 1, "B": 6, "C": 2, "D": 2, "4D": 8,
                 "Y": 16}
        types = {"f8": "<f8", "i4": "<i4", "u1": "u1", "enum": "u1"}
        with h5py.File(f"{FOLDER}/rare.h5", "r") as file:
            for group, name, kind, shape, unit, meaning in FIELDS:
                with self.subTest(field=f"{group}/{name}"):
                    self.assertTrue(meaning)
                    if kind == "attribute":
                        self.assertIn(name, file[group].attrs)
                        continue
                    dataset = file[f"{group}/{name}"]
                    self.assertEqual(dataset.dtype, np.dtype(types[kind]))
                    self.assertEqual(dataset.shape, tuple(sizes[size] for size in shape.split(",")))
                    self.assertEqual((dataset.attrs["unit"], dataset.attrs["long_name"]), (unit, meaning))
            stored = set()
            for group in ["equilibrium", "ranges", "extremal", "reactions", "duals", "provenance/work"]:
                stored |= {(f"/{group}", name) for name in [*file[group].attrs, *file[group]]}
        # Of no result: the digest, and the level of confidence that all samples share.
        self.assertEqual(stored - {("/ranges", "sha256"), ("/ranges", "confidence")},
                         {(group, name) for group, name, *_ in FIELDS})

    def test_the_documents_have_the_fields_of_the_list(self):
        text = pathlib.Path(FORMAT).read_text()
        section = text[text.index("## Force ranges"):text.index("## Digests")]
        documented = {}
        for row in re.findall(r"^\| (`/.*?) \| (.*?) \| .*\|$", section, re.MULTILINE):
            names = re.findall(r"[\w/@]+", row[0])
            group = names[0].rpartition("/")[0]
            for name in names:
                documented[name if name.startswith("/") else f"{group}/{name}"] = row[1]
        provenance = re.search(r"^\| `/provenance` .*$", text, re.MULTILINE)[0]
        words = set(re.findall(r"[`@](\w+)`", provenance + section))
        for group, name, kind, shape, _, _ in FIELDS:
            with self.subTest(field=f"{group}/{name}"):
                if kind == "attribute":
                    self.assertTrue(name in words)
                else:
                    self.assertEqual(documented.pop(f"{group}/{name}"), f"{kind}[{shape}]")
        self.assertEqual([path for path in documented if "@" not in path and path != "/equilibrium"], [])

    def test_large_data_are_compressed(self):
        with h5py.File(f"{FOLDER}/large.h5", "r") as file:
            states = file["extremal/states"]
            self.assertEqual((states.compression, states.shuffle, states.fletcher32), ("gzip", True, True))
            expected = np.arange(3001.0)[:, None] + 0.0625 * np.arange(10)
            np.testing.assert_array_equal(states[()], expected)
            self.assertIsNone(file["ranges/R_min"].compression)


if __name__ == "__main__":
    unittest.main(verbosity=0)
