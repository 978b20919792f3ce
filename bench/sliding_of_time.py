#!/usr/bin/python3
"""Sliding contacts of CD-2 against the number of the step, for several numbers of sweeps of the first one.

usage: bench/sliding_of_time.py [path of indet] [number of seeds]

Draws docs/images/sliding-contacts-of-cd2.svg, and prints the numbers behind it.
"""
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

PICTURE = pathlib.Path(__file__).parent.parent / "docs/images/sliding-contacts-of-cd2.svg"
SWEEPS = (100, 300, 1000, 3000, 100000)
STEP = 1e-3
FRAMES = 200
MU = 0.3
GNUPLOT = """set terminal svg size 620,330 font 'DejaVu Sans,12' background 'white'
set output '{picture}'
set xlabel 'step of CD-2'
set ylabel 'sliding contacts'
set logscale x
set xrange [1:200]
set yrange [0:45]
set key right top title 'sweeps of the first step'
set border 3
set tics nomirror
plot {curves}
"""
COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#000000")


def run(*arguments):
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)


def sliding(path):
    """Raw sliding contacts after each step, by the paper's epsilon."""
    with h5py.File(path) as file:
        unit = file["parameters"].attrs["mg"]
        frames = file["trajectory"]
        R, T = (frames[f"contacts/{name}"][()] / unit for name in ("R", "T"))
        of_frame = frames["first_contact"][()]
        slides = (R >= 1e-9) & (MU * R - np.abs(T) < 1e-9)
        return np.array([slides[a:b].sum() for a, b in zip(of_frame[:-1], of_frame[1:])])


def main():
    indet = sys.argv[1] if len(sys.argv) > 1 else "build/release/indet"
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    counts = {sweeps: [] for sweeps in SWEEPS}
    with tempfile.TemporaryDirectory() as name:
        first, second = f"{name}/cd1.h5", f"{name}/cd2.h5"
        for seed in range(seeds):
            run(indet, "simulate", "--protocol", "cd1", "--seed", str(seed), "-o", first)
            for sweeps in SWEEPS:
                run(indet, "simulate", "--protocol", "cd2", "--from", first, "--start-sweeps", str(sweeps), "--every", str(STEP),
                    "--kinetic-energy", "0", "--time-limit", str((FRAMES - 0.5) * STEP), "-o", second)
                counts[sweeps].append(sliding(second)[1:FRAMES + 1])
        curves = []
        print("sweeps of the first step; sliding contacts after 1, 3, 10, 30, 50, 100, 200 steps")
        for sweeps, colour in zip(SWEEPS, COLOURS):
            mean = np.mean(counts[sweeps], axis=0)
            data = pathlib.Path(name) / f"{sweeps}.txt"
            np.savetxt(data, np.column_stack([np.arange(1, len(mean) + 1), mean]))
            title = "until it is solved" if sweeps == SWEEPS[-1] else str(sweeps)
            curves.append(f"'{data}' using 1:2 with lines linewidth 2 linecolor '{colour}' title '{title}'")
            print(title, *(f"{mean[step - 1]:.1f}" for step in (1, 3, 10, 30, 50, 100, 200)))
        subprocess.run(["gnuplot"], input=GNUPLOT.format(picture=PICTURE, curves=", ".join(curves)), text=True, check=True)


main()
