#!/usr/bin/env bash
# Times the program against CasADi, yapss, maptor and mpopt from PyPI on the same problems.
#
# They go to target/bench/venv, which a second run uses again; the tables to out/bench/bench.{md,json}.
# The C code that CasADi generates goes to target/bench/compiled; that of the arm in space takes gcc
# some three minutes the first time.
#
#     scripts/bench.sh            everything, about fifteen minutes
#     scripts/bench.sh --quick    fewer runs, without maptor: about three
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

home=target/bench
command -v gcc > /dev/null || die "needs gcc, which compiles the code that CasADi generates"
requirements=benches/peers/requirements.txt

case ${1-} in
  '' | --quick) ;;
  *) die "usage: scripts/bench.sh [--quick]" ;;
esac

if ! cmp -s "$requirements" "$home/installed.txt"; then
  python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || die "needs Python 3.11 or newer"
  rm -rf "$home/venv"
  mkdir -p "$home"
  python3 -m venv "$home/venv" || die "python3 cannot make a virtual environment: apt-get install python3-venv"
  pip=("$home/venv/bin/pip" --disable-pip-version-check install --quiet)
  "${pip[@]}" -r "$requirements"
  # It asks for a numpy that has no wheels any more, and works with the one above.
  "${pip[@]}" --no-deps mpopt==0.2.2
  # Last, because it says that all the rest is there.
  cp "$requirements" "$home/installed.txt"
fi

cargo build --release --locked --bin ffsm-ipopt \
  --example time_in_process --example known_optima_bench
program=$(cargo metadata --format-version 1 --no-deps --locked |
  python3 -c 'import json, sys; print(json.load(sys.stdin)["target_directory"])')/release/ffsm-ipopt
# One thread of the peers' BLAS: their fronts are too small for more.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
MPLBACKEND=Agg PYTHONDONTWRITEBYTECODE=1 "$home/venv/bin/python" -W ignore \
  benches/peers/bench.py "$program" out/bench "$@"
