#!/usr/bin/env python3
"""How time, pivots and memory of the range search grow with the number of disks.

    bench/scaling/scaling.py [--build build/release] [--limit 300] [--json FILE] [--csv FILE] [P.h5 ...]

Without files, packings of N = 25 ... 400 are made. Each method finds all ranges of each packing in a process of its own
(values and certificates, no canonical states), as long as it is expected to take less than --limit seconds; what is
expected follows from the sizes before. Where `lp` is expected to take longer, it finds the ranges of a sample of contacts
instead, which the table marks. Exponents are slopes of log(quantity) against log N for N >= 90, ± the standard error;
cross-overs are where the lines of two formulations meet.
"""
import argparse
import collections
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

METHODS = ["lp, nullspace", "lp, dual", "lp, edge", "lp, canonical states", "pivoting-tableau", "pivoting-paper"]
SAMPLE = 40
SMALLEST = 90  # disks that a packing needs to enter a fit


def make_packings(indet, folder):
    files = []
    for disks, seeds in [(25, 3), (50, 3), (95, 4), (200, 3), (400, 2)]:
        for seed in range(seeds):
            files.append(folder / f"cd1-{disks}-{seed}.h5")
            subprocess.run([indet, "simulate", "--protocol", "cd1", "--disks", str(disks), "--seed", str(seed),
                            "--quiet", "-o", files[-1]], stdout=subprocess.DEVNULL)
    return files


