#!/usr/bin/env python3
"""Seconds by stage of structures that look simple: rows, columns, rings, lattices. Needs no packing.

    bench/structures/structures.py [--build build/release] [--limit 60] [--options ...] [row:100 column:500 ring:100 lattice:8 ...]

row:N      disks side by side on a floor, between two walls
column:N   disks on each other
ring:N     small disks around a large one (radius 200 : 1), a wall behind each: a planetary gear, which can turn
           but for the last digits of the normals, so that every value is marked
lattice:N  a triangular pile of N rows between two walls
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile


def row(n):
    disks = [(2 * k, 1, 1) for k in range(n)]
    walls = [(0, 0, 0, 1), (-1, 0, 1, 0), (2 * n - 1, 0, -1, 0)]
    contacts = [(k, -1) for k in range(n)] + [(k, k - 1) for k in range(1, n)] + [(0, -2), (n - 1, -3)]
    return disks, walls, contacts


def column(n):
    return [(0, 1 + 2 * k, 1) for k in range(n)], [(0, 0, 0, 1)], [(k, k - 1) for k in range(n)]


def ring(n):
    r = 1 / 200
    disks, walls, contacts = [(0, 0, 1)], [], []
    for k in range(n):
        c, s = math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)
        disks.append(((1 + r) * c, (1 + r) * s, r))
        walls.append(((1 + 2 * r) * c, (1 + 2 * r) * s, -c, -s))
        contacts += [(0, k + 1), (k + 1, -k - 1)]
    return disks, walls, contacts


def lattice(n):
    number = {place: k for k, place in enumerate((i, j) for j in range(n) for i in range(n - j))}
    disks = [(2 * i + j, 1 + j * math.sqrt(3), 1) for i, j in number]
    contacts = [(number[i, 0], -1) for i in range(n)] + [(number[0, 0], -2), (number[n - 1, 0], -3)]
    for (i, j), k in number.items():
        contacts += [(k, number[i + p, j + q]) for p, q in ((1, 0), (0, 1), (-1, 1)) if (i + p, j + q) in number]
    return disks, [(0, 0, 0, 1), (-1, 0, 1, 0), (2 * n - 1, 0, -1, 0)], contacts


def write_scene(folder, disks, walls, contacts):
    """Densities are equal: a mass is the square of the radius. Wall w is −1 − w."""
    tables = {
        "disks": ["id,x,y,radius,mass"] + [f"{k},{x!r},{y!r},{r!r},{r * r!r}" for k, (x, y, r) in enumerate(disks)],
        "walls": ["id,px,py,nx,ny,name"] + [f"{k},{x!r},{y!r},{p!r},{q!r},w{k}" for k, (x, y, p, q) in enumerate(walls)],
        "contacts": ["a,b"] + [f"{a},{b}" for a, b in contacts],
    }
    for name, lines in tables.items():
        (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")
    (folder / "scene.toml").write_text("gravity = [0, -1]\nmu = 0.3\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default="build/release")
    parser.add_argument("--limit", type=float, default=60, help="seconds")
    parser.add_argument("--options", default="", help="of analyze, in one string")
    parser.add_argument("scenes", nargs="*", default=["row:40", "row:100", "row:300", "column:500", "column:1500", "ring:100", "ring:301", "lattice:8", "lattice:16"])
    args = parser.parse_args()
    program = args.build.resolve() / "indet"
    print("| scene | status | dim | method | pivots | imprecise | seconds by stage |\n|---|---|---|---|---|---|---|")
    for scene in args.scenes:
        kind, size = scene.split(":")
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write_scene(folder, *{"row": row, "column": column, "ring": ring, "lattice": lattice}[kind](int(size)))
            packing = folder / "packing.h5"
            subprocess.run([program, "import", "--format", "csv", folder, "-o", packing], check=True, capture_output=True)
            command = [program, "analyze", packing, "-o", folder / "r.h5", "--json", "--quiet", "--threads", "1", *args.options.split()]
            try:
                done = subprocess.run(command, capture_output=True, timeout=args.limit, check=False)
            except subprocess.TimeoutExpired:
                print(f"| {scene} | more than {args.limit:g} s | | | | | |", flush=True)
                continue
            if done.returncode not in (0, 5):
                raise SystemExit(done.stderr.decode())
            r = json.loads(done.stdout)
            stages = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in r["seconds"].items() if seconds >= 0.005)
            print(f"| {scene} | {r['status']} | {r['dim']} | {r['method']} | {r['pivots']} | {r['imprecise']} | {stages} |", flush=True)


if __name__ == "__main__":
    main()
