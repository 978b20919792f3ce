#!/usr/bin/env python3
"""Where the time of one analysis goes, beside the least that its pivots could take.

    bench/methods/profile.py [--build build/release] [--repeat 20] P.h5

Shares of the whole program, its start included, come from perf (the libraries in which samples fall). The search is split
by what a solve costs that starts from its optimum, so makes no pivot: GLPK's set-up, and factorisation where it does not go on
from where GLPK stands. The least is pivots x the multiplications and additions that change a dense (2M - d) x d tableau, at the
rate at which this machine multiplies matrices.
"""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import tempfile

PARTS = {"glpk": "GLPK", "hdf5": "files", "libz": "files", "crypto": "files", "libsz": "files", "indet": "our own code",
         "spqr": "rank (SuiteSparse)", "cholmod": "rank (SuiteSparse)", "blas": "rank (SuiteSparse)",
         "lapack": "rank (SuiteSparse)", "colamd": "rank (SuiteSparse)"}


def shares(command, repeat, folder):
    """Fractions of the samples by part."""
    counts = collections.Counter()
    data = folder / "perf.data"
    for _ in range(repeat):
        subprocess.run(["perf", "record", "-q", "-F", "5000", "-o", data, "--", *command], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})  # its idle threads would be most of the samples
        report = subprocess.run(["perf", "report", "-i", data, "--stdio", "--no-children", "-F", "sample,dso"],
                                check=True, capture_output=True, text=True).stdout
        for line in report.splitlines():
            fields = line.split()
            if line.startswith("#") or len(fields) < 2:
                continue
            part = next((name for key, name in PARTS.items() if key in fields[1]), "system (loader, memory, kernel)")
            counts[part] += int(fields[0])
    total = sum(counts.values())
    return {part: count / total for part, count in counts.most_common()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packing", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--repeat", type=int, default=20)
    options = parser.parse_args()
    costs = json.loads(subprocess.run([options.build / "bench/methods/bench_profile", options.packing], check=True,
                                      capture_output=True, text=True).stdout)
    rows = 2 * costs["dim"] * (costs["inequalities"] - costs["dim"])
    for accuracy in ["fast", "standard"]:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            command = [options.build / "indet", "--threads", "1", "analyze", options.packing, "--accuracy", accuracy,
                       "--json", "--quiet", "-o", folder / "r.h5"]
            runs = [json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
                    for _ in range(5)]
            run = min(runs, key=lambda r: sum(r["seconds"].values()))
            parts = shares(command, options.repeat, folder)
        total = sum(run["seconds"].values())
        search = run["seconds"]["ranges"] + run["seconds"]["states"]
        continued = round(costs["going_on"][accuracy] * run["solves"])
        setup = run["solves"] * costs["going_on_seconds"]
        factors = (run["solves"] - continued) * (costs["start_seconds"] - costs["going_on_seconds"])
        vertices = run["solves"] * costs["vertex_seconds"]
        pivots = search - setup - factors - vertices
        print(f"--accuracy {accuracy}: {total:.4f} s ({', '.join(f'{k} {v:.4f}' for k, v in run['seconds'].items())})")
        for part, share in parts.items():
            print(f"  {part:<34}{100 * share:6.1f} % of the program's samples")
        print(f"  {run['solves']} solves: GLPK's set-up {setup:.4f} s ({1e6 * costs['going_on_seconds']:.0f} us each), "
              f"{run['solves'] - continued} first factorisations {factors:.4f} s "
              f"({1e6 * (costs['start_seconds'] - costs['going_on_seconds']):.0f} us each), vertices {vertices:.4f} s")
        print(f"  {run['pivots']} pivots, and proofs: {pivots:.4f} s ({1e6 * pivots / run['pivots']:.1f} us each)")
        least = run["pivots"] * rows / costs["product_flops_per_second"]
        print(f"  least: {run['pivots']} x {rows} flops at {costs['product_flops_per_second'] / 1e9:.1f} Gflop/s = "
              f"{least:.4f} s, {100 * least / total:.1f} % of the whole")
    print(f"a pivot of the tableau takes {1e6 * costs['tableau_pivot_seconds']:.1f} us, a vertex "
          f"{1e6 * costs['vertex_seconds']:.1f} us; reading the packing {1e3 * costs['read_seconds']:.1f} ms")


if __name__ == "__main__":
    main()
