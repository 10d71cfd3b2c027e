#!/usr/bin/env bash
# Holds planned motion and the golden values of the tests against Pinocchio, SPART and MuJoCo from PyPI.
#
# A dispersion is held against replays by Pinocchio as well.
#
# They go to target/oracle/venv, which a second run uses again; the plans to target/oracle/out.
#
#     scripts/oracle.sh           one table, exit status 1 where anything differs
#     scripts/oracle.sh --write   writes tests/data/golden.json anew first
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

problems=(
  config/table1-smooth.toml
  config/table1-relaxed.toml
  config/planar-3link.toml
  config/capture.toml
  config/chaser-7dof.toml
  config/dual-arm.toml
  tests/data/odd-tree.toml
)

home=target/oracle
requirements=tests/oracle/requirements.txt
golden=tests/data/golden.json

write=()
case ${1-} in
  '') ;;
  --write) write=(--write) ;;
  *) die "usage: scripts/oracle.sh [--write]" ;;
esac

if ! cmp -s "$requirements" "$home/installed.txt"; then
  python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || die "needs Python 3.11 or newer"
  rm -rf "$home/venv"
  mkdir -p "$home"
  python3 -m venv "$home/venv" || die "python3 cannot make a virtual environment: apt-get install python3-venv"
  "$home/venv/bin/pip" install --quiet --disable-pip-version-check -r "$requirements"
  # Last, because it says that all the rest is there.
  cp "$requirements" "$home/installed.txt"
fi
python() {
  PYTHONDONTWRITEBYTECODE=1 "$home/venv/bin/python" "$@"
}

cargo build --release --locked --bin ffsm-ipopt
solutions=()
for problem in "${problems[@]}"; do
  name=$(basename "$problem" .toml)
  cargo run --release --locked --quiet --bin ffsm-ipopt -- \
    plan "$problem" --quiet --out "$home/out/$name" || die "$problem could not be planned"
  solutions+=("$home/out/$name/solution.json")
done

status=0
[ ${#write[@]} = 0 ] || python tests/oracle/golden.py "$golden" "${write[@]}"
python tests/oracle/golden.py "$golden" || status=1
python tests/oracle/compare.py "${solutions[@]}" || status=1

# A plan under perturbations, by random numbers of both sides.
name=chaser-7dof-heavy
ours() {
  cargo run --release --locked --quiet --bin ffsm-ipopt -- "$@" || die "$name could not be dispersed"
}
ours plan "config/$name.toml" --quiet --out "$home/out/$name"
ours disperse "$home/out/$name/solution.json" --quiet --samples 20000 --seed 1 --out "$home/out/$name"
python tests/oracle/disperse.py "$home/out/$name/solution.json" "$home/out/$name/dispersion.json" || status=1
exit $status
