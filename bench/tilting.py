#!/usr/bin/python3
"""At what angle packings begin to move in dynamics, against the limit of the linear program (docs/limits.md).

usage: bench/tilting.py [path of indet] [--seeds N] [--slow N] [--draw]

Makes packings by contact dynamics (cd1) and molecular dynamics (md1), tilts each both ways by the simulator that made it, and
writes docs/measurements/tilting.tsv and docs/images/tilting.svg. Disks that roll away alone below 1° are left out on both
sides. Of the first packings (--slow) it tells what half the rate changes. --draw draws what was measured before.
"""
import argparse
import csv
import datetime
import itertools
import json
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).parent.parent
TABLE = ROOT / "docs/measurements/tilting.tsv"
PICTURE = ROOT / "docs/images/tilting.svg"
WAY = {"counter-clockwise": 1, "clockwise": -1}
RATE = 0.04  # degrees per √(r_max/g)
DISTANCE = 1e-3  # r_max
IGNORE_BELOW = 1.0  # degrees
CLOSE = 0.05  # degrees: what is nearer to the limit is at it
COLOUR = {"cd1": "#0072B2", "md1": "#E69F00"}
NAME = {"cd1": "contact dynamics", "md1": "molecular dynamics"}


def delay(rate):
    """By how much an angle is found too large (degrees; libsim/tilt.h)."""
    return np.degrees(np.cbrt(6 * DISTANCE * np.radians(rate) ** 2))


