#!/usr/bin/env python3
"""What contacts that are drawn by their widths tell of all, beside contacts that are equally likely.

    bench/draws/draws.py [--build build/release] [--folder DIR] [--disks 95 400 800 1600] [--protocols md1] [--seeds 11 12 13]
                         [--packings R.h5 ...] [--repetitions 2000] [--out draws.tsv] [--rules [--check SEEDS]]

Packings are made in DIR, or taken as they are (--packings: any file with contacts), and analyzed with --method barrier: all
values once, a sample once, whose file has the weights and widths, and estimated once for the predictions. From these the draws are
repeated here. A row is a packing, a quantity and a number of draws K: the error (root mean square, over the mean) of the mean of
equally likely contacts, of that of z = y/(M p) over drawn ones, and of what the program does, from 8 draws on the regression of z
on predictions; of the latter the percentage of repetitions whose interval covers the mean and the mean half-width of that interval
over the mean; the band of the distribution function, the largest distance of that function in 95 of 100 repetitions and the
percentage that the band covers (both over 400 values of v, and 300 repetitions), and the largest distance of the distribution of
the drawn values themselves, weighted by 1/p.

--rules: other rules of drawing and other estimators beside those of the program, from the same values. A row is a packing, a
quantity and a number of draws; `worth` is the variance of y over that of y/(M p), which is how many times larger a sample of
equally likely contacts, drawn with replacement, would have to be for the same error, and `correlation` that of y with its width.
Then, of each of RULES, the error (root mean square, over the mean) and the percentage of intervals that cover:

    mean          p of the program, mean of z = y/(M p), Student's interval
    width_R       p by the widths of R alone, p ∝ 0.02 + σ_R/mean
    predicted     p ∝ 0.02 + the sum of both predictions of --accuracy estimate --calibrate 0, each over its mean
    systematic    p of the program, systematic without replacement (Madow, Ann. Math. Stat. 20, 333 (1949)) along the list sorted
                  by σ_T/σ_R relative to their means; variance from the differences of neighbours
    by_width      p of the program, z regressed on σ/(M p), whose mean over all contacts is known
    by_prediction p of the program, z regressed on the prediction over M p: what the program does from 8 draws on
    both          p of `predicted`, z regressed on the prediction over M p

Intervals of the regressions are those of Student for K - 2 degrees, with residuals over 1 - leverage (HC3).

--check SEEDS: the program itself draws 20 contacts with each of the seeds 1 … SEEDS; its means and intervals have to be those that
are computed here from its draws and from all values, and its probabilities those that the widths give.
"""
import argparse
import pathlib
import subprocess

import h5py
import numpy as np
from scipy.stats import t as student

COLUMNS = ["packing", "contacts", "quantity", "draws", "simple_error", "mean_error", "error", "interval_covers", "half_width",
           "band", "distance_95", "band_covers", "weighted_distance_95"]
SIZES = [6, 10, 20, 40, 80, 160]
FEWEST_FOR_REGRESSION = 8  # kFewestForRegression
RULES = ["mean", "width_R", "predicted", "systematic", "by_width", "by_prediction", "both"]
RULE_COLUMNS = ["packing", "contacts", "quantity", "draws", "correlation", "worth", "simple_error",
                *(f"{what}_{rule}" for rule in RULES for what in ("error", "covers"))]
RULE_SIZES = [6, 10, 20, 40, 100]


def run(indet, *arguments):
    done = subprocess.run([indet, *map(str, arguments), "--quiet"], check=False)
    if done.returncode not in (0, 5):
        raise RuntimeError(f"{arguments}: status {done.returncode}")


def packings(arguments):
    for path in arguments.packings:
        yield path.stem.removesuffix(".ranges"), path
    for disks in arguments.disks:
        for protocol in arguments.protocols:
            for seed in arguments.seeds:
                path = arguments.folder / f"{protocol}-{disks}-{seed}.h5"
                if not path.exists():
                    run(arguments.indet, "simulate", "--protocol", protocol, "--disks", disks, "--seed", seed, "-o", path)
                yield path.stem, path


def values_and_weights(arguments, name, path):
    every = arguments.folder / f"{name}.all.h5"
    some = arguments.folder / f"{name}.some.h5"
    if not every.exists():
        run(arguments.indet, "analyze", path, "--method", "barrier", "--gap", "1e-3", "--extremal-states", "none", "-o", every)
    if not some.exists():
        run(arguments.indet, "analyze", path, "--method", "barrier", "--gap", "1e-2", "--contacts", "sample:6", "-o", some)
    with h5py.File(every) as all_values, h5py.File(some) as drawn:
        delta = {q: all_values[f"ranges/{q}"][()] for q in ("delta_R", "delta_T")}
        width = drawn["ranges/width"][()]
        return delta, {"delta_R": width[:, 0], "delta_T": width[:, 1]}, drawn["ranges/draw_weight"][()]


