#!/usr/bin/env python3
"""What accuracy costs: the time and the error of every setting that trades one for the other, on one plot.

    bench/tradeoff/tradeoff.py [--build build/release] [--seeds 2] [--packings 12] [--repetitions 2000] [--out DIR]

Knobs: the tolerance of the linear programs, with GLPK's own numbers (raw) and with those recomputed from its bases; the
formulation, the method and its pivot rule; --accuracy; --contacts sample:K; tolerance and sweeps of contact dynamics;
stiffness and time step of molecular dynamics; the number of perturb-and-resolve solutions. The reference of the levels of
accuracy are the values of --accuracy exact, in rational arithmetic. That of the linear programs are the recomputed and
certified vertices of the edge formulation, whose distance from exact arithmetic is a point of its own.

An error is relative: of the mean of dR (the ranges), of the mean of the canonical d_R (the states), of the mean of dR among
packings (the simulators, beside the finest setting of the knob, with the standard error of the difference), of r
(perturb-and-resolve). "worst" is the largest error of any single value, in mg. Seconds of ranges are those of the analysis, from
the packing in memory to its results: polytope, search, enclosures (which the linear programs' own points have not) and measures.
Seconds of simulators and of perturb-and-resolve are CPU time of the program. Samples of contacts and the methods are measured on a
packing of 400 disks too, by molecular dynamics. Writes tradeoff.json, tradeoff.csv and tradeoff.svg to DIR.
"""
import argparse
import collections
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import measured  # noqa: E402

FLOOR = 1e-15  # rounding: errors below are none, and are drawn here
LARGE = "mean delta, 400 disks"
RANGES = ["R_min", "R_max", "T_min", "T_max"]


class Bench:
    def __init__(self, build, folder):
        self.indet = build / "indet"
        self.methods = build / "bench/methods/bench_methods"
        self.folder = folder
        self.points = []

    def say(self, text):
        print(f"\r{text:<70}", end="", file=sys.stderr, flush=True)

    def run(self, *arguments):
        """The JSON document of a subcommand, and the CPU time of its process; status 5 (uncertain) counts as done."""
        cpu, _, document = measured.run(self.indet, *arguments, report=True)
        if arguments[0] == "analyze":
            document["analysis"] = sum(document["seconds"].values())
        return document | {"cpu": cpu}

    def method(self, name, file, tolerance=None):
        command = [self.methods, name, file] + ([str(tolerance)] if tolerance else [])
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode == 4:
            return None
        if done.returncode != 0:
            return {"error": done.stderr.strip()}
        return json.loads(done.stdout)

    def add(self, knob, setting, seconds, error, quantity, **more):
        """One point: lists over packings are averaged."""
        self.points.append({"knob": knob, "setting": str(setting), "seconds": float(np.mean(seconds)),
                            "error": float(np.mean(error)), "quantity": quantity} |
                           {name: float(np.mean(value)) for name, value in more.items()})


def spans(optima):
    """Range of each component, of maxima in the order -min, max, -min, max, ..."""
    values = np.asarray(optima, dtype=float)
    return values[0::2] + values[1::2]


def linear_programs(bench, packings):
    """Tolerances, raw and recomputed; formulations; methods and rules."""
    reference = {file: bench.method("lp, edge", file) for file in packings}

    def compare(knob, setting, name, tolerance=None, raw=False):
        bench.say(f"{knob} {setting}")
        seconds, errors, worst = [], [], []
        for file in packings:
            run = bench.method(name, file, tolerance)
            if run is None:
                return
            if "error" in run:
                print(f"\n{knob} {setting}: {run['error']}", file=sys.stderr)
                return
            right = np.asarray(reference[file]["optima"])
            found = np.asarray(run["raw" if raw else "optima"], dtype=float)
            mean = spans(right).mean()
            seconds.append(run["polytope_seconds"] + run["seconds"])
            errors.append(abs(spans(found).mean() - mean) / mean)
            worst.append(np.abs(found - right).max())
        bench.add(knob, setting, seconds, errors, "mean delta", worst=worst)

    for exponent in range(3, 10):
        tolerance = 10.0 ** -exponent
        compare("tolerance, natural order, raw", f"1e-{exponent}", "GLPK edge, natural order", tolerance, raw=True)
        compare("tolerance, natural order, recomputed", f"1e-{exponent}", "GLPK edge, natural order", tolerance)
        compare("tolerance, lp, recomputed", f"1e-{exponent}", "lp, edge", tolerance)
    for formulation in ["nullspace", "dual", "edge"]:
        compare("formulation", formulation, f"lp, {formulation}")
    for method in ["pivoting-paper", "pivoting-tableau", "pivoting-tableau, Dantzig",
                   "pivoting-tableau, best neighbour"]:
        compare("method", method, method)


