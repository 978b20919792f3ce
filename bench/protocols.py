#!/usr/bin/python3
"""Packings of all protocols and seeds, as a table (docs/simulation.md).

usage: bench/protocols.py [path of indet] [number of seeds] [number of disks]
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

RUNS = (  # name, protocol, more arguments
    ("cd1", "cd1", []),
    ("cd2", "cd2", []),
    ("md1 paper", "md1", ["--preset", "paper"]),
    ("md2 paper", "md2", ["--preset", "paper"]),
    ("md1 paper-overlap", "md1", ["--preset", "paper-overlap"]),
    ("md2 paper-overlap", "md2", ["--preset", "paper-overlap"]),
    ("md1 stiff", "md1", ["--preset", "stiff"]),
    ("md2 stiff", "md2", ["--preset", "stiff"]),
)


def forces(path):
    """Forces by contact, in mg."""
    with h5py.File(path) as file:
        unit = file["parameters"].attrs["mg"]
        c = file["contacts"]
        return {(a, b): np.array([R, T]) / unit for a, b, R, T in zip(c["body_a"], c["body_b"], c["R"], c["T"])}


def distance(p, q):
    zero = np.zeros(2)
    return np.sqrt(sum(np.sum((p.get(k, zero) - q.get(k, zero)) ** 2) for k in p.keys() | q.keys()))


def mean(values):
    return f"{np.mean(values):.4g} ± {np.std(values, ddof=1) / np.sqrt(len(values)):.2g}"


def main():
    indet = sys.argv[1] if len(sys.argv) > 1 else "build/release/indet"
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    disks = sys.argv[3] if len(sys.argv) > 3 else "95"
    results = {name: [] for name, _, _ in RUNS}
    apart = {"cd1–cd2": [], "cd1–md2 paper": [], "md2 paper–cd2": []}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for seed in range(seeds):
            for run, protocol, more in RUNS:
                start = ["--from", str(folder / f"cd1-{seed}.h5")] if protocol[-1] == "2" else ["--disks", disks]
                output = folder / f"{run.replace(' ', '-')}-{seed}.h5"
                begin = time.perf_counter()
                done = subprocess.run([indet, "--json", "simulate", "--protocol", protocol, "--seed", str(seed), *start,
                                       *more, "-o", str(output)], capture_output=True, text=True)
                result = json.loads(done.stdout)
                result["wall"] = time.perf_counter() - begin
                results[run].append(result)
                if result["ending"] != "static":
                    print(f"{run}, seed {seed}: {result['reason']}", file=sys.stderr)
            state = {run: forces(folder / f"{run.replace(' ', '-')}-{seed}.h5") for run, _, _ in RUNS}
            for pair in apart:
                p, q = pair.split("–")
                apart[pair].append(distance(state[p], state[q]))
    print(f"N = {disks}, seeds 0 … {seeds - 1}\n")
    print("| | static | mean R (mg) | M | sliding, raw | polished | overlap, mean (largest) (r_max) | raw residual (mg) | polished (mg) | s a run |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for run, _, _ in RUNS:
        r = results[run]
        column = lambda key: [x[key] for x in r]
        span = lambda key: f"{np.mean(column(key)):.1f} ({min(column(key)):.0f} … {max(column(key)):.0f})"
        print(f"| {run} | {sum(x['ending'] == 'static' for x in r)}/{len(r)} | {mean(column('mean_R'))} "
              f"| {mean(column('contacts'))} ({min(column('contacts'))} … {max(column('contacts'))}) "
              f"| {span('raw_sliding')} | {span('sliding')} "
              f"| {np.mean(column('mean_overlap')):.1e} ({max(column('largest_overlap')):.0e}) | {max(column('raw_residual')):.0e} "
              f"| {max(column('residual')):.0e} | {np.mean(column('wall')):.2f} |")
    print()
    for pair, values in apart.items():
        print(f"distance {pair}: {mean(values)} mg")


if __name__ == "__main__":
    main()
