#!/usr/bin/env python3
"""Whether the three methods agree, and how the paper's walks end, over many packings.

    bench/methods/agreement.py [--build build/release] [--seeds 20] [--json FILE] [P.h5 ...]

Without files, packings are made by contact dynamics (N = 95, one a seed). Each goes through `indet compare`. "Difference" is
the largest of any value that two methods certify, "imprecise" that of values that a method itself marks.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile


def document(*command):
    """What a subcommand prints with --json; status 5 (something is imprecise) counts as done."""
    done = subprocess.run([*command, "--json", "--quiet"], stdout=subprocess.PIPE, text=True)
    if done.returncode not in (0, 5):
        sys.exit(f"{' '.join(map(str, command))}: status {done.returncode}")
    return json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    indet = options.build / "indet"
    reports = []
    with tempfile.TemporaryDirectory() as name:
        for number in range(len(options.files) or options.seeds):
            print(f"\r{number}/{len(options.files) or options.seeds}", end="", file=sys.stderr, flush=True)
            file = options.files[number] if options.files else pathlib.Path(name) / f"cd1-{number}.h5"
            if not options.files:
                document(indet, "simulate", "--protocol", "cd1", "--seed", str(number), "-o", file)
            reports.append(document(indet, "compare", file) | {"packing": file.name})
    print("\r        \r", end="", file=sys.stderr)
    if options.json:
        options.json.write_text(json.dumps(reports, indent=1) + "\n")
    totals = collections.defaultdict(collections.Counter)
    worst = collections.defaultdict(float)
    ends = collections.Counter()
    starts = collections.Counter()
    for report in reports:
        for method in report["methods"]:
            for key in ("objectives", "certified", "imprecise", "failed", "compared", "pivots"):
                totals[method["method"]][key] += method[key]
            totals[method["method"]]["disagreements"] += len(method["disagreements"])
            for key in ("worst_difference", "worst_imprecise_difference"):
                worst[method["method"], key] = max(worst[method["method"], key], method[key])
            if "paper" in method:
                ends.update(method["paper"]["ends"])
                starts.update(method["paper"]["starts"])
                if method["paper"]["failures"] or method["imprecise"]:
                    print(f"{report['packing']}: {method['paper']['failures']} of {method['paper']['walks']} walks fail, "
                          f"{method['imprecise']} values marked imprecise, by {method['worst_imprecise_difference']:.1e} mg at most")
    print(f"\n{len(reports)} packings")
    for method, total in totals.items():
        print(f"{method:<18}{total['objectives']} objectives, {total['certified']} certified, {total['imprecise']} imprecise, "
              f"{total['failed']} failed; {total['compared']} compared with lp, {total['disagreements']} disagree by more than "
              f"{reports[0]['tolerance']:g} mg, difference {worst[method, 'worst_difference']:.1e} mg, "
              f"imprecise {worst[method, 'worst_imprecise_difference']:.1e} mg")
    print("walks:  " + ", ".join(f"{count} {end}" for end, count in ends.items()))
    print("starts: " + ", ".join(f"{count} {start}" for start, count in starts.items()))


if __name__ == "__main__":
    main()