def accuracy_levels(bench, packings):
    levels, values = {}, {}
    for level, repeats in [("exact", 1), ("standard", 3), ("fast", 3)]:
        for file in packings:
            for _ in range(repeats):
                bench.say(f"accuracy {level}")
                run = bench.run("analyze", file, "--accuracy", level, "-o", bench.folder / "r.h5")
                known = levels.setdefault((level, file), run)
                if run["analysis"] < known["analysis"]:
                    levels[level, file] = run
            with h5py.File(bench.folder / "r.h5") as content:
                force = content["parameters"].attrs["mg"]
                values[level, file] = np.array([content["ranges"][name][()] for name in RANGES]) / force
    for level in ["fast", "standard", "exact"]:
        for name, quantity in [("mean_delta_R", "mean delta"), ("mean_d_R", "mean d_R")]:
            pairs = [(levels[level, file], levels["exact", file]) for file in packings]
            worst = [np.abs(values[level, file] - values["exact", file]).max() for file in packings]
            bench.add(f"accuracy, {quantity}", level, [run["analysis"] for run, _ in pairs],
                      [abs(run[name] - right[name]) / right[name] for run, right in pairs], quantity, worst=worst)


def estimate(values, population):
    """Ends of the interval of the mean, and half-width of the band, as docs/theory.md has them."""
    from scipy.stats import skew, t
    count, deviation = len(values), values.std(ddof=1)
    left = 1 - count / population
    gamma = skew(values) * (values.std() / deviation) ** 3
    band = math.sqrt((1 - (count - 1) / population) * math.log(2 / 0.05) / (2 * count))
    quantile = t.ppf(0.975, count - 1) / math.sqrt(count)
    ends = []
    for target in (quantile, -quantile):  # W + g W^2/3 + g^2 W^3/27 + g/6K = target, whose left side grows with W
        roots = np.roots([gamma ** 2 / 27, gamma / 3, 1, gamma / (6 * count) - target])
        ends.append(values.mean() - deviation * math.sqrt(left) * roots[np.abs(roots.imag).argmin()].real)
    return *ends, band


def samples(bench, knob, packings, sizes, repetitions, quantity="mean delta", timed=10):
    """Errors and coverage of what a sample of contacts tells, of each packing. The program draws and analyses some samples, which gives the
    time and checks the formulas; ranges do not depend on what else is asked for, so the other samples are drawn from those of
    all contacts."""
    full = bench.folder / "full.h5"
    deltas = {}
    for file in packings:
        bench.run("analyze", file, "--accuracy", "fast", "-o", full)
        with h5py.File(full) as content:
            deltas[file] = content["ranges/delta_R"][()]
    random = np.random.default_rng(1)
    for size in sizes:
        found = [sample(bench, file, deltas[file], size, repetitions, timed, random) for file in packings]
        joined = {name: [of_packing[name] for of_packing in found] for name in found[0]}
        bench.add(knob, f"sample:{size}", joined.pop("seconds"), joined.pop("error"), quantity, **joined,
                  lowest_coverage=min(joined["coverage"]))


def sample(bench, file, delta, size, repetitions, timed, random):
    """Samples of one size from one packing."""
    ordered, mean = np.sort(delta), delta.mean()
    bench.say(f"samples of {size}")
    seconds, errors, covered, banded = [], [], 0, 0
    for seed in range(timed):
        run = bench.run("analyze", file, "--accuracy", "fast", "--contacts", f"sample:{size}", "--seed", seed, "-o",
                        bench.folder / "s.h5")
        with h5py.File(bench.folder / "s.h5") as content:
            drawn = content["ranges/delta_R"][()]
        told = run["sample"]["delta_R"]
        np.testing.assert_allclose([told["low"], told["high"], told["band"]],
                                   estimate(drawn[~np.isnan(drawn)], len(delta)), rtol=1e-6, atol=1e-6)
        seconds.append(run["analysis"])
    for _ in range(repetitions):
        drawn = np.sort(random.choice(delta, size, replace=False))
        low, high, band = estimate(drawn, len(delta))
        distance = np.abs(np.searchsorted(drawn, ordered, side="right") / size -
                          np.searchsorted(ordered, ordered, side="right") / len(delta)).max()
        errors.append(drawn.mean() / mean - 1)
        covered += low <= mean <= high
        banded += distance <= band
    return {"seconds": np.mean(seconds), "error": math.sqrt(np.mean(np.square(errors))),
            "coverage": covered / repetitions, "band_coverage": banded / repetitions}


