#!/usr/bin/env python3
"""One force range at a time: the interior point method beside other solvers, at growing size.

    bench/large/rivals.py [--build build/release] [--folder DIR] [--disks 95 400 1600] [--packings P.h5 ...]
                          [--objectives 6] [--limit 120] [--out rivals.tsv]

Packings are made in DIR by `simulate --protocol md1`, or taken as they are (--packings). The linear program of a force is set up
here, from the positions and friction of the file: two edges of each contact's cone as unknowns >= 0, three equations a disk. A few
forces, drawn at random, are minimised and maximised by

    barrier          `indet analyze --method barrier`, all at once, with proven intervals (--gap 1e-6)
    lp               `indet analyze --method lp --extremal-states none`, warm, with proven enclosures, where it ends in time
                     (both find all contacts up to 1000, and 40 of larger packings; program, polytope and file included)
    clp-dual         Clp's dual simplex            clp-barrier  Clp's interior point method, without crossover
    glpk-interior    glpsol --interior
    highs-simplex    HiGHS by SciPy, dual simplex  highs-ipm    its interior point method

each of the last five from scratch. A row is a packing and a solver: processor time an objective, of the last five less what
starting and reading the file takes, the largest memory (what this script holds at least), and the largest difference from the
proven interval (mg). Solvers that are not installed are left out; where one takes longer than --limit, its objectives end there.
"""
import argparse
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np
import scipy.optimize
import scipy.sparse

COLUMNS = ["packing", "disks", "contacts", "solver", "objectives", "seconds_per_objective", "memory_MB", "largest_difference"]


ALL_UP_TO = 1000  # contacts: of larger packings indet, too, finds 40 contacts only


class Program:
    """Minimise c x for Ax = b, x >= 0: forces in mg, x the strengths of the edges of the cones."""

    def __init__(self, path):
        with h5py.File(path) as file:
            a, b = file["contacts/body_a"][()], file["contacts/body_b"][()]
            normal, mu = file["contacts/normal"][()], file["contacts/mu"][()]
            radius, mass = file["particles/disks/radius"][()], file["particles/disks/mass"][()]
            gravity = file["parameters"].attrs["gravity"]
            mg = file["parameters"].attrs["mg"]
        disks, contacts = len(radius), len(a)
        self.disks, self.contacts, self.mu = disks, contacts, mu
        tangent = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
        rows, columns, values = [], [], []
        for edge in (0, 1):
            sign = 1 - 2 * edge
            force = normal + sign * (mu[:, None] * tangent)
            column = 2 * np.arange(contacts) + edge
            for body, side in ((a, 1), (b, -1)):
                held = body >= 0
                for k, value in enumerate((side * force[:, 0], side * force[:, 1], sign * mu)):
                    rows.append(3 * body[held] + k)
                    columns.append(column[held])
                    values.append(value[held])
        self.A = scipy.sparse.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                                         shape=(3 * disks, 2 * contacts))
        self.b = np.zeros(3 * disks)
        for k in (0, 1):
            self.b[k::3] = -mass * gravity[k] / mg

    def objective(self, contact, tangential, sign):
        c = np.zeros(2 * self.contacts)
        c[2 * contact:2 * contact + 2] = sign * (np.array([1, -1]) * self.mu[contact] if tangential else np.array([1, 1]))
        return c

    def write_mps(self, path, c):
        with open(path, "w") as file:
            file.write("NAME F\nROWS\n N cost\n")
            file.writelines(f" E r{i}\n" for i in range(len(self.b)))
            file.write("COLUMNS\n")
            for j in range(self.A.shape[1]):
                if c[j] != 0:
                    file.write(f" x{j} cost {c[j]:.17g}\n")
                for k in range(self.A.indptr[j], self.A.indptr[j + 1]):
                    file.write(f" x{j} r{self.A.indices[k]} {self.A.data[k]:.17g}\n")
            file.write("RHS\n")
            file.writelines(f" b r{i} {value:.17g}\n" for i, value in enumerate(self.b) if value != 0)
            file.write("ENDATA\n")


def measure(command, limit, output=subprocess.DEVNULL):
    """Processor time and memory of a program; none if it takes longer."""
    process = subprocess.Popen(list(map(str, command)), stdout=output, stderr=subprocess.DEVNULL)
    end = time.monotonic() + limit
    while True:
        done, status, usage = os.wait4(process.pid, os.WNOHANG)
        if done:
            process.returncode = os.waitstatus_to_exitcode(status)
            return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024
        if time.monotonic() > end:
            process.send_signal(signal.SIGKILL)
            process.wait()
            return None
        time.sleep(0.01)


def value_of(text, pattern):
    found = [line.split(pattern)[1].split()[0].rstrip(";") for line in text.splitlines() if pattern in line]
    return float(found[-1]) if found else np.nan