def distances(delta, width, draws):
    """Largest distance of the distribution function that each row of draws tells from that of all contacts."""
    grid = np.unique(np.quantile(delta, np.linspace(0, 1, 400)))
    truth = np.searchsorted(np.sort(delta), grid, side="right") / len(delta)
    with np.errstate(divide="ignore"):
        log_width = np.sort(np.log(width))
        log_grid = np.log(grid)
    for row in draws:
        row = row[(width[row] > 0) & (delta[row] > 0)]
        ratio = np.log(delta[row] / width[row])
        told = np.mean([np.searchsorted(log_width, log_grid - r, side="right") for r in ratio], axis=0) / len(delta)
        yield np.abs(told - truth).max()


def weighted_distances(delta, probability, draws):
    """The same of the drawn values, weighted by 1/p."""
    truth = np.searchsorted(np.sort(delta), delta, side="right") / len(delta)
    for row in draws:
        weight = 1 / probability[row]
        told = (delta[row][:, None] <= delta[None, :]).T @ weight / weight.sum()
        yield np.abs(told - truth).max()


def rows(arguments, name, path):
    delta, width, weight = values_and_weights(arguments, name, path)
    predicted = predictions(arguments, name, path)
    count = len(weight)
    probability = weight / weight.sum()
    random = np.random.default_rng(1)
    for size in SIZES:
        if 2 * size > count:
            continue
        draws = random.choice(count, (arguments.repetitions, size), p=probability)
        simple = np.argsort(random.random((arguments.repetitions, count)), axis=1)[:, :size]
        for quantity, y in delta.items():
            mean, reach = by_program(y, predicted[quantity], probability, draws)
            of_draws, _ = by_draws(y, probability, draws)
            far = np.array(list(distances(y, width[quantity], draws[:300])))
            weighted = list(weighted_distances(y, probability, draws[:300]))
            band = arguments.band[0] + arguments.band[1] / np.sqrt(size)
            yield [name, count, quantity, size,
                   f"{np.sqrt(np.mean((y[simple].mean(axis=1) - y.mean()) ** 2)) / y.mean():.4f}",
                   f"{np.sqrt(np.mean((of_draws - y.mean()) ** 2)) / y.mean():.4f}",
                   f"{np.sqrt(np.mean((mean - y.mean()) ** 2)) / y.mean():.4f}",
                   f"{100 * np.mean(np.abs(mean - y.mean()) <= reach):.1f}", f"{reach.mean() / y.mean():.4f}",
                   f"{band:.3f}", f"{np.quantile(far, 0.95):.3f}", f"{100 * np.mean(far <= band):.1f}",
                   f"{np.quantile(weighted, 0.95):.3f}"]


def predictions(arguments, name, path):
    file_name = arguments.folder / f"{name}.predicted.h5"
    if not file_name.exists():
        run(arguments.indet, "analyze", path, "--accuracy", "estimate", "--calibrate", 0, "-o", file_name)
    with h5py.File(file_name) as file:
        # Of forces that are the same in every state there is no prediction, but a proof.
        return {q: np.nan_to_num(file[f"ranges/{q}_estimate"][()]) for q in ("delta_R", "delta_T")}


def by_draws(y, probability, draws):
    """Means of each row of draws, half-widths of their intervals."""
    z = (y / (len(y) * probability))[draws]
    size = draws.shape[1]
    return z.mean(axis=1), student.ppf(0.975, size - 1) * z.std(axis=1, ddof=1) / np.sqrt(size)


def by_regression(y, x, probability, draws):
    """The same where z is regressed on x/(M p)."""
    size = draws.shape[1]
    z = (y / (len(y) * probability))[draws]
    away = (x / (len(x) * probability))[draws]
    middle = away.mean(axis=1, keepdims=True)
    away = away - middle
    squares = np.maximum((away**2).sum(axis=1, keepdims=True), 1e-300)
    slope = (away * z).sum(axis=1, keepdims=True) / squares
    missing = x.mean() - middle
    residual = z - z.mean(axis=1, keepdims=True) - slope * away
    leverage = 1 / size + away**2 / squares
    share = 1 / size + missing * away / squares
    error = np.sqrt(((share * residual / (1 - leverage)) ** 2).sum(axis=1))
    return z.mean(axis=1) + (slope * missing)[:, 0], student.ppf(0.975, size - 2) * error


def by_program(y, x, probability, draws):
    """What the program does."""
    if draws.shape[1] < FEWEST_FOR_REGRESSION:
        return by_draws(y, probability, draws)
    return by_regression(y, x, probability, draws)


def systematic(probability, order, size, repetitions, random):
    """Contacts in the order of the list, [repetitions, size], and the probabilities with which each contact is among them."""
    included = np.minimum(1, size * probability)
    for _ in range(100):  # what would be drawn more than once is drawn for certain
        certain = included >= 1
        included = np.where(certain, 1, (size - certain.sum()) * probability / probability[~certain].sum())
        if included.max() <= 1:
            break
    up_to = np.cumsum(included[order])
    at = random.random((repetitions, 1)) + np.arange(size)
    return order[np.minimum(np.searchsorted(up_to, at, side="right"), len(order) - 1)], included


