#!/usr/bin/env bash
# Times one collocation point of the seven-joint chaser beside code that CasADi generates for it.
#
# CasADi comes from PyPI to target/casadi/venv; compiling its code takes many minutes, once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

home=target/casadi
if ! [ -x "$home/venv/bin/python" ]; then
  mkdir -p "$home"
  python3 -m venv "$home/venv"
  "$home/venv/bin/pip" install --quiet --disable-pip-version-check casadi==3.8.2 numpy
fi
problem=config/chaser-7dof.toml
cargo bench --locked --quiet --bench node --no-run
PYTHONDONTWRITEBYTECODE=1 "$home/venv/bin/python" benches/casadi/node.py "$problem" "$home/code" \
  cargo bench --locked --quiet --bench node -- --point "$problem"