def by_file(solve, read, pattern):
    """A solver that reads a file: seconds, memory and value."""
    def run(program, c, folder, limit):
        path, log = folder / "rival.mps", folder / "rival.log"
        program.write_mps(path, c)
        with open(log, "w") as output:
            solved = measure([part.format(path) for part in solve], limit, output)
        reading = measure([part.format(path) for part in read], limit)
        if not solved or not reading:
            return None
        return max(0, solved[0] - reading[0]), solved[1], value_of(log.read_text(), pattern)
    return run


def by_scipy(method):
    def run(program, c, _folder, limit):
        start = time.process_time()
        found = scipy.optimize.linprog(c, A_eq=program.A, b_eq=program.b, bounds=(0, None), method=method,
                                       options={"time_limit": limit})
        seconds = time.process_time() - start
        return (seconds, np.nan, found.fun) if found.status == 0 else None
    return run


RIVALS = {
    "clp-dual": ("clp", by_file(["clp", "{}", "-dualsimplex"], ["clp", "{}", "-quit"], "Optimal objective")),
    "clp-barrier": ("clp", by_file(["clp", "{}", "-crossover", "off", "-barrier"], ["clp", "{}", "-quit"], "Optimal objective")),
    "glpk-interior": ("glpsol", by_file(["glpsol", "--freemps", "{}", "--interior"], ["glpsol", "--freemps", "{}", "--check"],
                                        "obj =")),
    "highs-simplex": (None, by_scipy("highs-ds")),
    "highs-ipm": (None, by_scipy("highs-ipm")),
}


def intervals_of(indet, method, path, contacts, folder, limit):
    out = folder / "rivals.ranges.h5"
    command = [indet, "--threads", 1, "analyze", path, "--contacts", ",".join(map(str, contacts)), "--method", method, "-o", out,
               "--overwrite", "--quiet"] + (["--extremal-states", "none"] if method == "lp" else [])
    used = measure(command, limit)
    if not used:
        return None
    with h5py.File(out) as file:
        mg = file["parameters"].attrs["mg"]
        return used, file["ranges/lower"][()] / mg, file["ranges/upper"][()] / mg


def compare(options, path, random):
    program = Program(path)
    few = random.permutation(program.contacts)[:max(40, options.objectives)]
    contacts = np.arange(program.contacts) if program.contacts <= ALL_UP_TO else np.sort(few)
    head = [path.stem, program.disks, program.contacts]
    used, lower, upper = intervals_of(options.indet, "barrier", path, contacts, options.folder, 3600)
    yield head + ["barrier", 4 * len(contacts), used[0] / (4 * len(contacts)), used[1], 0.0]
    other = intervals_of(options.indet, "lp", path, contacts, options.folder, 10 * options.limit)
    if other:
        apart = np.nanmax(np.maximum(other[1] - upper, lower - other[2])[contacts])
        yield head + ["lp", 4 * len(contacts), other[0][0] / (4 * len(contacts)), other[0][1], max(0, apart)]
    for name, (needs, solve) in RIVALS.items():
        if needs and not shutil.which(needs):
            print(f"{name}: {needs} is not installed", file=sys.stderr)
            continue
        seconds, memory, difference = [], [], 0
        for number, contact in enumerate(few[:options.objectives]):
            column = number % 4  # R_min, R_max, T_min, T_max in turn
            sign = 1 if column % 2 == 0 else -1
            found = solve(program, program.objective(contact, column >= 2, sign), options.folder, options.limit)
            if not found:
                break
            seconds.append(found[0])
            memory.append(found[1])
            value = sign * found[2]
            difference = max(difference, lower[contact, column] - value, value - upper[contact, column])
        yield head + [name, len(seconds), np.mean(seconds) if seconds else np.nan, max(memory, default=np.nan), difference]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("rivals"))
    parser.add_argument("--disks", type=int, nargs="*", default=[95, 400, 1600])
    parser.add_argument("--packings", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--objectives", type=int, default=6)
    parser.add_argument("--limit", type=float, default=120, help="seconds for one objective")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("rivals.tsv"))
    options = parser.parse_args()
    options.indet = options.build.resolve() / "indet"
    options.folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for disks in options.disks:
        paths.append(options.folder / f"md1-{disks}-1.h5")
        if not paths[-1].exists():
            subprocess.run([options.indet, "simulate", "--protocol", "md1", "--disks", str(disks), "--seed", "1", "--quiet", "-o",
                            paths[-1]], check=False)
    random = np.random.default_rng(1)
    with open(options.out, "w") as file:
        print(*COLUMNS, sep="\t", file=file)
        for path in paths + options.packings:
            for row in compare(options, path, random):
                text = [f"{value:.4g}" if isinstance(value, float) else str(value) for value in row]
                print(*text, sep="\t", file=file, flush=True)
                print(*text, sep="\t", flush=True)


if __name__ == "__main__":
    main()
