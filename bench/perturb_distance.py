#!/usr/bin/python3
"""Perturb-and-resolve: what it costs r, and saves in time, to stop the sweeps once balanced forces are near.

Every packing PROTOCOL-SEED.h5 of a folder (the members of an ensemble) is sampled with several --distance, and with
sweeps that go on until they change no force by more than 1e-7 mg; the seed of the sampling is that of the packing.
Differences of r are taken packing by packing. Times are processor time.

usage: bench/perturb_distance.py [path of indet] [folder] [number of seeds]
"""
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

REFERENCE = ("--distance", "0", "--tolerance", "1e-7", "--sweeps", "200000")
DISTANCES = ("0.01", "0.1", "0.3", "1")


def sample(indet, packing, seed, arguments):
    """Exit status 5 says that not every solution was accepted, which is usual."""
    command = [indet, "--json", "--quiet", "--threads", "1", "sample", str(packing), "--samples", "500", "--seed", str(seed)]
    before = os.times()
    done = subprocess.run([*command, *arguments], capture_output=True, text=True)
    after = os.times()
    if done.returncode not in (0, 5):
        sys.exit(done.stderr)
    cpu = after.children_user - before.children_user + after.children_system - before.children_system
    result = json.loads(done.stdout)
    return result["r"], result["accepted"], cpu, result["r_error"]


def main():
    indet = sys.argv[1] if len(sys.argv) > 1 else "build/release/indet"
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "out/ensemble/members")
    seeds = int(sys.argv[3]) if len(sys.argv) > 3 else 8
    packings = [(folder / f"{protocol}-{seed:04}.h5", seed) for seed in range(seeds) for protocol in ("cd1", "cd2", "md1", "md2")]
    settings = {"reference": REFERENCE} | {distance: ("--distance", distance) for distance in DISTANCES}
    found = {name: [] for name in settings}
    for packing, seed in packings:
        for name, arguments in settings.items():
            found[name].append(sample(indet, packing, seed, arguments))
        print(packing.stem, *(f"{found[name][-1][0]:.3f} mg {found[name][-1][2]:.2f} s" for name in settings),
              file=sys.stderr, sep="  ")
    r, accepted, seconds, error = np.moveaxis(np.array([found[name] for name in settings]), 2, 0)
    print(f"{len(packings)} packings; reference: r = {r[0].mean():.2f} mg, its standard error in one packing "
          f"{error[0].mean():.2f} mg; {seconds[0].mean():.2f} s a packing\n")
    print("| `--distance` | change of r, mean (mg) | median | s.d. over packings | time | accepted |")
    print("|---|---|---|---|---|---|")
    for row, name in enumerate(settings):
        change = r[row] - r[0]
        texts = [name, f"{change.mean():+.3f} ± {change.std(ddof=1) / np.sqrt(len(change)):.3f}",
                 f"{np.median(change):+.3f}", f"{change.std(ddof=1):.3f}",
                 f"{seconds[row].sum() / seconds[0].sum():.2f}", f"{100 * accepted[row].sum() / (500 * len(packings)):.1f} %"]
        print("| " + " | ".join(texts) + " |")


main()
