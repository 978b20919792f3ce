"""`indet verify` notices a single changed number, wherever it is.

Argument: the indet executable.
"""

import json
import pathlib
import re
import shutil
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "support"))
import program  # noqa: E402

FILE_FORMAT = ""

RESULTS = ("ranges", "extremal", "equilibrium", "reactions")
# Results that are not computed a second time. One that leaves this list is progress, one that joins it is a loss.
GUARDED_BY_THE_DIGEST_ALONE = {
    "equilibrium@largest_rejected", "equilibrium@rank_ambiguous", "equilibrium@rank_gap",
    "equilibrium@smallest_accepted", "ranges/sensitivity", "ranges/sensitivity_claim",
    "ranges/unique", "reactions/upper"}

STUDENT = 2.3646242515927844  # 97.5 % quantile with 7 degrees of freedom

SAMPLINGS = {"sampling", "uniform", "bias"}


def places(group, names):
    return {f"{group}{name}" for name in names.split()}


# Of samples. How much is noticed depends on their numbers: these are the places that need not be.
OF_THE_WALK = "@inscribed_radius @requested @seed @steps @warm_up_phases @worst_slack"
OF_THE_SHAPE = ("@diameter_by_ranges @diameter_lower @diameter_upper @log_volume @log_volume_error @mean_width "
                "@mean_width_error @volume_phases @start_R_star_percentile @start_mean_R_star")
OF_SAMPLES_THAT_ARE_NOT_STORED = ("/bulk_ess /quantiles /rhat /tail_ess @most_sliding @norm_bulk_ess @norm_rhat "
                                  "@norm_tail_ess @r_error @spread")
OF_SOLUTIONS = "@accepted @converged @r @r_error @samples @seed @spread @width @worst_raw_residual @worst_residual"
OF_THE_COMPARISON = ("/control_p_distribution /control_p_mean /deviation_R /effective_R /p_distribution "
                     "/uniform_effective_R @center_shift_error")

# Small changes of these are not held against the other steps.
OF_STEPS = ("converged doubtful failed imprecise largest_delta_R largest_delta_T mean_delta_R mean_delta_T mean_width "
            "mean_width_error most_sliding r r_error sliding_error")


def functions_of_documentation():
    """The functions `numbers`, `texts` and `digest` of docs/file-format.md."""
    code = re.search(r"```python\n(.*?)\nwith h5py", pathlib.Path(FILE_FORMAT).read_text(), re.DOTALL).group(1)
    names = {}
    exec(code, names)
    return names["numbers"], names["texts"], names["digest"]


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
    """A number a little beside the given one, further than an enclosure may be wide; a finite one for inf and NaN."""
    if value.dtype.kind == "f":
        return value * (1 + 1e-6) + 2e-6 if np.isfinite(value) else value.dtype.type(0.125)
    return value - 1 if value > 0 else value + 1


