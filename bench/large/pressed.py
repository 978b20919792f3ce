#!/usr/bin/env python3
"""What a piston and a cell cost the barrier method: the same forces with and without the rows that they add.

    bench/large/pressed.py [--disks 1600] [--cell CELL.h5] [--tiles 4] [--build build/release] [--folder DIR] [--contacts 40]

A synthetic pile (synthetic_pile.py) with and without a loaded plate on its top row; and CELL, a packing that is periodic in both
directions under stress, repeated --tiles times along each side. Prints processor time and memory of `analyze --method barrier` of
--contacts drawn contacts, the least of --repeats, a line each.
"""
import argparse
import csv
import pathlib
import subprocess
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import measured  # noqa: E402


def write(path, rows):
    names = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, names, restval="")
        table.writeheader()
        table.writerows(rows)


def tiled(cell, tiles, folder):
    """Tables of a cell that is repeated along both sides."""
    with h5py.File(cell) as file:
        position, radius = file["particles/disks/position"][()], file["particles/disks/radius"][()]
        mass = file["particles/disks/mass"][()]
        a, b = file["contacts/body_a"][()], file["contacts/body_b"][()]
        image, normal = file["contacts/image"][()], file["contacts/normal"][()]
        R, T, mu = file["contacts/R"][()], file["contacts/T"][()], file["contacts/mu"][()]
        levers = file["contacts/lever_a"][()], file["contacts/lever_b"][()]
        sides = file["particles/disks/box/edges"][()]
        unit = file["parameters"].attrs["mg"]
    count = len(radius)
    disks, contacts = [], []
    for j in range(tiles):
        for i in range(tiles):
            first = count * (j * tiles + i)
            for k, (x, y) in enumerate(position + i * sides[0] + j * sides[1]):
                disks.append({"id": first + k, "x": x, "y": y, "radius": radius[k], "mass": mass[k]})
            for k in range(len(a)):
                column, row = i + image[k, 0], j + image[k, 1]
                contacts.append({"a": first + a[k], "b": count * (row % tiles * tiles + column % tiles) + b[k],
                                 "nx": normal[k, 0], "ny": normal[k, 1], "mu": mu[k], "R": R[k], "T": T[k],
                                 "lever_a": levers[0][k], "lever_b": levers[1][k], "image_x": column // tiles, "image_y": row // tiles})
    folder.mkdir(parents=True, exist_ok=True)
    write(folder / "disks.csv", disks)
    write(folder / "contacts.csv", contacts)
    ends = [", ".join(map(repr, map(float, tiles * side))) for side in sides]
    (folder / "scene.toml").write_text(f"gravity = [0, 0]\nforce_unit = {float(unit)!r}\n[cell]\na = [{ends[0]}]\nb = [{ends[1]}]\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--disks", type=int, default=1600)
    parser.add_argument("--cell", type=pathlib.Path)
    parser.add_argument("--tiles", type=int, default=4)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("pressed"))
    parser.add_argument("--contacts", type=int, default=40)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    indet = options.build.resolve() / "indet"
    options.folder.mkdir(parents=True, exist_ok=True)

    packings = {}
    for name, more in (("pile", []), ("pile under a plate", ["--plate"])):
        scene = options.folder / name.replace(" ", "-")
        subprocess.run([sys.executable, pathlib.Path(__file__).parent / "synthetic_pile.py", str(options.disks), scene, *more], check=True)
        packings[name] = scene.with_suffix(".h5")
        measured.run(indet, "import", "--format", "csv", scene, "-o", packings[name], "--overwrite")
    if options.cell:
        tiled(options.cell, options.tiles, options.folder / "cell")
        packings["cell under stress"] = options.folder / "cell.h5"
        measured.run(indet, "import", "--format", "csv", options.folder / "cell", "-o", packings["cell under stress"], "--overwrite")
    used = {name: [] for name in packings}
    for _ in range(options.repeats):
        for name, path in packings.items():
            used[name].append(measured.run(indet, "analyze", path, "--method", "barrier", "--contacts",
                                           f"sample:{options.contacts}", "-o", options.folder / "r.h5", "--overwrite",
                                           report=True))
    for name, runs in used.items():
        report = runs[0][2]
        print(f"{name:<20} {report['disks']} disks, {report['contacts']} contacts, {report['status']}: "
              f"{min(r[0] for r in runs):.2f} s, {max(r[1] for r in runs):.0f} MB, {report['certified']} of "
              f"{report['objectives']} certified, {report['pivots'] / max(1, report['objectives']):.1f} steps a value")


if __name__ == "__main__":
    main()
