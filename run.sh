#!/usr/bin/env bash
# Installs what is missing, builds, and runs the main jobs: the force ranges of a packing that LAMMPS made, and the
# ensemble of the paper with its report. Stopped, it goes on where it was.
#   ./run.sh [OUTPUT_FOLDER]            60 seeds, 240 packings (default folder: out)
#   ./run.sh --quick [OUTPUT_FOLDER]    4 seeds, 16 packings
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
seeds=60
if [ "${1:-}" = --quick ]; then
  seeds=4
  shift
fi
out=${1:-out}

cmake/install-packages.sh
[ -f build/release/build.ninja ] || cmake --preset release >/dev/null
echo "== build: compiling indet into $(realpath build/release) (the first time some minutes)"
if [ -t 1 ]; then
  cmake --build --preset release --target indet # with ninja's line of progress
else
  cmake --build --preset release --target indet -- --quiet
fi

indet=build/release/indet
data=tests/data/lammps
mkdir -p "$out"
echo
echo "== import: a packing of 220 disks that LAMMPS made"
"$indet" import --format lammps --atoms $data/atoms.dump --contacts $data/contacts.dump --friction 0.3 -o "$out/lammps.h5"
echo
echo "== analyze: within what limits every contact force can vary"
"$indet" analyze "$out/lammps.h5" -o "$out/lammps.ranges.h5"
echo
echo "== verify: every stored result once more, by other means"
"$indet" verify "$out/lammps.ranges.h5"
"$indet" export "$out/lammps.ranges.h5" --format svg --style delta-R -o "$out/lammps.delta-R.svg" >/dev/null
"$indet" export "$out/lammps.ranges.h5" --format svg --state max-norm -o "$out/lammps.max-norm.svg" >/dev/null
echo
echo "results:  $(realpath "$out/lammps.ranges.h5")"
echo "pictures: $(realpath "$out/lammps.delta-R.svg")  (range of every contact force)"
echo "          $(realpath "$out/lammps.max-norm.svg")  (the extremal state of largest norm)"
echo
echo "== ensemble: the paper's experiment, $((4 * seeds)) packings (stopped, it goes on where it was)"
"$indet" ensemble --seeds $seeds --out "$out/ensemble"
"$indet" report "$out/ensemble"
echo
echo "report:   $(realpath "$out/ensemble/report.html")"
