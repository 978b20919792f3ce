#!/usr/bin/python3
"""The comparison with the paper, with other choices of what the paper leaves open, as the table that the report tells.

usage: bench/paper_choices.py [path of indet] [number of seeds] [folder to keep the ensembles in]

Writes docs/measurements/paper-choices.tsv. Each choice is an ensemble of its own, all else being the default.
"""
import csv
import datetime
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).parent.parent
TABLE = ROOT / "docs/measurements/paper-choices.tsv"
CHOICES = (  # name, arguments of indet ensemble, scene
    ("as by default", [], {}),
    ("MD: k = 1.2e6 (preset paper-overlap)", ["--preset", "paper-overlap"], {}),
    ("MD: k = 1.2e6, damping 558 (preset stiff)", ["--preset", "stiff"], {}),
    ("CD: alpha = 0.1", ["--alpha", "0.1"], {}),
    ("CD-2: first step of 100 sweeps", ["--start-sweeps", "100"], {}),
    ("CD-2: first step of 300 sweeps", ["--start-sweeps", "300"], {}),
    ("CD-2: first step of 1000 sweeps", ["--start-sweeps", "1000"], {}),
    ("CD-2: first step of 3000 sweeps", ["--start-sweeps", "3000"], {}),
    ("box 10 r_max wide", [], {"width": 10}),
    ("box 12 r_max wide", [], {"width": 12}),
)


def main():
    indet = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release/indet").resolve())
    seeds = sys.argv[2] if len(sys.argv) > 2 else "20"
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for number, (name, arguments, scene) in enumerate(CHOICES):
            if scene:
                file = folder / f"{number}.toml"
                file.write_text("".join(f"{key} = {value}\n" for key, value in scene.items()))
                arguments = [*arguments, "--scene", str(file)]
            out = str(folder / str(number))
            subprocess.run([indet, "ensemble", "--seeds", seeds, "--uniform-seeds", "0", *arguments, "--out", out], check=True)
            subprocess.run([indet, "report", out], check=True)
            with open(pathlib.Path(out) / "figures/comparison.csv", newline="", encoding="utf-8") as table:
                rows += [(name, row["quantity"], row["here"], row["verdict"]) for row in csv.DictReader(table)]
            TABLE.write_text(f"# bench/paper_choices.py build/release/indet {seeds}, {datetime.date.today()}: {seeds} seeds a choice\n"
                             "choice\tquantity\there\tverdict\n" + "".join("\t".join(row) + "\n" for row in rows), encoding="utf-8")


main()