def large_packing(bench, repetitions):
    """Methods and samples where an analysis takes seconds."""
    file = bench.folder / "large.h5"
    bench.say("400 disks")
    bench.run("simulate", "--protocol", "md1", "--preset", "stiff", "--disks", 400, "--seed", 0, "-o", file)
    means = {}
    for method in ["lp", "pivoting-tableau"]:
        run = bench.run("analyze", file, "--accuracy", "fast", "--method", method, "-o", bench.folder / "r.h5")
        means[method] = run["mean_delta_R"]
        bench.add("method, 400 disks", method, run["analysis"], abs(means[method] / means["lp"] - 1), LARGE)
    samples(bench, "contacts, 400 disks", [file], [6, 10, 20, 40, 80, 160, 320], repetitions, LARGE, timed=3)


def measures(bench, file):
    """What of a packing the settings of a simulator may change."""
    out = bench.folder / "m.h5"
    run = bench.run("analyze", file, "--accuracy", "fast", "-o", out)
    with h5py.File(out) as content:
        position = content["ranges/R_star"][()]
    return {"contacts": run["contacts"], "sliding": run["sliding"], "mean_delta_R": run["mean_delta_R"],
            "R_star": float(np.nanmean(position))}


def simulators(bench, seeds):
    """Settings of the simulators against the finest of each knob."""
    knobs = {
        "CD tolerance": ("cd1", "--tolerance", ["1e-4", "1e-5", "1e-6", "1e-7", "1e-8"], []),
        "CD sweeps": ("cd1", "--sweeps", ["100", "300", "1000", "3000"], []),
        "MD stiffness": ("md1", "--stiffness", ["1e4", "1e5", "1.2e6", "1e7"], ["--preset", "stiff"]),
        "MD time step": ("md1", "--dt", ["5e-5", "2.5e-5", "1.2e-5"], ["--preset", "stiff"]),
    }
    for knob, (protocol, option, settings, fixed) in knobs.items():
        found = collections.defaultdict(list)
        for setting in settings:
            for seed in seeds:
                bench.say(f"{knob} {setting}, seed {seed}")
                file = bench.folder / "p.h5"
                try:
                    run = bench.run("simulate", "--protocol", protocol, "--seed", seed, option, setting, *fixed, "-o", file)
                    found[setting].append({"seconds": run["cpu"], "residual": run["raw_residual"],
                                           "overlap": run["mean_overlap"]} | measures(bench, file))
                except RuntimeError as error:
                    print(f"\n{knob} {setting}: {error}", file=sys.stderr)
        finest = [entry["mean_delta_R"] for entry in found[settings[-1]]]
        for setting in settings:
            group = found[setting]
            if not group:
                continue
            means = {name: np.mean([entry[name] for entry in group]) for name in group[0]}
            errors = {f"{name}_error": standard_error([entry[name] for entry in group])
                      for name in ["contacts", "sliding", "R_star", "mean_delta_R"]}
            difference = 0 if setting == settings[-1] else math.hypot(errors["mean_delta_R_error"], standard_error(finest))
            bench.add(knob, setting, means.pop("seconds"), abs(means["mean_delta_R"] / np.mean(finest) - 1),
                      "mean delta of packings", **means, **errors, error_of_error=difference / np.mean(finest))


def standard_error(values):
    return np.std(values, ddof=1) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def perturbations(bench, file, seeds=4):
    """Error of r against the mean over the longest chains."""
    found = {}
    for count in [10, 25, 50, 100, 200, 400]:
        bench.say(f"{count} perturb-and-resolve solutions")
        runs = [bench.run("sample", file, "--samples", count, "--seed", seed) for seed in range(seeds)]
        found[count] = ([run["r"] for run in runs], [run["cpu"] for run in runs])
    r = np.mean(found[400][0])
    for count, (radii, seconds) in found.items():
        error = math.sqrt(np.mean(np.square(np.array(radii) / r - 1)))
        bench.add("solutions", count, seconds, error, "r", r=np.mean(radii))