def indet(program, *arguments):
    done = subprocess.run([program, "--json", *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in (0, 5):
        raise RuntimeError(f"{arguments}: {done.stderr}")
    return json.loads(done.stdout)


def contacts(path):
    with h5py.File(path) as file:
        return set(zip(file["contacts/body_a"][()].tolist(), file["contacts/body_b"][()].tolist()))


def first_moved(tilt, ignored):
    """The angle (degrees) at which the first disk moved that is not left out, or NaN."""
    return min((abs(np.degrees(disk["angle"])) for disk in tilt["moved_disks"] if disk["id"] not in ignored), default=np.nan)


def tilted(program, packing, protocol, sign, rate, limit, ignored, output):
    """Ends when the first disk has moved that is not left out."""
    for most in range(1, len(ignored) + 2):
        tilt = indet(program, "simulate", "--protocol", protocol, "--from", packing, "--tilt-rate", sign * rate, "--tilt-distance",
                     DISTANCE, "--tilt-moved", most, "--tilt-limit", f"{1.3 * limit + 1:.4f}", "-o", output, "--overwrite")["tilt"]
        if tilt["ending"] != "moved" or not np.isnan(first_moved(tilt, ignored)):
            return tilt


def measure(program, folder, protocol, seed, way, is_slow):
    """A row of the table, and M_s/(2M − 3N) of the states on the way."""
    sign = WAY[way]
    packing = folder / f"{protocol}-{seed}.h5"
    output = folder / f"{protocol}-{seed}-{way}.h5"
    found = indet(program, "limit", packing, "--tilt", "--ignore-below", IGNORE_BELOW, "-o", output, "--overwrite")["limits"][0]
    ignored = set(found["left_out"])
    limit = abs(np.degrees(found["largest" if sign > 0 else "smallest"]))
    tilt = tilted(program, packing, protocol, sign, RATE, limit, ignored, output)
    moved = first_moved(tilt, ignored)
    # Contacts that closed before it moved: with them it can stand beyond the limit of those that it had.
    new = len(contacts(output) - contacts(packing))
    # The limit from there on, with the contacts there.
    last = np.nan
    if not ignored:
        found = indet(program, "limit", output, "--tilt", "-o", folder / "rest.h5", "--overwrite")["limits"][0]
        last = np.degrees(abs(tilt["rest_angle"]) + abs(found["largest" if sign > 0 else "smallest"]))
    disks = 95
    rows = [row for row in tilt["rows"] if abs(row["angle"]) <= abs(tilt["rest_angle"]) + 1e-12]
    path = [(abs(np.degrees(row["angle"])) / limit, row["sliding"] / (2 * row["contacts"] - 3 * disks)) for row in rows]
    start, rest = rows[0], rows[-1]
    slow = np.nan
    if is_slow:
        slow = first_moved(tilted(program, packing, protocol, sign, RATE / 2, limit, ignored, output), ignored)
    row = {"protocol": protocol, "seed": seed, "way": way, "limit": f"{limit:.4f}", "moved": f"{moved:.4f}", "moved_slow": f"{slow:.4f}",
           "rest": f"{abs(np.degrees(tilt['rest_angle'])):.4f}", "limit_rest": f"{last:.4f}", "ignored": len(ignored), "new_contacts": new,
           "M_start": start["contacts"], "sliding_start": start["sliding"], "dimension_start": 2 * start["contacts"] - 3 * disks,
           "M_rest": rest["contacts"], "sliding_rest": rest["sliding"], "dimension_rest": 2 * rest["contacts"] - 3 * disks}
    return row, path


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", nargs="?", default="build/release/indet")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--slow", type=int, default=2)
    parser.add_argument("--draw", action="store_true")
    options = parser.parse_args()
    if not options.draw:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            results = []
            for protocol, seed in itertools.product(NAME, range(options.seeds)):
                indet(options.program, "simulate", "--protocol", protocol, "--seed", seed, "-o", folder / f"{protocol}-{seed}.h5")
                for way in WAY:
                    results.append(measure(options.program, folder, protocol, seed, way, seed < options.slow))
                    print(*results[-1][0].values(), sep="\t", flush=True)
        write(results, options)
    rows = read()
    report(rows)
    draw(rows)


def write(results, options):
    with TABLE.open("w") as file:
        file.write(f"# bench/tilting.py --seeds {options.seeds} --slow {options.slow}, {datetime.date.today()}; N = 95, angles in degrees; "
                   f"{RATE}° a unit of time, moved: by {DISTANCE} r_max (then {delay(RATE):.2f}° too late); path: angle/limit M_s/(2M − 3N)\n")
        columns = [*results[0][0], "path"]
        writer = csv.writer(file, delimiter="\t", lineterminator="\n")
        writer.writerow(columns)
        for row, path in results:
            kept = path[::max(1, len(path) // 20)] + path[-1:]
            writer.writerow([*row.values(), ";".join(f"{x:.3f} {y:.3f}" for x, y in kept)])


def read():
    with TABLE.open() as file:
        file.readline()
        rows = list(csv.DictReader(file, delimiter="\t"))
    for row in rows:
        for name in row:
            if name not in ("protocol", "way", "path"):
                row[name] = float(row[name])
        row["path"] = np.array([list(map(float, point.split())) for point in row["path"].split(";")])
    return rows


def report(rows):
    """The numbers of docs/limits.md. Angles at which a disk moves are less by the delay here."""
    for protocol in NAME:
        own = [row for row in rows if row["protocol"] == protocol]
        column = lambda name: np.array([row[name] for row in own])
        moved, limit, last, slow = column("moved") - delay(RATE), column("limit"), column("limit_rest"), column("moved_slow")
        same = column("new_contacts") == 0
        excess = moved - limit
        print(f"{protocol}: {len(own)} tilts; limit {limit.min():.2f}° … {limit.max():.2f}°, mean {limit.mean():.2f}°")
        print(f"  moves within {CLOSE}° of the limit: {np.sum(np.abs(excess) < CLOSE)}, before: {np.sum(excess <= -CLOSE)}, "
              f"after: {np.sum(excess >= CLOSE)}, not up to 1.3 limits and a degree: {np.isnan(excess).sum()}")
        print(f"  moved/limit: median {np.nanmedian(moved / limit):.3f}, least {np.nanmin(moved / limit):.3f}; of those before the limit: "
              + " ".join(f"{ratio:.2f}" for ratio in np.sort((moved / limit)[excess <= -CLOSE])))
        print(f"  without new contacts ({same.sum()}): {np.nanmin(excess[same]):.3f}° … {np.nanmax(excess[same]):.3f}° over the limit")
        print(f"  over the limit of the last state at rest ({np.sum(~np.isnan(last))}, where no disk is left out): "
              f"at most {np.nanmax(moved - last):.3f}°")
        after = ~(excess < CLOSE)
        print(f"  after the limit: new contacts " + " ".join(f"{n:.0f}" for n in column("new_contacts")[after]) +
              "; over the limit of the last state at rest: " + " ".join(f"{x:.2f}°" for x in (moved - last)[after]))
        for where in ("start", "rest"):
            share = column(f"sliding_{where}") / column(f"dimension_{where}")
            print(f"  M_s at {where} {column(f'sliding_{where}').mean():.1f}; M_s/(2M − 3N) {share.mean():.3f} ± "
                  f"{share.std(ddof=1) / np.sqrt(len(share)):.3f}, {share.min():.2f} … {share.max():.2f}")
        print(f"  half the rate: {np.nanmean(column('moved') - slow):.3f}° earlier, of {np.sum(~np.isnan(slow))} "
              f"(expected {delay(RATE) - delay(RATE / 2):.3f}° times c^(-1/3))")


GNUPLOT = """set terminal svg size 820,400 font 'DejaVu Sans,12' background 'white'
set output '{picture}'
set multiplot layout 1,2
set border 3
set tics nomirror
set key top left reverse Left
set xlabel 'limit of the linear program (degrees)'
set ylabel 'angle at which a disk moves (degrees)'
set xrange [0:{most}]
set yrange [0:{most}]
plot x with lines linecolor '#999999' notitle, {points}
unset key
set xlabel 'angle / limit'
set ylabel 'M_s / (2M − 3N)'
set xrange [0:1.05]
set yrange [0:1.05]
plot 1 with lines linecolor '#999999' dashtype 2 notitle, {curves}
unset multiplot
"""


def draw(rows):
    points, curves = [], []
    with tempfile.TemporaryDirectory() as name:
        for protocol, colour in COLOUR.items():
            own = [row for row in rows if row["protocol"] == protocol]
            data = pathlib.Path(name) / f"{protocol}.txt"
            np.savetxt(data, [(row["limit"], row["moved"] - delay(RATE)) for row in own])
            points.append(f"'{data}' using 1:2 with points pointtype 7 pointsize 0.6 linecolor '{colour}' title '{NAME[protocol]}'")
            grid = np.linspace(0, 1, 21)
            shares = [np.interp(grid, *row["path"].T, right=np.nan) for row in own]
            counts = np.sum(~np.isnan(shares), axis=0)
            kept = counts >= min(5, len(own))
            mean = np.nanmean(np.array(shares)[:, kept], axis=0)
            error = np.nanstd(np.array(shares)[:, kept], axis=0) / np.sqrt(counts[kept])
            curve = pathlib.Path(name) / f"{protocol}-sliding.txt"
            np.savetxt(curve, np.column_stack([grid[kept], mean, mean - error, mean + error]))
            curves.append(f"'{curve}' using 1:3:4 with filledcurves fillcolor '{colour}' fillstyle transparent solid 0.25 notitle, "
                          f"'{curve}' using 1:2 with lines linewidth 2 linecolor '{colour}' title '{NAME[protocol]}'")
        most = 1.05 * max(max(row["limit"], np.nan_to_num(row["moved"])) for row in rows)
        subprocess.run(["gnuplot"], input=GNUPLOT.format(picture=PICTURE, most=most, points=", ".join(points), curves=", ".join(curves)),
                       text=True, check=True)


main()