def change(file, path, attribute):
    if attribute is None:
        data = file[path][()]
        index = tuple(size // 2 for size in data.shape)
        data[index] = other(data[index])
        file[path][...] = data
        return
    value = np.array(file[path].attrs[attribute])
    last = value.flat[-1]
    # Numbers of a sample are stored as reals, its counts too.
    is_count = path in SAMPLINGS and abs(last) >= 1 and last == np.round(last)
    value.flat[-1] = last - 1 if is_count else other(last)
    file[path].attrs.modify(attribute, value)


class Tampered(program.ProgramTest):
    """Has a file good.h5, and the places of its numbers."""

    def setUp(self):
        super().setUp()
        self.numbers, self.texts, self.digest = functions_of_documentation()
        # A pyramid whose "simulated" forces are the middle of its ranges, so that every measure has a value.
        self.packing(program.pyramid())
        self.run_indet("analyze", "p.h5", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5") as file:
            middle = file["extremal/states"][()].mean(axis=0).reshape(-1, 2).tolist()
        self.packing(program.pyramid(forces=middle), name="q")

    def make(self, *arguments):
        self.run_indet(*arguments, "-o", "good.h5")
        self.run_indet("verify", "good.h5")
        self.remember()

    def remember(self):
        names = {}
        with h5py.File(self.folder / "good.h5") as file:
            self.places = numbers_of(file)
            self.items = self.numbers(file, [root for root in file if root != "provenance"])
            for path, _ in self.places:
                names.setdefault(h5py.h5o.get_info(file[path].id).addr, set()).add(path)
        self.names = {path: same for same in names.values() for path in same}  # all names of the object

    def change_copy(self, path, attribute, forge=False):
        shutil.copy(self.folder / "good.h5", self.folder / "bad.h5")
        with h5py.File(self.folder / "bad.h5", "r+") as file:
            change(file, path, attribute)
            if forge:
                items = dict(self.items)  # to read all numbers again would take longer than to verify them
                for name in self.names[path]:
                    key = f"/{name}" if attribute is None else f"/{name}@{attribute}"
                    items[key] = file[name][()] if attribute is None else file[name].attrs[attribute]
                self.write_digests(file, items)
        with h5py.File(self.folder / "bad.h5") as file:
            kind = (file[path] if attribute is None else np.asarray(file[path].attrs[attribute])).dtype.kind
        return kind

    def forge(self, file):
        self.write_digests(file, self.numbers(file, [root for root in file if root != "provenance"]))

    def write_digests(self, file, items):
        if "ranges" in file:
            of_ranges = {key: value for key, value in items.items() if re.match("/(extremal|ranges)[/@]", key)}
            file["ranges"].attrs.modify("sha256", self.digest(of_ranges))
        file.attrs.modify("content_sha256", self.digest(items))
        file.attrs.modify("text_sha256", self.digest(self.texts(file)))

    def unnoticed(self, *groups):
        """The numbers of the groups that can be changed, with the digest, without a contradiction."""
        unnoticed = set()
        for path, attribute in self.places:
            if path.split("/")[0] not in groups:
                continue
            self.change_copy(path, attribute, forge=True)
            done = program.run([program.INDET, "verify", "bad.h5"], self.folder)
            self.assertIn(done.returncode, [0, 3, 5], done.stderr)
            self.assertNotIn("content_sha256", done.stdout)
            if done.returncode == 5:
                self.assertNotIn(" 0 contradictions", done.stdout)
            if done.returncode == 0:
                unnoticed.add(path if attribute is None else f"{path}@{attribute}")
        self.assert_named(unnoticed)
        return unnoticed

    def assert_named(self, unnoticed):
        """The program itself says that these are not computed again."""
        left = json.loads(self.run_indet("--json", "verify", "good.h5").stdout)["not_checked"]
        named = {word for text in left for word in re.findall(r"\w+", text)}
        for place in unnoticed:
            name = re.split(r"[/@]", place)[-1]
            self.assertTrue(name in named or (name.endswith("percentile") and "percentiles" in named), place)


class AnyChange(Tampered):
    """Of every dataset and attribute that a file has outside of what tells how it was made, of every kind of file."""

    MADE = ("provenance", "h5md/author", "h5md/creator")

    def everything(self, file):
        places = [("/", key) for key in file.attrs]
        seen = set()

        def add(name, thing):
            if name.startswith(self.MADE) or (address := h5py.h5o.get_info(thing.id).addr) in seen:
                return
            seen.add(address)
            if isinstance(thing, h5py.Dataset) and thing.size > 0:
                places.append((name, None))
            places.extend((name, key) for key in thing.attrs)

        for root in file:
            add(root, file[root])
            if isinstance(file[root], h5py.Group):
                file[root].visititems(lambda name, thing, root=root: add(f"{root}/{name}", thing))
        return places

    @staticmethod
    def change_any(file, path, attribute):
        value = np.array(file[path][()] if attribute is None else file[path].attrs[attribute])
        if value.dtype.kind in "fiu":
            return change(file, path, attribute)
        first = value.flat[0]
        text = first.decode() if isinstance(first, bytes) else str(first)
        text = text[:-1] + ("x" if text[-1:] != "x" else "y")
        if attribute is None:
            data = file[path][()]
            data.flat[0] = text.encode()
            file[path][...] = data
        elif value.ndim == 0:
            file[path].attrs.modify(attribute, np.bytes_(text) if value.dtype.kind == "S" else text)
        else:
            value.flat[0] = text
            file[path].attrs.modify(attribute, value)

    def files_of_every_kind(self):
        self.packing(program.groove(), name="g")
        self.packing(program.biaxial_box(1, 1, 1.0, 1.0, 0.3), name="b")
        yield "g.h5"
        yield "b.h5"
        for arguments in (["analyze", "g.h5"],
                          ["analyze", "g.h5", "--method", "barrier", "--duals", "all"],
                          ["analyze", "g.h5", "--accuracy", "estimate", "--calibrate", "1"],
                          ["analyze", "g.h5", "--contacts", "sample:1"],
                          ["analyze", "b.h5"], ["analyze", "g.h5", "--smallest-distances"],
                          ["limit", "b.h5", "--load", "wall=right,1,0", "--friction", "--steps", "1"],
                          ["sample", "g.h5", "--method", "uniform", "--states", "2", "--covariance", "--shape"],
                          ["sample", "q.h5", "--samples", "5"],
                          ["simulate", "--protocol", "cd1", "--disks", "2", "--every", "1"],
                          ["simulate", "--protocol", "cd1", "--from", "q.h5", "--tilt-rate", "2", "--tilt-limit", "1"]):
            self.run_indet(*arguments, "-o", "kind.h5", "--overwrite")
            yield "kind.h5"
        self.run_indet("ensemble", "--protocols", "cd1", "--seeds", "1", "--disks", "4", "--samples", "5", "-o", "e")
        yield "e/members/cd1-0000.h5"
        yield "e/ensemble.h5"

    def test_is_seen(self):
        """Each enters a digest, and of every twentieth the program is asked."""
        digests = ("content_sha256", "text_sha256", "sha256", "complete")
        checked, asked = set(), set()
        for kind in self.files_of_every_kind():
            with h5py.File(self.folder / kind) as file:
                places = self.everything(file)
                numbers = self.numbers(file, [root for root in file if root != "provenance"])
                texts = self.texts(file)
                self.assertEqual(self.digest(numbers), file.attrs["content_sha256"])
                self.assertEqual(self.digest(texts), file.attrs["text_sha256"])
            for path, attribute in places:
                if attribute not in digests:
                    name = f"/{path}".replace("//", "/") + ("" if attribute is None else f"@{attribute}")
                    self.assertTrue(name in numbers or name in texts, f"{kind}: {name}")
            new = [place for place in places if place not in checked]
            checked.update(new)
            for path, attribute in new[::20]:
                asked.add((path, attribute))
                with self.subTest(kind=kind, path=path, attribute=attribute):
                    shutil.copy(self.folder / kind, self.folder / "bad.h5")
                    with h5py.File(self.folder / "bad.h5", "r+") as file:
                        self.change_any(file, path, attribute)
                    answer = program.run([program.INDET, "verify", "bad.h5"], self.folder)
                    self.assertIn(answer.returncode, [3, 5], answer.stdout + answer.stderr)
                    if answer.returncode == 3:
                        self.assertTrue(answer.stderr.startswith("indet: bad.h5: "), answer.stderr)
                    elif attribute not in digests:
                        self.assertRegex(answer.stdout, "some (number|text) is not the one that was written")
        self.assertGreater(len(checked), 300)
        self.assertGreater(len(asked), 15)


class OfRanges(Tampered):
    def setUp(self):
        super().setUp()
        self.make("analyze", "q.h5")
        self.assertGreater(len(self.places), 60)

    def test_a_forged_status(self):
        for status in ("unbounded", "point", "empty"):
            shutil.copy(self.folder / "good.h5", self.folder / "bad.h5")
            with h5py.File(self.folder / "bad.h5", "r+") as file:
                self.assertEqual(file["equilibrium"].attrs["status"], "bounded")
                file["equilibrium"].attrs.modify("status", status)
                self.forge(file)
            done = self.run_indet("verify", "bad.h5", status=5)
            self.assertIn(f"status {status}", done.stdout)
            self.assertNotIn("is not the one that was written", done.stdout)

    def test_results_with_a_forged_digest(self):
        self.assertEqual(self.unnoticed(*RESULTS), GUARDED_BY_THE_DIGEST_ALONE)
        self.places = [place for place in self.places if "CellData" not in place[0] or place[0].endswith("outcome")]
        self.assertEqual(self.unnoticed("VTKHDF"), set())
        # Of a sample of contacts, what tells about the others.
        self.make("analyze", "q.h5", "--contacts", "sample:3", "--seed", "4")
        sampled = {attribute for path, attribute in self.places if path == "ranges"}
        self.assertEqual(sampled, {"requested", "sample_seed", "confidence", "mean_delta_R", "band_delta_R",
                                   "mean_delta_T", "band_delta_T"})
        self.assertEqual(self.unnoticed("ranges") - GUARDED_BY_THE_DIGEST_ALONE, {"ranges@sample_seed"})

    def test_drawn_contacts_with_a_forged_digest(self):
        self.run_indet("simulate", "--protocol", "cd1", "--disks", "10", "--seed", "1", "-o", "s.h5")
        self.make("analyze", "s.h5", "--method", "barrier", "--contacts", "sample:8")
        self.assertIn(("ranges", "mean_delta_T"), self.places)
        self.places = [place for place in self.places if place[0] in {"ranges", "ranges/drawn", "ranges/draw_weight"}]
        self.assertEqual(self.unnoticed("ranges"), set())
        # The estimator of earlier versions, which did not name it.
        with h5py.File(self.folder / "good.h5", "r+") as file:
            ranges = file["ranges"]
            self.assertEqual(ranges.attrs["estimator"], "regression")
            del ranges.attrs["estimator"]
            self.forge(file)
        self.assertIn("mean_delta_R", self.run_indet("verify", "good.h5", status=5).stdout)
        with h5py.File(self.folder / "good.h5", "r+") as file:
            ranges = file["ranges"]
            k = np.repeat(np.arange(len(ranges["drawn"])), ranges["drawn"])
            for name in ("delta_R", "delta_T"):
                z = (ranges[name][()] / ranges["draw_weight"][()])[k] * np.mean(ranges["draw_weight"])
                reach = STUDENT * z.std(ddof=1) / np.sqrt(8)
                ranges.attrs.modify(f"mean_{name}", [z.mean(), z.mean() - reach, z.mean() + reach])
            self.forge(file)
        self.run_indet("verify", "good.h5")
        self.run_indet("inspect", "good.h5")

    def test_smallest_distances_with_a_forged_digest(self):
        self.make("analyze", "q.h5", "--smallest-distances")
        # Small changes of what is known to a tolerance; apps.distances has large ones.
        self.assertEqual(self.unnoticed("ranges") - GUARDED_BY_THE_DIGEST_ALONE,
                         places("ranges/", "d_R_min d_T_min"))

    def test_estimates_with_a_forged_digest(self):
        self.make("analyze", "q.h5", "--accuracy", "estimate", "--calibrate", "2", "--seed", "4")
        self.assertIn(("ranges/delta_R_high", None), self.places)
        self.assertEqual(self.unnoticed("ranges") - GUARDED_BY_THE_DIGEST_ALONE, set())


class OfLimits(Tampered):
    def test_results_with_a_forged_digest(self):
        self.make("limit", "q.h5", "--tilt", "--load", "disk=2,1,-0.5", "--friction", "--steps", "2")
        # All that is stored but three properties, which need exact arithmetic.
        self.places = [place for place in self.places if not place[0].startswith("limits/1/steps")]  # as of the others
        names = {re.sub(r"\d", "K", place) for place in self.unnoticed("limits")}
        self.assertEqual(names, places("limits/K", "/dim /one_mechanism @attained")
                         | places("limits/K/steps/", OF_STEPS))


class OfSamples(Tampered):
    def test_all_states(self):
        self.make("sample", "q.h5", "--method", "uniform", "--states", "1000000", "--covariance", "--shape")
        self.assertGreater(len(self.places), 60)
        self.assertLessEqual(self.unnoticed("sampling"), places("sampling", f"{OF_THE_WALK} {OF_THE_SHAPE}"))

    def test_no_states(self):
        self.make("sample", "q.h5", "--method", "uniform")
        self.assertLessEqual(self.unnoticed("sampling"),
                             places("sampling", f"{OF_THE_WALK} {OF_SAMPLES_THAT_ARE_NOT_STORED}"))

    def test_perturbed(self):
        self.make("sample", "q.h5", "--samples", "20")
        self.assertLessEqual(self.unnoticed("sampling"), places("sampling", OF_SOLUTIONS))

    def test_another_unit_of_force(self):
        """As of a sample that was drawn in one unit and written in another."""
        for options in (["--samples", "5"], ["--method", "uniform"], ["--method", "uniform", "--states", "9"]):
            self.make("sample", "q.h5", *options)
            with h5py.File(self.folder / "good.h5", "r+") as file:
                for name, data in file["sampling"].items():
                    if data.attrs["unit"] == "force":
                        data[...] = 30000 * data[()]
                self.forge(file)
            done = self.run_indet("verify", "good.h5", status=5)
            self.assertIn("/sampling: center: it violates equilibrium or contact conditions", done.stdout)

    def test_what_was_measured_is_told_and_what_was_not_is_not(self):
        self.make("sample", "q.h5", "--method", "uniform", "--states", "9")
        text = self.run_indet("verify", "good.h5").stdout
        self.assertRegex(text, r"good\.h5: \d+ checks, 0 contradictions\n/sampling: 10 states, imbalance up to \d")
        self.assertIn("samples 9 are stored", text)
        self.assertNotIn("gap", text)
        report = json.loads(self.run_indet("--json", "verify", "good.h5").stdout)
        self.assertEqual((report["states"], report["optima"], report["worst_optimality_gap"]), (10, 0, None))
        self.run_indet("verify", "q.h5")
        text = self.run_indet("verify", "q.h5").stdout
        self.assertEqual(text, "q.h5: 2 checks, 0 contradictions\nthere are no contact states in the file\n")

    def test_not_converged(self):
        self.run_indet("sample", "q.h5", "--method", "uniform", "--effective", "100000", "--limit", "1000", "-o", "s.h5",
                       status=5)
        done = self.run_indet("verify", "s.h5", status=5)
        self.assertIn("0 contradictions", done.stdout)
        self.assertIn("sample not converged", done.stdout)


class OfAnEnsemble(Tampered):
    def test_the_samplings_of_a_member(self):
        self.run_indet("ensemble", "--protocols", "cd1", "--seeds", "1", "--disks", "10", "--samples", "60", "-o", "e")
        shutil.copy(self.folder / "e/members/cd1-0000.h5", self.folder / "good.h5")
        self.run_indet("verify", "good.h5")
        self.remember()
        with h5py.File(self.folder / "good.h5") as file:
            # Noise as large as the distance of the centres leaves a shift of 0, and so does any larger noise.
            noise = "@center_noise" if file["bias"].attrs["center_shift"] == 0 else ""
        self.assertLessEqual(
            self.unnoticed(*SAMPLINGS),
            places("sampling", OF_SOLUTIONS) | places("bias", f"{OF_THE_COMPARISON} {noise}") |
            places("uniform", f"{OF_THE_WALK} {OF_SAMPLES_THAT_ARE_NOT_STORED}"))


class Unsolved(Tampered):
    def test_a_failed_objective_is_5_and_said(self):
        self.make("analyze", "q.h5")
        with h5py.File(self.folder / "good.h5", "r+") as file:
            ranges, equilibrium = file["ranges"], file["equilibrium"].attrs
            outcome = ranges["outcome"][()]
            outcome[0, 3] = 3
            for place in (ranges, file["VTKHDF/CellData"]):
                place["outcome"][...] = outcome
            for name in ("T_max", "delta_T", "d_T", "T_star"):
                ranges[name][0] = np.nan
            for name in ("lower", "upper", "primal_residual", "dual_residual", "sensitivity"):
                ranges[name][0, 3] = np.nan
            ranges["sensitivity_claim"][0, 3] = 0
            ranges["vertex"][0, 3] = -1
            equilibrium.modify("failed", np.int64(1))
            equilibrium.modify("certified", equilibrium["certified"] - 1)
            worst = {name: np.nanmax(ranges[name][()]) for name in ("primal_residual", "dual_residual")}
            for name, value in worst.items():
                equilibrium.modify(f"worst_{name}", value)
            self.forge(file)
        done = self.run_indet("verify", "good.h5", status=5)
        self.assertIn("0 contradictions", done.stdout)
        self.assertIn("force ranges: 1 of 20 objectives failed", done.stdout)
        report = json.loads(self.run_indet("--json", "verify", "good.h5", status=5).stdout)
        self.assertTrue(report["passed"])
        self.assertEqual(report["not_solved"], ["force ranges: 1 of 20 objectives failed"])

    def test_counts_of_a_packing_that_cannot_stand(self):
        self.run_indet("analyze", self.packing(program.incline(), name="i"), "-o", "good.h5", status=4)
        text = self.run_indet("verify", "good.h5").stdout
        self.assertIn("there are no contact states in the file", text)
        with h5py.File(self.folder / "good.h5", "r+") as file:
            file["equilibrium"].attrs.modify("objectives", np.int64(8))
            self.forge(file)
        self.assertIn("objectives: 8 is stored, 4 is right", self.run_indet("verify", "good.h5", status=5).stdout)


if __name__ == "__main__":
    program.main("FILE_FORMAT")
