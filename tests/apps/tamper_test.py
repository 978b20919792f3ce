"""`indet verify` notices a single changed number, wherever it is.

Argument: the indet executable.
"""

import pathlib
import re
import shutil
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

FILE_FORMAT = ""

# Results that are not computed a second time. One that leaves this list is progress, one that joins it is a loss.
GUARDED_BY_THE_DIGEST_ALONE = {
    "equilibrium@blocks", "equilibrium@determined", "equilibrium@doubtful", "equilibrium@equations",
    "equilibrium@largest_rejected",
    "equilibrium@rank_ambiguous", "equilibrium@rank_gap", "equilibrium@smallest_accepted",
    "equilibrium@worst_dual_residual", "equilibrium@worst_primal_residual", "ranges/sensitivity", "ranges/unique",
    "ranges/upper"}


def digest_of_documentation():
    """The function `digest` of docs/file-format.md."""
    code = re.search(r"```python\n(.*?)\nwith h5py", pathlib.Path(FILE_FORMAT).read_text(), re.DOTALL).group(1)
    names = {}
    exec(code, names)
    return names["digest"]


def numbers_of(file):
    """Every numeric dataset and attribute outside of /provenance: (path, attribute or None)."""
    places = []

    def add(name, thing):
        if isinstance(thing, h5py.Dataset) and thing.dtype.kind in "fiu" and thing.size > 0:
            places.append((name, None))
        for key, value in thing.attrs.items():
            if np.asarray(value).dtype.kind in "fiu":
                places.append((name, key))

    for root in file:
        if root == "provenance":
            continue
        add(root, file[root])
        file[root].visititems(lambda name, thing, root=root: add(f"{root}/{name}", thing))
    return places


def other(value):
    """A number a little beside the given one; a finite one for inf and NaN."""
    if value.dtype.kind == "f":
        return value * (1 + 1e-6) + 1e-6 if np.isfinite(value) else value.dtype.type(0.125)
    return value - 1 if value > 0 else value + 1


def change(file, path, attribute):
    if attribute is None:
        data = file[path][()]
        index = tuple(size // 2 for size in data.shape)
        data[index] = other(data[index])
        file[path][...] = data
        return
    value = np.array(file[path].attrs[attribute])
    value.flat[-1] = other(value.flat[-1])
    file[path].attrs.modify(attribute, value)


class Tamper(program.ProgramTest):
    def setUp(self):
        super().setUp()
        # A pyramid whose "simulated" forces are the middle of its ranges, so that every measure has a value.
        self.packing(program.pyramid())
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            middle = file["extremal/states"][()].mean(axis=0).reshape(-1, 2).tolist()
        self.packing(program.pyramid(forces=middle), name="q")
        self.analyze()

    def analyze(self, *options):
        self.run_indet("analyze", "q.h5", "-o", "good.h5", *options)
        self.run_indet("verify", "good.h5")
        with h5py.File(self.folder / "good.h5") as file:
            self.places = numbers_of(file)
        self.assertGreater(len(self.places), 60)

    def verify_changed(self, path, attribute, forge=None):
        shutil.copy(self.folder / "good.h5", self.folder / "bad.h5")
        with h5py.File(self.folder / "bad.h5", "r+") as file:
            change(file, path, attribute)
            if forge:
                forge(file)
        with h5py.File(self.folder / "bad.h5") as file:
            kind = (file[path] if attribute is None else np.asarray(file[path].attrs[attribute])).dtype.kind
        return kind

    def test_every_number(self):
        for path, attribute in self.places:
            with self.subTest(path=path, attribute=attribute):
                kind = self.verify_changed(path, attribute)
                done = program.run([program.INDET, "verify", "bad.h5"], self.folder)
                # An index that names nothing, a normal of another length, a version that is not ours are refused
                # before anything is checked.
                refused = kind != "f" or attribute is not None or path.endswith("normal")
                allowed = [3, 5] if refused else [5]
                self.assertIn(done.returncode, allowed, done.stdout + done.stderr)
                if done.returncode == 5:
                    self.assertIn("some number is not the one that was written", done.stdout)
                else:
                    self.assertIn("bad.h5", done.stderr)

    def test_results_with_a_forged_digest(self):
        digest = digest_of_documentation()

        def forge(file):
            file["ranges"].attrs.modify("sha256", digest(file, ["extremal", "ranges"]))
            file.attrs.modify("content_sha256", digest(file, [name for name in file if name != "provenance"]))

        self.assertEqual(self.unnoticed_with_a_forged_digest(("ranges", "extremal", "equilibrium"), forge),
                         GUARDED_BY_THE_DIGEST_ALONE)
        # Of a sample of contacts, what tells about the others.
        self.analyze("--contacts", "sample:3", "--seed", "4")
        sampled = {attribute for path, attribute in self.places if path == "ranges"}
        self.assertEqual(sampled, {"requested", "sample_seed", "confidence", "mean_delta_R", "band_delta_R",
                                   "mean_delta_T", "band_delta_T"})
        self.assertEqual(self.unnoticed_with_a_forged_digest(("ranges",), forge) - GUARDED_BY_THE_DIGEST_ALONE,
                         {"ranges@sample_seed"})

    def unnoticed_with_a_forged_digest(self, groups, forge):
        results = [(path, attribute) for path, attribute in self.places if path.split("/")[0] in groups]
        unnoticed = []
        for path, attribute in results:
            self.verify_changed(path, attribute, forge)
            done = program.run([program.INDET, "verify", "bad.h5"], self.folder)
            self.assertIn(done.returncode, [0, 3, 5], done.stderr)
            self.assertNotIn("content_sha256", done.stdout)
            if done.returncode == 0:
                unnoticed.append(path if attribute is None else f"{path}@{attribute}")
        return set(unnoticed)


if __name__ == "__main__":
    program.main("FILE_FORMAT")
