#!/usr/bin/env python3
"""What contacts that are drawn by their widths tell of all, beside contacts that are equally likely.

    bench/draws/draws.py [--build build/release] [--folder DIR] [--disks 95 400 800] [--protocols md1] [--seeds 11 12 13]
                         [--packings R.h5 ...] [--repetitions 2000] [--out draws.tsv]

Packings are made in DIR, or taken as they are (--packings: any file with contacts), and analyzed with --method barrier: all
values once, and a sample once, whose file has the weights and widths. From these the draws are repeated here. A row is a
packing, a quantity and a number of draws K: the error (root mean square, over the mean) of the mean of equally likely contacts
and of drawn ones, the percentage of repetitions whose interval covers the mean, the mean half-width of that interval over the
mean, the band of the distribution function, the largest distance of that function in 95 of 100 repetitions and the percentage
that the band covers (both over 400 values of v, and 300 repetitions), and the largest distance of the distribution of the
drawn values themselves, weighted by 1/p.
"""
import argparse
import pathlib
import subprocess

import h5py
import numpy as np
from scipy.stats import t as student

COLUMNS = ["packing", "contacts", "quantity", "draws", "simple_error", "error", "interval_covers", "half_width", "band",
           "distance_95", "band_covers", "weighted_distance_95"]
SIZES = [6, 10, 20, 40, 80, 160]


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
        run(arguments.indet, "analyze", path, "--method", "barrier", "-o", every)
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
    count = len(weight)
    probability = weight / weight.sum()
    random = np.random.default_rng(1)
    for size in SIZES:
        if 2 * size > count:
            continue
        draws = random.choice(count, (arguments.repetitions, size), p=probability)
        simple = np.argsort(random.random((arguments.repetitions, count)), axis=1)[:, :size]
        for quantity, y in delta.items():
            z = y[draws] / (count * probability[draws])
            mean = z.mean(axis=1)
            reach = student.ppf(0.975, size - 1) * z.std(axis=1, ddof=1) / np.sqrt(size)
            far = np.array(list(distances(y, width[quantity], draws[:300])))
            weighted = list(weighted_distances(y, probability, draws[:300]))
            band = arguments.band[0] + arguments.band[1] / np.sqrt(size)
            yield [name, count, quantity, size,
                   f"{np.sqrt(np.mean((y[simple].mean(axis=1) - y.mean()) ** 2)) / y.mean():.4f}",
                   f"{np.sqrt(np.mean((mean - y.mean()) ** 2)) / y.mean():.4f}",
                   f"{100 * np.mean(np.abs(mean - y.mean()) <= reach):.1f}", f"{reach.mean() / y.mean():.4f}",
                   f"{band:.3f}", f"{np.quantile(far, 0.95):.3f}", f"{100 * np.mean(far <= band):.1f}",
                   f"{np.quantile(weighted, 0.95):.3f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default="build/release")
    parser.add_argument("--folder", type=pathlib.Path, default="draws")
    parser.add_argument("--disks", type=int, nargs="*", default=[95, 400, 800])
    parser.add_argument("--protocols", nargs="*", default=["md1"])
    parser.add_argument("--seeds", type=int, nargs="*", default=[11, 12, 13])
    parser.add_argument("--packings", type=pathlib.Path, nargs="*", default=[])
    parser.add_argument("--repetitions", type=int, default=2000)
    parser.add_argument("--band", type=float, nargs=2, default=[0.15, 0.2], help="kBandBias, kBandNoise")
    parser.add_argument("--out", type=pathlib.Path, default="draws.tsv")
    arguments = parser.parse_args()
    arguments.indet = arguments.build / "indet"
    arguments.folder.mkdir(parents=True, exist_ok=True)
    with arguments.out.open("w") as out:
        print(*COLUMNS, sep="\t", file=out)
        for name, path in packings(arguments):
            for row in rows(arguments, name, path):
                print(*row, sep="\t", file=out, flush=True)


if __name__ == "__main__":
    main()
