#!/usr/bin/env python3
"""What accuracy costs from a hundred disks to ten thousand: time, memory and error of all that trades one for the other.

    bench/large/trade.py [--build build/release] [--folder DIR] [--disks 95 400 1600] [--packings P.h5 ...]
                         [--repeats 3] [--limit 400] [--out DIR]

Packings are made in DIR by `simulate --protocol md1`, or taken as they are (--packings). The settings are

    all contacts     --method lp (without extremal states), pivoting-tableau, barrier with --gap 1e-2 ... 1e-8
    some contacts    --method lp or barrier with --contacts sample:K
    estimates        --accuracy estimate, calibrated on 20 contacts and on none

A setting is left out where it is expected to take longer than --limit seconds, by what smaller packings took. Error: that of the
mean of delta_R, relative to the values of all contacts with the narrowest intervals, root mean square over --repeats seeds where
chance has a part; of the reference itself half of its gap; where not all contacts were found, half of the confidence interval over 1.96 (marked). Writes trade.tsv,
and trade.svg with the Pareto front of each packing.
"""
import argparse
import collections
import math
import pathlib
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import measured  # noqa: E402

COLUMNS = ["packing", "disks", "contacts", "knob", "setting", "seconds", "memory_MB", "error", "by_interval", "certified", "values"]

SETTINGS = [("all, lp", "", ["--method", "lp", "--extremal-states", "none"]),
            ("all, pivoting-tableau", "", ["--method", "pivoting-tableau", "--extremal-states", "none"])]
SETTINGS += [("all, barrier", gap, ["--method", "barrier", "--gap", gap]) for gap in ("1e-2", "1e-4", "1e-6", "1e-8")]
SETTINGS += [("sample, lp", str(size), ["--method", "lp", "--extremal-states", "none", "--contacts", f"sample:{size}"])
             for size in (20, 80)]
SETTINGS += [("drawn by widths, barrier", str(size), ["--method", "barrier", "--gap", "1e-2", "--contacts", f"sample:{size}"])
             for size in (6, 20, 80, 320)]
SETTINGS += [("estimate, calibrated", size, ["--accuracy", "estimate", "--calibrate", size]) for size in ("20", "0")]


class Bench:
    def __init__(self, options):
        self.indet = options.build.resolve() / "indet"
        self.folder, self.repeats, self.limit = options.folder, options.repeats, options.limit
        self.rows = []

    def packing(self, disks):
        path = self.folder / f"md1-{disks}-1.h5"
        if not path.exists():
            measured.run(self.indet, "simulate", "--protocol", "md1", "--disks", disks, "--seed", 1, "-o", path)
        return path

    def expected(self, knob, setting, disks):
        """By a power law through the two largest packings before; the cube of the size where there is one."""
        known = sorted({row["disks"]: row["seconds"] for row in self.rows
                        if (row["knob"], row["setting"]) == (knob, setting)}.items())
        if not known:
            return 0
        power = 3
        if len(known) > 1:
            (n, t), (m, u) = known[-2:]
            power = math.log(u / t) / math.log(m / n)
        return known[-1][1] * (disks / known[-1][0]) ** power

    def measure(self, path):
        with h5py.File(path) as file:
            disks, contacts = len(file["particles/disks/id"]), len(file["contacts/body_a"])
        found = []
        for knob, setting, arguments in SETTINGS:
            is_random = "sample" in " ".join(arguments) or "calibrated" in knob
            repeats = self.repeats if is_random else 1
            if repeats * self.expected(knob, setting, disks) > self.limit or setting.isdigit() and int(setting) >= contacts:
                continue
            print(f"\r{path.stem}: {knob} {setting:<20}", end="", file=sys.stderr, flush=True)
            out = self.folder / "trade.ranges.h5"
            runs = []
            for seed in range(1, repeats + 1):
                seeded = ["--seed", seed] if is_random and setting != "0" else []
                *used, report = measured.run(self.indet, "analyze", path, *arguments, *seeded, "--overwrite", "-o", out,
                                             report=True)
                runs.append((report | {"mean": self.mean(knob, report, out)}, *used))
            found.append((knob, setting, runs))
        exact = [runs[0][0]["mean_delta_R"] for knob, _, runs in found if knob.startswith("all")]
        for knob, setting, runs in found:
            error, by_interval = self.error(runs, exact[-1] if exact else None)
            if error == 0:
                error = float(setting) / 2  # the reference: at most half of its gap
            self.rows.append({"packing": path.stem, "disks": disks, "contacts": contacts, "knob": knob, "setting": setting,
                              "seconds": np.mean([r[1] for r in runs]), "memory_MB": max(r[2] for r in runs), "error": error,
                              "by_interval": int(by_interval), "certified": runs[0][0]["certified"],
                              "values": runs[0][0]["objectives"]})
        print("\r" + " " * 70 + "\r", end="", file=sys.stderr)

    @staticmethod
    def mean(knob, report, path):
        """What is told of the mean of delta_R over all contacts."""
        if knob.startswith("all"):
            return report["mean_delta_R"]
        if not knob.startswith("estimate"):
            return report["sample"]["delta_R"]["mean"]
        with h5py.File(path) as file:
            known, predicted = file["ranges/delta_R"][()], file["ranges/delta_R_estimate"][()]
        return float(np.nanmean(np.where(np.isnan(known), predicted, known)))

    @staticmethod
    def error(runs, exact):
        """Of the mean, relative; whether it is half of a confidence interval over 1.96."""
        reports = [report for report, _, _ in runs]
        means = np.array([report["mean"] for report in reports])
        if exact is not None:
            return math.sqrt(np.mean(np.square(means / exact - 1))), False
        if "sample" not in reports[0]:
            return math.nan, True
        told = [report["sample"]["delta_R"] for report in reports]
        return float(np.mean([(t["high"] - t["low"]) / 2 / 1.96 / t["mean"] for t in told])), True


