#!/usr/bin/env python3
"""A synthetic pile of any size, as a folder for `indet import --format csv`.

    bench/large/synthetic_pile.py DISKS FOLDER [--seed S] [--mu 0.3] [--plate]

Rows of disks, each between two of the row below and displaced a little. The lowest row is glued, and walls stand at both
sides, so that every disk has two contacts below and all equations are independent. M is about 2 N (1.7 N in packings that
molecular dynamics makes). The forces are drawn, R from an exponential law that grows with the depth, T within the cone, and
the loads of the disks are what balances them. Forces cannot grow without limit, for small friction: a disk has contacts
below, above and at a wall alone, and those of the top row have none above. With --plate a loaded wall lies on the top row, which
may move up and down; all other forces stay as they are.
"""
import argparse
from pathlib import Path

import numpy as np


def pile(disks, mu, random, plate=False):
    columns = max(2, int(round(np.sqrt(disks))))
    rows = int(np.ceil(disks / columns))
    radius = 0.5
    index = np.arange(disks)
    row, column = index // columns, index % columns
    position = np.stack([column + 0.5 * (row % 2), row * np.sqrt(3) / 2 + radius], axis=1)
    position += random.uniform(-0.03, 0.03, position.shape)

    below = [[], []]
    for side in (0, 1):
        other_column = column - 1 + side + (row % 2)
        keep = (row > 0) & (other_column >= 0) & (other_column < columns)
        below[side] = np.stack([index[keep], (row[keep] - 1) * columns + other_column[keep]], axis=1)
    pairs = np.concatenate(below)
    pairs = pairs[np.argsort(pairs[:, 0], kind="stable")]
    # A disk at the end of a row has one disk below it, and a wall at its side.
    side = index[(row > 0) & (np.bincount(pairs[:, 0], minlength=disks) < 2)]
    is_left = column[side] < columns / 2
    a = np.r_[pairs[:, 0], side]
    b = np.r_[pairs[:, 1], np.where(is_left, -1, -2)]
    normal = np.r_[position[pairs[:, 0]] - position[pairs[:, 1]],
                   np.where(is_left[:, None], [1.0, 0.0], [-1.0, 0.0])]
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    R = (0.5 + 0.5 * (rows - row[a])) * np.maximum(0.02, random.exponential(size=len(a)))
    T = 0.7 * mu * R * random.uniform(-1, 1, len(a))
    force = R[:, None] * normal + T[:, None] * np.stack([normal[:, 1], -normal[:, 0]], axis=1)
    load = np.zeros((disks, 3))
    np.add.at(load, a, -np.c_[force, T * radius])
    inner = b >= 0
    np.add.at(load, b[inner], np.c_[force, -T * radius][inner])
    load[row == 0] = 0
    if plate:
        top = index[row == rows - 1]
        pressed = random.exponential(5, len(top))
        a, b = np.r_[a, top], np.r_[b, np.full(len(top), -3)]
        normal = np.r_[normal, np.tile([0.0, -1.0], (len(top), 1))]
        R, T = np.r_[R, pressed], np.r_[T, np.zeros(len(top))]
        load[top, 1] += pressed
    return position, radius, row == 0, columns, a, b, normal, R, T, load


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("disks", type=int)
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--mu", type=float, default=0.3)
    arguments.add_argument("--plate", action="store_true")
    options = arguments.parse_args()
    position, radius, glued, columns, a, b, normal, R, T, load = pile(options.disks, options.mu,
                                                                      np.random.default_rng(options.seed), options.plate)
    options.folder.mkdir(parents=True, exist_ok=True)
    with open(options.folder / "disks.csv", "w") as file:
        file.write("id,x,y,radius,mass,fx,fy,torque,fixed\n")
        for i, (x, y) in enumerate(position.tolist()):
            fx, fy, torque = load[i].tolist()
            file.write(f"{i},{x!r},{y!r},{radius!r},1,{fx!r},{fy!r},{torque!r},{int(glued[i])}\n")
    with open(options.folder / "walls.csv", "w") as file:
        file.write(f"id,px,py,nx,ny,name,load_n\n0,-0.5,0,1,0,left,\n1,{columns},0,-1,0,right,\n")
        if options.plate:
            top = float(position[:, 1].max() + radius)
            file.write(f"2,0,{top!r},0,-1,plate,{float(R[b == -3].sum())!r}\n")
    with open(options.folder / "contacts.csv", "w") as file:
        file.write("a,b,nx,ny,R,T\n")
        for row in zip(a.tolist(), b.tolist(), *normal.T.tolist(), R.tolist(), T.tolist()):
            file.write(",".join(map(repr, row)) + "\n")
    (options.folder / "scene.toml").write_text(f"gravity = [0, 0]\nforce_unit = 1\nmu = {options.mu!r}\n")


if __name__ == "__main__":
    main()
