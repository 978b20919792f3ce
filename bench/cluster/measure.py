#!/usr/bin/python3
"""What an ensemble takes: each packing, the start of a task, the collection (docs/measurements/cluster.tsv).

usage: bench/cluster/measure.py INDET FOLDER > docs/measurements/cluster.tsv

FOLDER is filled (1 GB; a quarter of an hour on two cores); it must be empty or not exist. Columns: what was measured,
disks of a packing, packings, contacts of all of them, seconds of processor time, and MB of memory.
"""
import os
import pathlib
import subprocess
import sys

import h5py

INDET = sys.argv[1]
FOLDER = pathlib.Path(sys.argv[2])
# Of the packings beyond the first seeds, which alone are sampled uniformly and so on.
PLAIN = ["--uniform-seeds", "0", "--paper-walk", "0", "--limits", "0"]
TINY = [*PLAIN, "--samples", "0", "--protocols", "cd1"]  # as many files as possible in a short time


def row(what, disks, packings, contacts, seconds, memory=""):
    print(what, disks, packings, contacts, f"{seconds:.3f}", memory, sep="\t", flush=True)


def run(*arguments):
    """Seconds of processor time, and MB. Status 5 (some packings do not balance) counts as done."""
    process = subprocess.Popen([INDET, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 5):
        raise RuntimeError(f"{arguments}: status {process.returncode}")
    return usage.ru_utime + usage.ru_stime, round(usage.ru_maxrss / 1024)


def part_of(whole, members):
    """A folder with the first members alone, under the same names."""
    part = FOLDER / f"{whole.name}-{len(members)}"
    (part / "members").mkdir(parents=True, exist_ok=True)
    for member in members:
        target = part / "members" / member.name
        if not target.exists():
            os.link(member, target)
    return part


def members_of(folder, seeds):
    return [path for path in sorted((folder / "members").iterdir()) if int(path.stem.split("-")[1]) < seeds]


def contacts_in(folder):
    with h5py.File(folder / "ensemble.h5") as file:
        return int(file["table/runs/contacts"][()].sum())


def packings(disks, seeds):
    """Each packing of some seeds on its own; returns their folder."""
    folder = FOLDER / f"packings{disks}"
    for number in range(4 * seeds):
        before = set(folder.glob("members/*"))
        seconds, memory = run("ensemble", *PLAIN, "--disks", disks, "--seeds", seeds, "--members", number, "--threads", 1, "--out", folder)
        for path in set(folder.glob("members/*")) - before:
            with h5py.File(path) as file:
                row(f"packing {path.stem}", disks, 1, len(file["contacts/mu"]), seconds, memory)
    return folder


def collection(whole, disks, options, seeds):
    """Collecting what is there, its status, and its report."""
    part = part_of(whole, members_of(whole, seeds))
    arguments = ["ensemble", *options, "--disks", disks, "--seeds", seeds, "--out", part]
    run(*arguments)  # first once: what it reads is then in memory, as after any run
    seconds, memory = run(*arguments)
    count, contacts = len(members_of(part, seeds)), contacts_in(part)
    row("collect", disks, count, contacts, seconds, memory)
    row("status without records of tasks", disks, count, contacts, *run("status", part))
    row("size of ensemble.h5 (MB)", disks, count, contacts, (part / "ensemble.h5").stat().st_size / 1e6)
    if disks > 3:
        row("report", disks, count, contacts, *run("report", part))


def start(seeds):
    """A task that finds its place in an ensemble of 4 packings a seed, and `status` of that when nothing is done."""
    folder = FOLDER / f"plan{seeds}"
    row("start of a task", 95, 4 * seeds, 0, *run("ensemble", "--seeds", seeds, "--out", folder, "--dry-run", "--shard", "1/1000"))
    run("submit", "ensemble", "--seeds", seeds, "--out", folder)
    row("status of nothing", 95, 4 * seeds, 0, *run("status", folder))


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    print("measurement\tdisks\tpackings\tcontacts\tseconds\tMB")
    small = packings(95, 10)
    packings(400, 2)
    for seeds in (250, 2500, 25000):
        start(seeds)
    tiny = FOLDER / "tiny"
    run("ensemble", *TINY, "--disks", 3, "--seeds", 10000, "--out", tiny)
    row("status", 3, 10000, 0, *run("status", tiny))
    for seeds in (100, 1000, 10000):
        collection(tiny, 3, TINY, seeds)
    run("ensemble", *PLAIN, "--disks", 95, "--seeds", 60, "--out", small)
    for seeds in (10, 30, 60):
        collection(small, 95, PLAIN, seeds)


if __name__ == "__main__":
    main()
