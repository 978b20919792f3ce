#!/usr/bin/python3
"""Gauss-Seidel of indet and of Siconos (fc2d NSGS) on the same frozen contact problems, at equal residual.

Times are processor time. Frictionless forces are unique in these packings, so there both must find the same.

usage: bench/peers/compare_siconos.py [path of bench_simulators]
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
    import scipy.sparse as sparse
    import siconos.numerics as sn
except ImportError as error:
    print(f"skipped: {error} (packages python3-siconos, python3-scipy)")
    sys.exit(0)


def read(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def contact_problem(folder):
    """H: contact velocities (n, t) from body velocities (x, y, turn); inverse masses; friction."""
    disks = read(folder / "disks.csv")
    contacts = read(folder / "contacts.csv")
    rows, columns, values = [], [], []

    def put(row, column, value):
        rows.append(row)
        columns.append(column)
        values.append(value)

    for i, c in enumerate(contacts):
        nx, ny = float(c["nx"]), float(c["ny"])
        for body, sign in ((int(c["a"]), 1), (int(c["b"]), -1)):
            if body < 0:
                continue
            put(2 * i, 3 * body, sign * nx)
            put(2 * i, 3 * body + 1, sign * ny)
            put(2 * i + 1, 3 * body, sign * ny)
            put(2 * i + 1, 3 * body + 1, -sign * nx)
            put(2 * i + 1, 3 * body + 2, float(disks[body]["radius"]))
    H = sparse.csr_matrix((values, (rows, columns)), shape=(2 * len(contacts), 3 * len(disks)))
    inverse = np.ravel([[1 / float(d["mass"])] * 2 + [1 / float(d["inertia"])] for d in disks])
    wrench = np.ravel([[0, -float(d["mass"]), 0] for d in disks])
    radius = np.ravel([[1, 1, float(d["radius"])] for d in disks])
    return H, inverse, wrench, radius, np.array([float(c["mu"]) for c in contacts])


def solve_with_siconos(H, inverse, wrench, mu, tolerance):
    W = sparse.csr_matrix(H @ sparse.diags(inverse) @ H.T)
    q = H @ (inverse * wrench)
    code, blocks = sn.SBM_from_csparse(2, W)
    matrix = sn.NumericsMatrix(blocks) if hasattr(sn, "NumericsMatrix") and not isinstance(blocks, sn.NumericsMatrix) else blocks
    problem = sn.FrictionContactProblem(2, matrix, q, mu)
    options = sn.SolverOptions(sn.SICONOS_FRICTION_2D_NSGS)
    options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 1000000
    options.dparam[sn.SICONOS_DPARAM_TOL] = tolerance
    reaction = np.zeros(len(q))
    velocity = np.zeros(len(q))
    begin = time.process_time()
    sn.fc2d_driver(problem, reaction, velocity, options)
    return reaction, time.process_time() - begin


def main():
    bench = sys.argv[1] if len(sys.argv) > 1 else "build/release/bench/bench_simulators"
    print(f"{'N':>6} {'mu':>4} {'residual mg':>12} {'Siconos s':>10} {'indet s':>9} {'ratio':>6}   difference of forces, mg")
    for disks, mu in ((95, 0.3), (400, 0.3), (95, 0)):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            process = subprocess.Popen([bench, "statics", str(disks), str(mu), name], stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, text=True)
            unit = float(process.stdout.readline().split()[1])
            H, inverse, wrench, radius, friction = contact_problem(folder)
            # Where the forces are unique, tight enough to see that both find them.
            for tolerance in (1e-4, 1e-6) if mu > 0 else (1e-4, 1e-8, 1e-12):
                runs = [solve_with_siconos(H, inverse, wrench, friction, tolerance) for _ in range(3)]
                reaction, theirs = runs[0][0], min(run[1] for run in runs)
                residual = np.abs((H.T @ reaction + wrench) / radius).max() / unit
                # Our first tolerance that balances as well.
                ours = None
                for exponent in np.arange(-2, -13.1, -0.25):
                    process.stdin.write(f"{10 ** exponent}\n")
                    process.stdin.flush()
                    seconds, found, _ = map(float, process.stdout.readline().split())
                    if found <= residual:
                        ours = seconds
                        break
                forces = np.loadtxt(folder / "forces.csv")
                if ours is None:
                    print(f"{disks:>6} {mu:>4} {residual:>12.1e} {theirs:>10.3f}   not reached")
                    continue
                print(f"{disks:>6} {mu:>4} {residual:>12.1e} {theirs:>10.3f} {ours:>9.4f} {theirs / ours:>6.1f}   "
                      f"{np.abs(forces - reaction).max() / unit:.1e}" + (" (unique)" if mu == 0 else ""))
            process.stdin.close()
            process.wait()


main()
