#!/usr/bin/env python3
"""Estimates of ranges (`indet analyze --accuracy estimate`): makes packings all of whose ranges are known, fits the
coefficients of the model to some of them, and measures on others how often the intervals hold.

    bench/estimate/estimate.py make FOLDER        the packings below, with all ranges (hours)
    bench/estimate/estimate.py fit FOLDER         libindet/range/estimate_coefficients.h, from DESIGN
    bench/estimate/estimate.py cover FOLDER       table of coverage over TEST; --seeds S: also the program itself

FOLDER has NAME.h5, NAME.ranges.h5 (all ranges, gap 1e-3) and NAME.estimate.h5 (centre and widths). The formulas stand in
libindet/range/estimate_model.h and libindet/statistics/residual_band.h; they are written down here once more, in numpy.
"""
import argparse
import datetime
import json
import subprocess
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PROTOCOLS = ("cd1", "md1", "cd2", "md2")
COVERAGE = 0.95
# (protocol, disks, seed). No seed of the one list is in the other.
DESIGN = ([(p, 50, 11 + k) for k, p in enumerate(PROTOCOLS)] + [(p, 95, s) for p in ("cd1", "md1") for s in (11, 12, 13)] +
          [(p, 95, 12) for p in ("cd2", "md2")] + [(p, 200, 11) for p in PROTOCOLS] + [(p, 400, 11) for p in PROTOCOLS] +
          [("md1", 400, s) for s in (12, 13)] + [("md1", 800, s) for s in (11, 12, 13)] + [("cd1", 800, 14), ("md1", 1600, 1), ("md1", 10000, 1)])
TEST = ([("cd1", 95, 101), ("cd1", 95, 102), ("md1", 95, 101), ("md1", 95, 102), ("cd2", 95, 103), ("cd2", 95, 104),
         ("md2", 95, 103), ("md2", 95, 104)] + [(p, 200, 101) for p in PROTOCOLS] + [(p, 400, 101) for p in PROTOCOLS] +
        [("md1", 800, 101), ("cd1", 800, 102), ("md2", 800, 103), ("cd2", 800, 104)])
DETERMINED = 1e-6  # tolerance::kDeterminedWidth
LEAST_DIMENSION = 8
ALL_UP_TO = 1600  # disks; of larger packings the ranges of 100 contacts are found, drawn at random


def name_of(packing):
    return "{}-{}-{}".format(*packing)


def run(indet, *arguments):
    subprocess.run([indet, *map(str, arguments), "--quiet"], check=True)


def make(folder, indet):
    for packing in DESIGN + TEST:
        name = folder / name_of(packing)
        protocol, disks, seed = packing
        if not Path(f"{name}.h5").exists():
            run(indet, "simulate", "--protocol", protocol, "--disks", disks, "--seed", seed, "-o", f"{name}.h5")
        if not Path(f"{name}.ranges.h5").exists():
            how = ["--method", "barrier", "--gap", "1e-3"] if disks <= ALL_UP_TO else \
                ["--accuracy", "estimate", "--calibrate", "100", "--seed", "7"]
            run(indet, "analyze", f"{name}.h5", *how, "-o", f"{name}.ranges.h5")
        run(indet, "analyze", f"{name}.h5", "--accuracy", "estimate", "--calibrate", "0", "-o", f"{name}.estimate.h5")