def run_measured(command):
    """The JSON document that a program prints, and the largest memory that it held, in MB. What it does not tell itself is
    what the system tells, which is not less than this script holds."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 5):
        raise RuntimeError(f"{command}: status {process.returncode}")
    document = json.loads(output)
    return document, document.get("memory", usage.ru_maxrss / 1024)


def disks_in(file):
    with h5py.File(file) as content:
        return len(content["particles/disks/id"])


def slope(points):
    """Exponent and its standard error of (N, quantity) in a power law, or None."""
    points = [(n, q) for n, q in points if n >= SMALLEST and q > 0]
    if len({n for n, _ in points}) < 2 or len(points) < 3:
        return None
    x, y = np.log(np.array(points).T)
    design = np.stack([x, np.ones_like(x)], axis=1)
    coefficients, residual, _, _ = np.linalg.lstsq(design, y, rcond=None)
    variance = (residual[0] if len(residual) else 0) / (len(x) - 2)
    return coefficients[0], math.sqrt(variance * np.linalg.inv(design.T @ design)[0, 0]), coefficients[1]


def expected_seconds(rows, method, disks):
    """From the two largest sizes that the method has done; nothing is expected before that."""
    known = collections.defaultdict(list)
    for row in rows:
        if row["method"] == method and not row["sampled"]:
            known[row["disks"]].append(row["seconds"])
    if not known:
        return 0
    sizes = sorted(known)[-2:]
    last = np.mean(known[sizes[-1]])
    if len(sizes) < 2 or sizes[-1] < SMALLEST:
        return last * (disks / sizes[-1]) ** 3
    power = math.log(last / np.mean(known[sizes[0]])) / math.log(sizes[-1] / sizes[0])
    return last * (disks / sizes[-1]) ** power


def measure(build, files, limit, keep):
    rows = []
    for file in sorted(files, key=disks_in):
        disks = disks_in(file)
        for method in METHODS:
            print(f"\r{disks} disks, {method:<30}", end="", file=sys.stderr, flush=True)
            row = {"file": pathlib.Path(file).name, "disks": disks, "method": method, "sampled": 0}
            if expected_seconds(rows, method, disks) <= limit:
                run, memory = run_measured([build / "bench/methods/bench_methods", method, file])
                row |= {key: run[key] for key in ("contacts", "dim", "seconds", "polytope_seconds", "pivots", "solves")}
            elif method == "lp, edge":
                with tempfile.TemporaryDirectory() as folder:
                    run, memory = run_measured([build / "indet", "--threads", "1", "analyze", file, "--accuracy", "fast",
                                                "--contacts", f"sample:{SAMPLE}", "--json", "--quiet", "-o",
                                                pathlib.Path(folder) / "r.h5"])
                row |= {"contacts": run["contacts"], "dim": run["dim"], "seconds": run["seconds"]["ranges"],
                        "polytope_seconds": run["seconds"]["polytope"], "pivots": run["pivots"],
                        "solves": run["solves"], "sampled": SAMPLE}
            else:
                continue
            rows.append(row | {"memory": memory})
            if keep:  # what is done stays if the rest is interrupted
                keep.write_text(json.dumps({"rows": rows}, indent=1) + "\n")
    print("\r" + " " * 60 + "\r", end="", file=sys.stderr)
    return rows


def print_tables(rows):
    sizes = sorted({row["disks"] for row in rows})
    for quantity, title, form in [("seconds", "CPU seconds", "{:.3f}"), ("pivots", "pivots", "{:.0f}"),
                                  ("memory", "memory (MB)", "{:.0f}")]:
        print(f"{title:<24}" + "".join(f"{f'N = {n}':>12}" for n in sizes) + f"{'exponent':>16}")
        for method in METHODS:
            cells, points = [], []
            for n in sizes:
                group = [r for r in rows if r["disks"] == n and r["method"] == method]
                points += [(n, r[quantity]) for r in group if not r["sampled"]]
                mark = "*" if group and group[0]["sampled"] else ""
                cells.append(form.format(np.mean([r[quantity] for r in group])) + mark if group else "-")
            fit = slope(points)
            cells.append(f"{fit[0]:.2f} ± {fit[1]:.2f}" if fit else "-")
            print(f"{method:<24}" + "".join(f"{cell:>12}" for cell in cells[:-1]) + f"{cells[-1]:>16}")
        print()
    if any(row["sampled"] for row in rows):
        print(f"* the ranges of {SAMPLE} contacts only")
    for n in sizes:
        group = [r for r in rows if r["disks"] == n]
        print(f"N = {n}: {len({r['file'] for r in group})} packings, {np.mean([r['contacts'] for r in group]):.0f} contacts, "
              f"dimension {np.mean([r['dim'] for r in group]):.0f}, polytope {np.mean([r['polytope_seconds'] for r in group]):.3f} s")


def cross_overs(rows):
    """Dimensions at which the fastest of two methods changes, by interpolation between neighbouring sizes."""
    found = []
    for a, b in [("lp, dual", "lp, edge"), ("lp, nullspace", "lp, edge"), ("pivoting-tableau", "lp, edge")]:
        points = []
        for n in sorted({row["disks"] for row in rows}):
            times = [[r["seconds"] for r in rows if r["disks"] == n and r["method"] == m and not r["sampled"]] for m in (a, b)]
            if all(times):
                dim = np.mean([r["dim"] for r in rows if r["disks"] == n])
                points.append((dim, math.log(np.mean(times[0]) / np.mean(times[1]))))
        for (d0, q0), (d1, q1) in zip(points, points[1:]):
            if q0 < 0 <= q1:
                found.append((a, b, math.exp(math.log(d0) + (math.log(d1) - math.log(d0)) * -q0 / (q1 - q0))))
        if points and all(q < 0 for _, q in points):
            found.append((a, b, math.inf))
        if points and all(q >= 0 for _, q in points):
            found.append((a, b, 0.0))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--limit", type=float, default=300)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        files = options.files or make_packings(options.build / "indet", pathlib.Path(folder))
        rows = measure(options.build, files, options.limit, options.json)
    found = cross_overs(rows)
    if options.json:
        options.json.write_text(json.dumps({"rows": rows, "cross_overs": [list(c) for c in found]}, indent=1) + "\n")
    if options.csv:
        with open(options.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, ["file", "disks", "contacts", "dim", "method", "sampled", "seconds",
                                           "polytope_seconds", "pivots", "solves", "memory"])
            writer.writeheader()
            writer.writerows(rows)
    print_tables(rows)
    for a, b, dim in found:
        where = "at every size measured" if dim == math.inf else "at no size measured" if dim == 0 else f"up to d = {dim:.0f}"
        print(f"{a} is faster than {b} {where}")


if __name__ == "__main__":
    main()
