#!/usr/bin/env python3
"""All force ranges of packings by every method and its rivals: time, pivots, and whether they agree.

    bench/methods/methods.py [--build build/release] [--packings DIR] [--seeds 20] [--repeat 3] [--methods A;B]
                             [--json FILE] [--csv FILE] [P.h5 ...]

Without files, packings are made by contact dynamics (N = 95, one a seed). Each method runs in a process of its own, one
after the other, and all of them again for the next repetition. Times are CPU seconds, of a packing the smallest of its
repetitions; ratios are to `lp`, their mean over packings ± standard deviation. HiGHS (SciPy) solves a sample of the
objectives from scratch, scaled to all. What is not installed is left out with a message.
"""
import argparse
import collections
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

HIGHS = "HiGHS, from scratch"
SAMPLE = 40
AGREEMENT = 1e-8  # mg


def make_packings(indet, folder, seeds):
    files = []
    for seed in range(seeds):
        files.append(folder / f"cd1-{seed}.h5")
        # Status 5 tells of a run that reached its time limit while a disk still rolled; its forces balance all the same.
        subprocess.run([indet, "simulate", "--protocol", "cd1", "--seed", str(seed), "--quiet", "-o", files[-1]],
                       stdout=subprocess.DEVNULL)
    return files


def edge_problem(path):
    """The equilibrium of the paper in edge strengths: matrix, right-hand side, friction."""
    from scipy.sparse import csr_matrix
    with h5py.File(path) as file:
        a, b = file["contacts/body_a"][()], file["contacts/body_b"][()]
        normal, mu = file["contacts/normal"][()], file["contacts/mu"][()]
        mass = file["particles/disks/mass"][()]
        gravity = file["parameters"].attrs["gravity"]
    unit = np.linalg.norm(gravity) * mass.mean()
    matrix = np.zeros((3 * len(mass), 2 * len(a)))
    for contact in range(len(a)):
        for k, sign in enumerate((1, -1)):
            n, t = normal[contact], np.array([normal[contact][1], -normal[contact][0]])
            force = n + sign * mu[contact] * t
            for body, chi in ((a[contact], 1), (b[contact], -1)):
                if body >= 0:
                    matrix[3 * body:3 * body + 3, 2 * contact + k] = [*(chi * force), sign * mu[contact]]
    load = np.zeros(3 * len(mass))
    load[0::3], load[1::3] = mass * gravity[0] / unit, mass * gravity[1] / unit
    return csr_matrix(matrix), -load, mu


def highs(path):
    """CPU seconds of all objectives by HiGHS (dual simplex), extrapolated from a sample."""
    from scipy.optimize import linprog
    matrix, load, mu = edge_problem(path)
    chosen = np.random.default_rng(1).choice(4 * len(mu), SAMPLE, replace=False)
    start = time.process_time()
    for objective in chosen:
        contact, column = divmod(objective, 4)
        cost = np.zeros(2 * len(mu))
        cost[2 * contact:2 * contact + 2] = (1, 1) if column < 2 else (mu[contact], -mu[contact])
        result = linprog(cost * (1 if column % 2 == 0 else -1), A_eq=matrix, b_eq=load, method="highs-ds")
        if result.status != 0:
            raise RuntimeError(result.message)
    return {"seconds": (time.process_time() - start) * 4 * len(mu) / SAMPLE, "sampled": SAMPLE}


def run_method(program, method, file, tolerance=None):
    """The JSON document of one run, or None if the method was not built."""
    command = [program, method, file] + ([str(tolerance)] if tolerance is not None else [])
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode == 4:
        return None
    if done.returncode != 0:
        raise RuntimeError(f"{method}, {file}: {done.stderr}")
    return json.loads(done.stdout)


