#!/usr/bin/python3
"""MD-2 with the paper's damping: implicit damping against explicit damping at dt = 7e-7, from the same CD-1 states.

Both stop once elastic forces balance to 1e-3 mg: the explicit steps are so short that rounding of the positions does
not let them come much nearer. A contact slides if its tangential force is within 1e-2 mg of the limit.

usage: bench/damping.py [path of indet] [number of seeds]
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np


def simulate(indet, output, *arguments):
    done = subprocess.run([indet, "--json", "simulate", *arguments, "-o", str(output)], capture_output=True, text=True)
    return json.loads(done.stdout)


def main():
    indet = sys.argv[1] if len(sys.argv) > 1 else "build/release/indet"
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 8
    columns = ("sliding", "mean_overlap", "contacts", "mean_R", "seconds")
    found = {"implicit": [], "explicit": []}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for seed in range(seeds):
            start = folder / f"{seed}.h5"
            simulate(indet, start, "--protocol", "cd1", "--seed", str(seed))
            md2 = ["--protocol", "md2", "--preset", "paper", "--from", str(start), "--residual", "1e-3"]
            found["implicit"].append(simulate(indet, folder / "i.h5", *md2))
            found["explicit"].append(simulate(indet, folder / "e.h5", *md2, "--damping-method", "explicit", "--dt", "7e-7"))
            print(f"seed {seed}: sliding {found['implicit'][-1]['sliding']:.0f} implicit, "
                  f"{found['explicit'][-1]['sliding']:.0f} explicit; {found['implicit'][-1]['seconds']:.2f} s, "
                  f"{found['explicit'][-1]['seconds']:.2f} s", file=sys.stderr)
    print("| damping | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for method, results in found.items():
        print(f"| {method} | " + " | ".join(f"{np.mean([r[c] for r in results]):.3g}" for c in columns) + " |")
    difference = np.array([i["sliding"] - e["sliding"] for i, e in zip(found["implicit"], found["explicit"])])
    print(f"\nsliding, implicit − explicit: {difference.mean():.1f} ± {difference.std(ddof=1) / np.sqrt(len(difference)):.1f}")
    print(f"time ratio: {sum(r['seconds'] for r in found['explicit']) / sum(r['seconds'] for r in found['implicit']):.0f}")


main()
