#!/usr/bin/python3
"""What other choices of the simulation would do to the numbers of the paper that ours are farthest from.

usage: bench/remaining_differences.py [path of indet] [number of seeds]

Writes docs/measurements/remaining-differences.tsv: for each choice the mean over the seeds with its standard error, and
the mean change against the default with the standard error of the change, seed by seed.
"""
import concurrent.futures
import datetime
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from protocols import distance, forces

TABLE = pathlib.Path(__file__).parent.parent / "docs/measurements/remaining-differences.tsv"
CHOICES = (  # name, arguments of cd1, of cd2, of md2
    ("as by default", [], [], []),
    ("grid one and a half times as high (57 r_max)", ["--height", "57"], [], []),
    ("grid twice as high (76 r_max)", ["--height", "76"], [], []),
    ("grid without random shifts", ["--jitter", "0"], [], []),
    ("three times the time limit", ["--time-limit", "111"], ["--time-limit", "111"], ["--time-limit", "111"]),
    ("MD at rest: balanced to 1e-4 mg", [], [], ["--residual", "1e-4"]),
    ("MD at rest: balanced to 1e-8 mg", [], [], ["--residual", "1e-8"]),
    ("MD at rest: kinetic energy of 1e-8 mg r_max", [], [], ["--kinetic-energy", "1e-8", "--residual", "1e-2"]),
    ("MD: a tenth of the damping", [], [], ["--damping", "7.7e3"]),
    ("MD: ten times the damping", [], [], ["--damping", "7.7e5"]),
    ("MD: a fifth of the time step", [], [], ["--dt", "2e-4"]),
)
QUANTITIES = ("mean R of CD-1", "mean R of CD-2", "mean R of MD-2", "raw sliding contacts of MD-2", "r of MD-2", "CD-1 – CD-2",
              "CD-1 – MD-2", "MD-2 – CD-2")
PAPER = ("9.3", "", "", "most", "40 ± 1.5", "50 ± 3", "75 ± 4", "45 ± 3")


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 5):  # 5: it does not balance in time
        sys.exit(done.stderr)
    return json.loads(done.stdout) if done.stdout else {}


def measure(indet, seed, cd1, cd2, md2, fall, folder):
    """The quantities of one seed; `fall`: the packing of disks that fell by default."""
    call = [indet, "--json", "--threads", "1"]
    name = {protocol: str(pathlib.Path(folder) / f"{protocol}.h5") for protocol in ("cd1", "cd2", "md2")}
    results = {}
    if cd1 or not fall.exists():
        results["cd1"] = run(*call, "simulate", "--protocol", "cd1", "--seed", str(seed), *cd1, "-o", name["cd1"])
        if not cd1:
            pathlib.Path(name["cd1"]).rename(fall)
    if not cd1:
        name["cd1"] = str(fall)
    for protocol, more in (("cd2", cd2), ("md2", md2)):
        results[protocol] = run(*call, "simulate", "--protocol", protocol, "--from", name["cd1"], *more, "-o", name[protocol])
    if results["md2"]["residual"] > 1e-9:
        return None
    r = run(*call, "sample", name["md2"], "--seed", str(seed), "-o", str(pathlib.Path(folder) / "sample.h5"))["r"]
    state = {protocol: forces(path) for protocol, path in name.items()}
    mean = {protocol: np.mean([R for R, _ in state[protocol].values()]) for protocol in state}
    return [mean["cd1"], mean["cd2"], mean["md2"], results["md2"]["raw_sliding"], r, distance(state["cd1"], state["cd2"]),
            distance(state["cd1"], state["md2"]), distance(state["md2"], state["cd2"])]


def with_error(values):
    return f"{np.mean(values):.2f} ± {np.std(values, ddof=1) / np.sqrt(len(values)):.2f}"


def main():
    indet = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release/indet").resolve())
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    rows = []
    default = None
    with tempfile.TemporaryDirectory() as kept, concurrent.futures.ThreadPoolExecutor(2) as pool:
        for name, cd1, cd2, md2 in CHOICES:

            def one(seed):
                with tempfile.TemporaryDirectory() as folder:
                    return measure(indet, seed, cd1, cd2, md2, pathlib.Path(kept) / f"{seed}.h5", folder)

            found = list(pool.map(one, range(seeds)))
            default = default or found
            both = [(a, b) for a, b in zip(found, default) if a and b]
            now, before = (np.array(x) for x in zip(*both))
            for k, quantity in enumerate(QUANTITIES):
                change = with_error(now[:, k] - before[:, k]) if found is not default else ""
                rows.append((name, quantity, PAPER[k], with_error(now[:, k]), change, str(len(both))))
            TABLE.write_text(f"# bench/remaining_differences.py build/release/indet {seeds}, {datetime.date.today()}; forces in mg\n"
                             "choice\tquantity\tpaper\there\tchange against the default\tpackings\n"
                             + "".join("\t".join(row) + "\n" for row in rows), encoding="utf-8")
            print("\n".join("\t".join(row) for row in rows[-len(QUANTITIES):]), flush=True)


if __name__ == "__main__":
    main()