def by_systematic(y, included, chosen):
    """Horvitz and Thompson's mean, and half-widths from differences of neighbours in the list."""
    count, size = len(y), chosen.shape[1]
    each = y[chosen] / included[chosen] / count
    free = 1 - included[chosen]
    between = np.sqrt(free[:, 1:] * free[:, :-1]) * np.diff(each, axis=1) ** 2
    error = np.sqrt(size / (2 * (size - 1)) * between.sum(axis=1))
    return each.sum(axis=1), student.ppf(0.975, size - 1) * error


def rule_rows(arguments, name, path):
    delta, width, weight = values_and_weights(arguments, name, path)
    predicted = predictions(arguments, name, path)
    count = len(weight)
    random = np.random.default_rng(1)
    relative = {q: w / w.mean() for q, w in width.items()}
    own = weight / weight.sum()
    by_R = 0.02 + relative["delta_R"]
    by_both = 0.02 + sum(v / v.mean() for v in predicted.values())
    by_R, by_both = by_R / by_R.sum(), by_both / by_both.sum()
    order = np.argsort(np.arctan2(relative["delta_T"], relative["delta_R"]))
    for size in RULE_SIZES:
        if size > count:
            continue
        draws, draws_R, draws_both = (random.choice(count, (arguments.repetitions, size), p=p) for p in (own, by_R, by_both))
        chosen, included = systematic(own, order, size, arguments.repetitions, random)
        for q, y in delta.items():
            results = [by_draws(y, own, draws), by_draws(y, by_R, draws_R), by_draws(y, by_both, draws_both),
                       by_systematic(y, included, chosen), by_regression(y, width[q], own, draws),
                       by_regression(y, predicted[q], own, draws), by_regression(y, predicted[q], by_both, draws_both)]
            simple = np.sqrt(y.var(ddof=1) * (1 / size - 1 / count)) / y.mean()
            variance = own @ (y / (count * own) - y.mean()) ** 2
            row = [name, count, q, size, f"{np.corrcoef(width[q], y)[0, 1]:.3f}", f"{y.var() / variance:.2f}", f"{simple:.4f}"]
            for mean, reach in results:
                error = np.sqrt(np.mean((mean - y.mean()) ** 2)) / y.mean()
                row += [f"{error:.4f}", f"{100 * np.mean(np.abs(mean - y.mean()) <= reach):.1f}"]
            yield row


def check(arguments, name, path):
    delta, width, _ = values_and_weights(arguments, name, path)
    predicted = predictions(arguments, name, path)
    weight = 2 + np.round(100 * sum(w / w.mean() for w in width.values()))
    worst = 0
    covers = {q: 0 for q in delta}
    for seed in range(1, arguments.check + 1):
        out = arguments.folder / "check.h5"
        run(arguments.indet, "analyze", path, "--method", "barrier", "--gap", "1e-3", "--contacts", "sample:20", "--seed", seed, "-o",
            out, "--overwrite")
        with h5py.File(out) as file:
            if not (file["ranges/draw_weight"][()] == weight).all():
                raise RuntimeError(f"{name}: other probabilities than those of the widths")
            draws = np.repeat(np.arange(len(weight)), file["ranges/drawn"][()])[None, :]
            for q, y in delta.items():
                mean, reach = (v[0] for v in by_program(y, predicted[q], weight / weight.sum(), draws))
                stored = file["ranges"].attrs[f"mean_{q}"]
                worst = max(worst, np.abs(stored - [mean, mean - reach, mean + reach]).max() / y.mean())
                covers[q] += stored[1] <= y.mean() <= stored[2]
    print(f"{name}: {arguments.check} seeds, means and intervals differ by at most {worst:.1e} of the mean; intervals that cover",
          *(f"{q} {n}" for q, n in covers.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default="build/release")
    parser.add_argument("--folder", type=pathlib.Path, default="draws")
    parser.add_argument("--disks", type=int, nargs="*", default=[95, 400, 800, 1600])
    parser.add_argument("--protocols", nargs="*", default=["md1"])
    parser.add_argument("--seeds", type=int, nargs="*", default=[11, 12, 13])
    parser.add_argument("--packings", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--repetitions", type=int, default=2000)
    parser.add_argument("--band", type=float, nargs=2, default=[0.15, 0.2], help="kBandBias, kBandNoise")
    parser.add_argument("--rules", action="store_true", help="compare rules and estimators")
    parser.add_argument("--check", type=int, default=0, metavar="SEEDS", help="compare with the program's own samples")
    parser.add_argument("--out", type=pathlib.Path, default="draws.tsv")
    arguments = parser.parse_args()
    arguments.indet = arguments.build / "indet"
    arguments.folder.mkdir(parents=True, exist_ok=True)
    columns, rows_of = (RULE_COLUMNS, rule_rows) if arguments.rules else (COLUMNS, rows)
    if arguments.check:
        for name, path in packings(arguments):
            check(arguments, name, path)
        return
    with arguments.out.open("w") as out:
        print(*columns, sep="\t", file=out)
        for name, path in packings(arguments):
            for row in rows_of(arguments, name, path):
                print(*row, sep="\t", file=out, flush=True)


if __name__ == "__main__":
    main()