def front(points):
    """Of the points of one quantity, those that no other beats in both time and error."""
    best = []
    for point in sorted(points, key=lambda p: (p["seconds"], p["error"])):
        if not best or max(point["error"], FLOOR) < max(best[-1]["error"], FLOOR):
            best.append(point)
    return best


def draw(points, path):
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    plt.rcParams["svg.hashsalt"] = "tradeoff"
    groups = [("ranges of a packing of 95 disks", {"mean delta", "mean d_R"}), ("ranges of a packing of 400 disks", {LARGE}),
              ("packings and their states", {"mean delta of packings", "r"})]
    figure, axes = plt.subplots(1, 3, figsize=(15, 5.2))
    markers = "osv^D<>PX*hp"
    for axis, (title, quantities) in zip(axes, groups):
        is_exact = title.startswith("ranges")  # the finest setting of a simulator is the reference, not without error
        members = [p for p in points if p["quantity"] in quantities and (is_exact or p["error"] > 0)]
        for number, knob in enumerate(dict.fromkeys(p["knob"] for p in members)):
            line = [p for p in members if p["knob"] == knob]
            errors = [max(p["error"], FLOOR) for p in line]
            # Down to a tenth at most, so that bars that reach below zero do not stretch a logarithmic axis.
            bars = [[min(p.get("error_of_error", 0), 0.9 * e) for p, e in zip(line, errors)],
                    [p.get("error_of_error", 0) for p in line]]
            axis.errorbar([p["seconds"] for p in line], errors, yerr=bars if any(map(any, bars)) else None,
                          fmt=markers[number % len(markers)], label=knob, markersize=5, elinewidth=0.7, linestyle="none")
        if is_exact:
            best = sorted((p for p in members if p["pareto"]), key=lambda p: p["seconds"])
            axis.step([p["seconds"] for p in best], [max(p["error"], FLOOR) for p in best], "k-", where="post", linewidth=0.8,
                      label="Pareto front")
        axis.set(xlabel="seconds", ylabel="relative error", title=title)
        if members:
            axis.set(xscale="log", yscale="log")
            axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def save(points, folder):
    best = [p for quantity in ("mean delta", LARGE) for p in front([p for p in points if p["quantity"] == quantity])]
    for point in points:
        point["pareto"] = any(point is other for other in best)
    (folder / "tradeoff.json").write_text(json.dumps(points, indent=1) + "\n")
    names = list(dict.fromkeys(name for point in points for name in point))
    with open(folder / "tradeoff.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, names)
        writer.writeheader()
        writer.writerows(points)
    draw(points, folder / "tradeoff.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--seeds", type=int, default=2, help="packings that times and errors are averaged over")
    parser.add_argument("--packings", type=int, default=12, help="packings of each setting of a simulator")
    parser.add_argument("--repetitions", type=int, default=2000, help="samples of contacts of each size")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(options.build.resolve(), pathlib.Path(name))
        packings = []
        for seed in range(options.seeds):
            packings.append(bench.folder / f"cd1-{seed}.h5")
            bench.run("simulate", "--protocol", "cd1", "--seed", seed, "-o", packings[-1])
        for section in [lambda: linear_programs(bench, packings), lambda: accuracy_levels(bench, packings),
                        lambda: samples(bench, "contacts", packings, [6, 10, 20, 40, 80, 120], options.repetitions),
                        lambda: large_packing(bench, options.repetitions),
                        lambda: simulators(bench, range(options.packings)), lambda: perturbations(bench, packings[0])]:
            section()
            save(bench.points, options.out)  # what is done stays if the rest is interrupted
        bench.say("")
    print(f"{'knob':<38}{'setting':<34}{'seconds':>9}{'error':>10}")
    for point in bench.points:
        more = ", ".join(f"{name} {value:.3g}" for name, value in point.items()
                         if name not in ("knob", "setting", "seconds", "error", "quantity", "pareto"))
        print(f"{point['knob']:<38}{point['setting']:<34}{point['seconds']:>9.3f}{point['error']:>10.1e}"
              f"{' *' if point['pareto'] else '  '} {more}")
    print(f"{len(bench.points)} points; * is on the Pareto front of the mean of delta, of 95 or of 400 disks")


if __name__ == "__main__":
    main()