class Component:
    """R or T of the contacts of a packing whose force can vary: covariates, and what is to be predicted, ln(δ/σ)."""

    def __init__(self, folder, packing, k):
        name = folder / name_of(packing)
        with h5py.File(f"{name}.estimate.h5") as file, h5py.File(f"{name}.ranges.h5") as known:
            mg = file["equilibrium"].attrs["force_unit"]
            width, centre = file["ranges/width"][:] / mg, file["ranges/centre"][:] / mg
            mu = file["contacts/mu"][:]
            delta = known["ranges/delta_" + "RT"[k]][:]
            self.dimension = int(file["equilibrium"].attrs["dim"])
        varies = width > DETERMINED * centre[:, :1]
        self.determined = int((~varies[:, k]).sum())
        assert not (delta[~varies[:, k]] > 1e-2).any()
        self.contacts = np.flatnonzero(varies.any(axis=1))  # those that calibrating ones are drawn from
        keep = self.keep = varies[:, k] & ~np.isnan(delta)
        mean = width[varies[:, k], k].mean()
        self.width, self.delta = width[keep, k], delta[keep]
        limit = mu[keep] * centre[keep, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            self.covariates = np.stack([np.log(self.width / mean),
                                        np.log(self.width / (limit if k else centre[keep, 0])),
                                        np.log(width[keep, 1] / (mu[keep] * width[keep, 0])),
                                        np.abs(centre[keep, 1]) / limit], axis=1)
        self.y = np.log(self.delta / self.width)

    def terms(self, limits):
        c = np.clip(self.covariates, limits[0], limits[1])
        c = np.where(np.isnan(c), limits[0], c).T
        D = np.full(len(self.width), np.log(np.log(max(LEAST_DIMENSION, self.dimension))))
        one = np.ones_like(D)
        return (np.stack([one, D, *c, c[0]**2, c[1]**2, c[0] * D, c[1] * D], axis=1), np.stack([one, D, c[0], c[1]], axis=1))


def fit(components):
    """Least squares, each packing with the same weight; ln|residual| in the same way for the scale."""
    weight = np.concatenate([np.full(len(c.y), 1 / len(c.y)) for c in components])
    root = np.sqrt(weight)
    owner = np.concatenate([np.full(len(c.y), n) for n, c in enumerate(components)])
    covariates = np.concatenate([c.covariates for c in components])
    limits = np.stack([np.quantile(covariates, q, axis=0) for q in (0.001, 0.999)])
    limits = np.sign(limits) * np.round(np.abs(limits), 3)
    limits[0, 3], limits[1, 3] = 0, 1
    X, Z = (np.concatenate(part) for part in zip(*[c.terms(limits) for c in components]))
    y = np.concatenate([c.y for c in components])

    def solve(A, b):
        return np.linalg.lstsq(A * root[:, None], b * root, rcond=None)[0]

    def mean_of_packing(values):
        return np.array([values[owner == n].mean() for n in range(len(components))])

    location = np.round(solve(X, y), 5)
    error = y - X @ location
    own = error - mean_of_packing(error)[owner]
    scale = solve(Z, np.log(np.maximum(np.abs(own), 1e-3)))
    scaled = own / np.exp(Z @ scale)
    scale[0] += 0.5 * np.log((weight * scaled**2).sum() / weight.sum())
    scale = np.round(scale, 5)
    u = error / np.exp(Z @ scale)
    means = mean_of_packing(u)
    own = np.sort(u - means[owner])
    order = np.argsort(u - means[owner])
    place = np.cumsum(weight[order]) / weight.sum()
    low, high = (float(own[np.searchsorted(place, q)]) for q in ((1 - COVERAGE) / 2, (1 + COVERAGE) / 2))
    shared = float(np.sqrt((means**2).mean()))
    return {"limits": limits, "location": location, "scale": scale, "shared": round(shared, 3), "low": round(low, 3),
            "high": round(high, 3), "within": float(np.sqrt((weight * (error - mean_of_packing(error)[owner])**2).sum() /
                                                            weight.sum())),
            "between": float(mean_of_packing(error).std()), "means": means}


def conformal(residuals):
    K = len(residuals)
    n = int(np.floor((1 - COVERAGE) * (K + 1) + 1e-9))
    away = residuals - residuals.mean()
    other = -(K + 1) / (K - 1) * away
    return residuals.mean(), residuals.mean() + np.sort(np.minimum(away, other))[n - 1], \
        residuals.mean() + np.sort(np.maximum(away, other))[-n]


def band(model, residuals):
    if len(residuals) >= 19:
        return conformal(residuals)
    own = 1 + len(residuals) * model["shared"]**2
    middle = (residuals.mean() if len(residuals) else 0) * (1 - 1 / own)
    deviation = np.sqrt(1 + model["shared"]**2 / own)
    return middle, middle + deviation * model["low"], middle + deviation * model["high"]


def coverage(component, model, K, repetitions, random):
    """[repetitions, 4]: share of estimated contacts within the interval; median of low/estimate and high/estimate; median
    of |ln(estimate/δ)|."""
    X, Z = component.terms(model["limits"])
    f, s = X @ model["location"], np.exp(Z @ model["scale"])
    u = (component.y - f) / s
    place = np.full(component.keep.size, -1)
    place[component.keep] = np.arange(len(u))
    rows = []
    for _ in range(repetitions if K else 1):
        drawn = place[random.choice(component.contacts, min(K, len(component.contacts)), replace=False)]
        drawn = drawn[drawn >= 0]
        middle, low, high = band(model, u[drawn])
        rest = np.ones(len(u), bool)
        rest[drawn] = False
        least = np.log(2)
        holds = (np.maximum(least, f + s * low) <= component.y) & (component.y <= np.maximum(least, f + s * high))
        rows.append((holds[rest].mean(), np.median(np.exp(s * (low - middle))), np.median(np.exp(s * (high - middle))),
                     np.median(np.abs(f + s * middle - component.y)[rest])))
    return np.array(rows)


def by_program(folder, packing, K, seeds, indet):
    """Shares of δR and δT within the program's own intervals."""
    name = folder / name_of(packing)
    shares = []
    for seed in seeds if K else [1]:
        out = folder / "one.estimate.h5"
        run(indet, "analyze", f"{name}.h5", "--accuracy", "estimate", "--calibrate", K, "--seed", seed, "-o", out)
        with h5py.File(out) as file, h5py.File(f"{name}.ranges.h5") as known:
            row = []
            for q in ("delta_R", "delta_T"):
                low, high = file[f"ranges/{q}_low"][:], file[f"ranges/{q}_high"][:]
                delta = known[f"ranges/{q}"][:][~np.isnan(low)]
                low, high = low[~np.isnan(low)], high[~np.isnan(high)]
                row.append(((low <= delta) & (delta <= high)).mean())
        shares.append(row)
    return np.mean(shares, axis=0)


def numbers(values):
    return "{" + ", ".join(f"{v:g}" for v in values) + "}"


def header(models, design):
    text = f"""#pragma once

#include "libindet/range/estimate_model.h"

namespace indet {{

// Fitted by bench/estimate/estimate.py on {datetime.date.today()} to {len(design)} packings of 50 to 10000 disks, friction 0.3, in a box
// (its list DESIGN), each with the same weight: limits of the covariates, location, scale, residuals. Within a packing
// ln(δ/σ) differs from the location by {models[0]['within']:.2f} (R) and {models[1]['within']:.2f} (T), root mean square; means over packings by
// {models[0]['between']:.3f} and {models[1]['between']:.3f}.
"""
    for model, name in zip(models, "RT"):
        text += f"""inline constexpr EstimateModel kModelOf{name} = {{
    {numbers(model['limits'][0])},
    {numbers(model['limits'][1])},
    {numbers(model['location'])},
    {numbers(model['scale'])},
    {{{model['shared']:g}, {model['low']:g}, {model['high']:g}}}}};
"""
    return text + "\n}  // namespace indet\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("what", choices=["make", "fit", "cover"])
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--indet", type=Path, default=ROOT / "build/release/indet")
    arguments.add_argument("--repetitions", type=int, default=1000)
    arguments.add_argument("--seeds", type=int, default=0)
    arguments.add_argument("--json", type=Path, help="also write the models to this file")
    options = arguments.parse_args()
    if options.what == "make":
        return make(options.folder, options.indet)
    there = [p for p in DESIGN if (options.folder / f"{name_of(p)}.estimate.h5").exists()]
    models = [fit([Component(options.folder, p, k) for p in there]) for k in (0, 1)]
    if options.what == "fit":
        print(header(models, there), end="")
        return None
    random = np.random.default_rng(1)
    print("\t".join(["packing", "contacts", "determined", "K", "cover_R", "sd_R", "cover_T", "sd_T", "low_R", "high_R", "low_T",
                     "high_T", "error_R", "error_T", "program_R", "program_T"]))
    total = {}
    for packing in TEST:
        if not (options.folder / f"{name_of(packing)}.estimate.h5").exists():
            continue
        for K in (0, 5, 20, 40):
            parts = [Component(options.folder, packing, k) for k in (0, 1)]
            found = [coverage(part, model, K, options.repetitions, random) for part, model in zip(parts, models)]
            R, T = found
            program = by_program(options.folder, packing, K, range(1, options.seeds + 1), options.indet) \
                if options.seeds and K in (0, 20) else (np.nan, np.nan)
            row = [R[:, 0].mean(), R[:, 0].std(), T[:, 0].mean(), T[:, 0].std(), *np.median(R[:, 1:3], axis=0),
                   *np.median(T[:, 1:3], axis=0), np.median(R[:, 3]), np.median(T[:, 3]), *program]
            total.setdefault(K, []).append(row)
            print("\t".join([name_of(packing), str(parts[0].keep.size), str(parts[0].determined), str(K)] +
                            [f"{v:.3f}" for v in row]), flush=True)
    for K, rows in total.items():
        print("\t".join(["mean", str(len(rows)), "", str(K)] + [f"{v:.3f}" for v in np.mean(rows, axis=0)]))
    return None


if __name__ == "__main__":
    main()