def measure(program, methods, file, repeat):
    """For one packing: what each method needed, alternating."""
    runs = collections.defaultdict(list)
    for _ in range(repeat):
        for method in methods:
            run = highs(file) if method == HIGHS else run_method(program, method, file)
            if run is not None:
                runs[method].append(run)
    reference = np.array(runs["lp"][0]["optima"])
    result = {key: runs["lp"][0][key] for key in ("disks", "contacts", "dim")} | {"file": pathlib.Path(file).name}
    result["polytope_seconds"] = min(run["polytope_seconds"] for run in runs["lp"])
    result["methods"] = {}
    for method, all_runs in runs.items():
        entry = {"seconds": min(run["seconds"] for run in all_runs), "all_seconds": [r["seconds"] for r in all_runs]}
        if "optima" in all_runs[0]:
            optima = np.array(all_runs[0]["optima"], dtype=float)
            entry |= {key: all_runs[0][key] for key in ("solves", "pivots", "failures")}
            entry["missing"] = int(np.isnan(optima).sum())
            entry["largest_difference"] = float(np.nanmax(np.abs(optima - reference), initial=0))
        result["methods"][method] = entry
    return result


def print_table(results, methods):
    sizes = sorted({r["disks"] for r in results})
    counts = collections.Counter(r["disks"] for r in results)
    titles = [f"N = {n} ({counts[n]} packings)" for n in sizes]
    print(f"{'CPU seconds (ratio to lp), pivots':<40}" + "".join(f"{title:<36}" for title in titles))
    for method in methods:
        cells = []
        for n in sizes:
            group = [r["methods"] for r in results if r["disks"] == n and method in r["methods"]]
            if not group:
                cells.append("")
                continue
            ratios = [m[method]["seconds"] / m["lp"]["seconds"] for m in group]
            spread = f" ± {np.std(ratios, ddof=1):.2f}" if len(ratios) > 1 else ""
            pivots = f", {np.mean([m[method]['pivots'] for m in group]):.0f}" if "pivots" in group[0][method] else ""
            cells.append(f"{np.mean([m[method]['seconds'] for m in group]):8.3f} ({np.mean(ratios):.2f}{spread}){pivots}")
        print(f"{method:<40}" + "".join(f"{cell:<36}" for cell in cells))


def print_agreement(results):
    wrong = 0
    for result in results:
        for method, entry in result["methods"].items():
            if entry.get("largest_difference", 0) > AGREEMENT or entry.get("missing", 0) or entry.get("failures", 0):
                wrong += 1
                print(f"{result['file']}: {method}: differs by {entry['largest_difference']:.1e} mg, {entry['missing']} not "
                      f"found, {entry['failures']} reported as failed")
    largest = max(e.get("largest_difference", 0) for r in results for e in r["methods"].values())
    print(f"{len(results)} packings, {wrong} runs that fail or disagree; largest difference {largest:.1e} mg")


def write_csv(path, results):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["file", "disks", "contacts", "dim", "method", "seconds", "ratio", "pivots", "difference"])
        for r in results:
            for method, entry in r["methods"].items():
                writer.writerow([r["file"], r["disks"], r["contacts"], r["dim"], method, entry["seconds"],
                                 entry["seconds"] / r["methods"]["lp"]["seconds"], entry.get("pivots", ""),
                                 entry.get("largest_difference", "")])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--methods", help="names as bench_methods --list gives them, separated by ;")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path)
    options = parser.parse_args()
    program = options.build / "bench/methods/bench_methods"
    methods = subprocess.run([program, "--list"], check=True, capture_output=True, text=True).stdout.splitlines()
    methods.append(HIGHS)
    if options.methods:
        methods = ["lp"] + [m for m in methods if m in options.methods.split(";") and m != "lp"]
    try:
        import scipy  # noqa: F401
    except ImportError:
        print("SciPy is not installed: HiGHS is left out", file=sys.stderr)
        methods = [m for m in methods if m != HIGHS]
    results = []
    with tempfile.TemporaryDirectory() as folder:
        files = options.files or make_packings(options.build / "indet", pathlib.Path(folder), options.seeds)
        for number, file in enumerate(files):
            print(f"\r{number}/{len(files)} {file.name}", end="", file=sys.stderr, flush=True)
            results.append(measure(program, methods, file, options.repeat))
            if options.json:  # what is done stays if the rest is interrupted
                options.json.write_text(json.dumps(results, indent=1) + "\n")
    print("\r" + " " * 40 + "\r", end="", file=sys.stderr)
    for method in set(methods) - set(results[0]["methods"]):
        print(f"built without {method}: it is left out", file=sys.stderr)
    if options.csv:
        write_csv(options.csv, results)
    print_table(results, methods)
    print_agreement(results)


if __name__ == "__main__":
    main()