def front(rows):
    """Those that no other beats in both time and error."""
    best = []
    for row in sorted(rows, key=lambda r: (r["seconds"], r["error"])):
        if not math.isnan(row["error"]) and (not best or row["error"] < best[-1]["error"]):
            best.append(row)
    return best


def draw(rows, path):
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    plt.rcParams["svg.hashsalt"] = "trade"
    by_packing = collections.defaultdict(list)
    for row in rows:
        by_packing[row["packing"]].append(row)
    figure, axes = plt.subplots(1, len(by_packing), figsize=(3.6 * len(by_packing), 4.2), squeeze=False, sharey=True)
    knobs = list(dict.fromkeys(row["knob"] for row in rows))
    for axis, members in zip(axes[0], by_packing.values()):
        for number, knob in enumerate(knobs):
            line = [row for row in members if row["knob"] == knob and not math.isnan(row["error"])]
            axis.plot([r["seconds"] for r in line], [r["error"] for r in line], "osv^D<>P"[number], markersize=5,
                      label=knob, color=f"C{number}")
            for r in line:
                axis.annotate(r["setting"], (r["seconds"], r["error"]), fontsize=6, xytext=(3, 3),
                              textcoords="offset points")
        best = front(members)
        axis.step([r["seconds"] for r in best], [r["error"] for r in best], "k-", where="post", linewidth=0.8)
        axis.set(xscale="log", yscale="log", xlabel="seconds of processor time", title=f"{members[0]['disks']} disks, {members[0]['contacts']} contacts")
    axes[0][0].set_ylabel("relative error of the mean of δR")
    axes[0][-1].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("trade"))
    parser.add_argument("--disks", type=int, nargs="*", default=[95, 400, 1600])
    parser.add_argument("--packings", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--limit", type=float, default=400)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    options = parser.parse_args()
    for folder in (options.folder, options.out):
        folder.mkdir(parents=True, exist_ok=True)
    bench = Bench(options)
    for path in [bench.packing(disks) for disks in options.disks] + options.packings:
        bench.measure(path)
        with open(options.out / "trade.tsv", "w") as file:  # what is done stays if the rest is interrupted
            print(*COLUMNS, sep="\t", file=file)
            for row in bench.rows:
                print(*[f"{v:.4g}" if isinstance(v, float) else v for v in row.values()], sep="\t", file=file)
        draw(bench.rows, options.out / "trade.svg")
    for row in bench.rows:
        print(*[f"{v:.4g}" if isinstance(v, float) else v for v in row.values()], sep="\t")


if __name__ == "__main__":
    main()
