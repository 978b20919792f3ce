#!/usr/bin/python3
"""Uniform sampling of the packings of the four protocols, beside perturb-and-resolve (docs/sampling.md).

usage: bench/sampling/uniform.py [path of indet] [number of seeds] [protocols, as in cd1,md2] [threads]

Prints, for each packing, whether the sampling converged and how fast, and whether all states that it wrote lie inside
of the ranges that indet analyze finds; then r under both samplings, and where the simulated state lies.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

PAPER = {"cd1": "33 ± 1.4", "cd2": "34 ± 1.3", "md1": "41 ± 1.7", "md2": "40 ± 1.5"}
STATES = 10**6  # all of them


def run(indet, threads, *arguments):
    done = subprocess.run([indet, "--json", "--quiet", "--threads", threads, *map(str, arguments)], capture_output=True,
                          text=True)
    if done.returncode not in (0, 5):
        raise RuntimeError(f"{arguments}: {done.stderr}")
    return json.loads(done.stdout) | {"exit": done.returncode}


def outside(samples, ranges):
    """By how much (mg) a sampled force exceeds the range that linear programs found; negative: inside."""
    with h5py.File(samples) as s, h5py.File(ranges) as r:
        states = s["sampling/states"][()]
        worst = -np.inf
        for column, name in enumerate("RT"):
            force = states[:, column::2]
            low, high = r[f"ranges/{name}_min"][()], r[f"ranges/{name}_max"][()]
            worst = max(worst, np.max(low - force), np.max(force - high))
        return worst / r["equilibrium"].attrs["force_unit"], len(states)


def mean(values, digits=3):
    values = [v for v in values if v is not None]
    error = np.std(values, ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.nan
    return f"{np.mean(values):.{digits}g} ± {error:.2g}"


def main():
    indet = sys.argv[1] if len(sys.argv) > 1 else "build/release/indet"
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    protocols = sys.argv[3].split(",") if len(sys.argv) > 3 else list(PAPER)
    threads = sys.argv[4] if len(sys.argv) > 4 else "1"
    uniform = {p: [] for p in protocols}
    perturb = {p: [] for p in protocols}
    print("| packing | dim F | converged | R-hat | fewest effective | core seconds "
          "| effective a core second | core seconds for 400 "
          "| outside of the ranges (mg) |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for seed in range(seeds):
            first = folder / f"cd1-{seed}.h5"
            run(indet, threads, "simulate", "--protocol", "cd1", "--seed", seed, "-o", first)
            for protocol in protocols:
                packing = folder / f"{protocol}-{seed}.h5"
                start = ["--from", first] if protocol[-1] == "2" else []
                if protocol != "cd1":
                    run(indet, threads, "simulate", "--protocol", protocol, "--seed", seed, *start, "-o", packing)
                ranges = packing.with_suffix(".ranges.h5")
                run(indet, threads, "analyze", packing, "-o", ranges)
                samples = packing.with_suffix(".uniform.h5")
                u = run(indet, threads, "sample", ranges, "--method", "uniform", "--shape", "--seed", seed, "--states",
                        STATES, "-o", samples)
                perturb[protocol].append(run(indet, threads, "sample", packing, "--seed", seed))
                uniform[protocol].append(u)
                worst, states = outside(samples, ranges)
                print(f"| {protocol}, seed {seed} | {u['dim']:.0f} | {'yes' if u['converged'] else 'NO'} "
                      f"| {u['rhat']:.4f} | {u['ess']:.0f} | {u['core_seconds']:.2f} "
                      f"| {u['ess'] / u['core_seconds']:.0f} | {400 * u['core_seconds'] / u['ess']:.2f} | {worst:.1e} ({states} states) |", flush=True)
    print(f"\nN = 95, seeds 0 … {seeds - 1}, means over packings with standard errors; mg\n")
    print("| | r, uniform | r, perturb-and-resolve | paper | ratio | distance of the simulated state from the uniform "
          "centre |")
    print("|---|---|---|---|---|---|")
    for p in protocols:
        ratio = [v["r"] / u["r"] for u, v in zip(uniform[p], perturb[p])]
        print(f"| {p} | {mean([u['r'] for u in uniform[p]])} | {mean([v['r'] for v in perturb[p]])} | {PAPER[p]} "
              f"| {mean(ratio)} | {mean([u['start_distance'] for u in uniform[p]])} |")
    print("\n| percentile of the simulated state: | distance from the centre | norm | sum of R | mean T/(μR) | mean R* "
          "| contacts in the central 90 % | M_s | largest M_s of a sample |")
    print("|---|---|---|---|---|---|---|---|---|")
    for p in protocols:
        column = lambda key: [u[key] for u in uniform[p]]
        print(f"| {p} | {mean(column('start_distance_percentile'))} | {mean(column('start_norm_percentile'))} "
              f"| {mean(column('start_normal_force_percentile'))} | {mean(column('start_mobilisation_percentile'))} "
              f"| {mean(column('start_R_star_percentile'))} | {mean(column('start_central_fraction_R'))} "
              f"| {mean(column('start_sliding'))} | {max(column('most_sliding')):.0f} |")
    print("\n| | inscribed radius | diameter, from below | from above | mean width | log volume | its error | per dimension |")
    print("|---|---|---|---|---|---|---|---|")
    for p in protocols:
        column = lambda key: [u[key] for u in uniform[p]]
        print(f"| {p} | {mean(column('inscribed_radius'))} | {mean(column('diameter_lower'))} "
              f"| {mean(column('diameter_upper'))} | {mean(column('mean_width'))} | {mean(column('log_volume'))} "
              f"| {np.mean(column('log_volume_error')):.2g} "
              f"| {mean([u['log_volume'] / u['dim'] for u in uniform[p]])} |")


main()
