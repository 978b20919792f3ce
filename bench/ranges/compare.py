#!/usr/bin/env python3
"""All force ranges of packings: indet against natural-order GLPK and Clp, and HiGHS from scratch, in one run.

    bench/ranges/compare.py [--build build/release] [--seeds 4] [--repeat 3] [--json FILE]

Packings: contact dynamics, N = 95, one a seed, and the LAMMPS packing of N = 220. Times are CPU time, methods alternate; HiGHS solves a
sample of the objectives, scaled to all. Peers that are not installed are left out with a message.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

SAMPLE = 40


def make_packings(indet, folder, seeds):
    files = []
    for seed in range(seeds):
        files.append(folder / f"cd1-{seed}.h5")
        # Status 5 tells of a run that reached its time limit while a disk still rolled; its forces balance all the same.
        subprocess.run([indet, "simulate", "--protocol", "cd1", "--seed", str(seed), "--quiet", "-o", files[-1]],
                       stdout=subprocess.DEVNULL)
    data = pathlib.Path(__file__).resolve().parents[2] / "tests" / "data" / "lammps"
    files.append(folder / "lammps.h5")
    subprocess.run([indet, "import", "--format", "lammps", "--atoms", data / "atoms.dump", "--contacts",
                    data / "contacts.dump", "--friction", "0.3", "--quiet", "-o", files[-1]],
                   check=True, stdout=subprocess.DEVNULL)
    return files


def highs_seconds(path):
    """CPU seconds of all objectives by HiGHS (dual simplex) on the edge form, extrapolated from a sample."""
    from scipy.optimize import linprog
    from scipy.sparse import csr_matrix
    with h5py.File(path) as file:
        a, b = file["contacts/body_a"][()], file["contacts/body_b"][()]
        normal, mu = file["contacts/normal"][()], file["contacts/mu"][()]
        mass, radius = file["particles/disks/mass"][()], file["particles/disks/radius"][()]
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
    matrix = csr_matrix(matrix)
    chosen = np.random.default_rng(1).choice(4 * len(a), SAMPLE, replace=False)
    start = time.process_time()
    for objective in chosen:
        contact, column = divmod(objective, 4)
        cost = np.zeros(2 * len(a))
        cost[2 * contact:2 * contact + 2] = (1, 1) if column < 2 else (mu[contact], -mu[contact])
        result = linprog(cost * (1 if column % 2 == 0 else -1), A_eq=matrix, b_eq=-load, method="highs-ds")
        if result.status != 0:
            raise RuntimeError(result.message)
    return (time.process_time() - start) * 4 * len(a) / SAMPLE


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        files = make_packings(options.build / "indet", pathlib.Path(name), options.seeds)
        done = subprocess.run([options.build / "bench/ranges/bench_ranges", "--repeat", str(options.repeat), *files],
                              check=True, capture_output=True, text=True)
        results = json.loads(done.stdout)
        for result, file in zip(results, files):
            result["file"] = file.name
            try:
                result["methods"]["HiGHS, cold"] = {"seconds": highs_seconds(file), "sampled": SAMPLE}
            except ImportError:
                print("SciPy is not installed: HiGHS is left out", file=sys.stderr)
    if "natural order Clp" not in results[0]["methods"]:
        print("built without Clp: it is left out", file=sys.stderr)
    if options.json:
        options.json.write_text(json.dumps(results, indent=1) + "\n")

    sizes = sorted({r["disks"] for r in results})
    print(f"{'CPU seconds (ratio to the first line)':<40}" + "".join(f"N = {n:<18}" for n in sizes))
    for method in ["indet edge"] + [m for m in results[0]["methods"] if m != "indet edge"]:
        cells = []
        for n in sizes:
            group = [r["methods"] for r in results if r["disks"] == n and method in r["methods"]]
            seconds = np.mean([m[method]["seconds"] for m in group])
            ratios = [m[method]["seconds"] / m["indet edge"]["seconds"] for m in group]
            spread = f" ± {np.std(ratios, ddof=1):.2f}" if len(ratios) > 1 else ""
            cells.append(f"{seconds:7.3f} ({np.mean(ratios):.2f}{spread})")
        print(f"{method:<40}" + "".join(f"{cell:<22}" for cell in cells))


if __name__ == "__main__":
    main()
