#!/usr/bin/python3
"""Molecular dynamics of indet and of LAMMPS (gran/hooke/history) on the same beds and steps.

Times are processor time of the time loop, the least of several runs that take turns.

usage: bench/peers/compare_lammps.py [path of bench_simulators]
"""
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

INPUT = """units lj
dimension 2
atom_style sphere
boundary f f p
newton off
comm_modify vel yes
region box block -1 {right} -1 {top} -0.5 0.5
create_box 1 box
{atoms}
set group all density/disc 1.0
{diameters}
set group all density/disc 1.0
neighbor {skin} bin
neigh_modify every 1 delay 0 check yes
pair_style gran/hooke/history {k} {k} {gamma} {gamma} {mu} 1
pair_coeff * *
fix g all gravity 1.0 vector 0 -1 0
fix i all nve/sphere disc
fix wx all wall/gran hooke/history {k} {k} {gamma} {gamma} {mu} 1 xplane 0 NULL
fix wr all wall/gran hooke/history {k} {k} {gamma} {gamma} {mu} 1 xplane NULL {width}
fix wy all wall/gran hooke/history {k} {k} {gamma} {gamma} {mu} 1 yplane 0 NULL
fix e all enforce2d
timestep {dt}
thermo {steps}
run {steps}
"""


def lammps_seconds(lammps, folder, problem, steps, skin):
    with open(folder / "atoms.csv") as file:
        atoms = list(csv.DictReader(file))
    top = max(float(a["y"]) for a in atoms) + 5
    text = INPUT.format(
        right=problem["width"] + 1, top=top, width=problem["width"], k=problem["k"], mu=problem["mu"],
        # LAMMPS multiplies gamma by the reduced mass.
        gamma=2 * problem["gamma"] / problem["mass"], dt=problem["dt"], steps=steps, skin=skin,
        atoms="\n".join(f"create_atoms 1 single {a['x']} {a['y']} 0" for a in atoms),
        diameters="\n".join(f"set atom {i + 1} diameter {2 * float(a['radius'])!r}" for i, a in enumerate(atoms)))
    (folder / "in.bench").write_text(text)
    done = subprocess.run([lammps, "-in", "in.bench", "-log", "none", "-screen", "out"], cwd=folder)
    out = (folder / "out").read_text()
    found = re.search(r"Loop time of ([0-9.e+-]+) on 1 procs", out)
    share = re.search(r"([0-9.]+)% CPU use", out)
    if done.returncode != 0 or not found or not share:
        sys.exit("LAMMPS failed:\n" + out[-2000:])
    return float(found.group(1)) * min(1, float(share.group(1)) / 100)


def main():
    bench = sys.argv[1] if len(sys.argv) > 1 else "build/release/bench/bench_simulators"
    lammps = shutil.which("lmp")
    if not lammps:
        print("skipped: LAMMPS (lmp) is not installed")
        return
    print(f"{'N':>6} {'steps':>8} {'indet s':>9} {'LAMMPS s':>9} {'ratio':>6}   ns a particle-step: indet, LAMMPS")
    for disks, steps in ((95, 100000), (1600, 6000)):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            ours, theirs = [], []
            with subprocess.Popen([bench, "md", str(disks), str(steps), name], stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, text=True) as process:
                problem = json.loads(process.stdout.readline())
                for _ in range(3):
                    for skin in (0.1, 0.3):
                        process.stdin.write("run\n")
                        process.stdin.flush()
                        ours.append(float(process.stdout.readline()))
                        theirs.append(lammps_seconds(lammps, folder, problem, steps, skin))
                process.stdin.close()
            ours, theirs = min(ours), min(theirs)
            per = 1e9 / (disks * steps)
            print(f"{disks:>6} {steps:>8} {ours:>9.2f} {theirs:>9.2f} {theirs / ours:>6.1f}   {ours * per:.1f}, {theirs * per:.1f}")


main()
