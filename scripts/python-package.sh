#!/usr/bin/env bash
# Builds program and Python package, and makes the virtual environment of the package's tests, in target/python;
# sourced by python.sh and slurm-check.sh after install.sh. Sets `home`, and `python` of that environment; the package
# is on PYTHONPATH, the program in FFSM_IPOPT. FFSM_BUILT names a folder that cargo built to before, to be used as it is.
# shellcheck disable=SC2034 # what is set is for others
set -euo pipefail

home=target/python
requirements=python/tests/requirements.txt # for Python 3.11 and newer

# A Python of 3.11 or newer, as the tests need, that makes virtual environments.
have_python() {
  python3 -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' 2>/dev/null
}
if ! have_python; then
  missing=(python3-venv)
  find_missing() {
    missing=()
    have_python || missing=(python3-venv)
  }
  install_missing
fi

if ! cmp -s "$requirements" "$home/installed.txt"; then
  rm -rf "$home"
  mkdir -p "$home"
  python3 -m venv "$home/venv"
  "$home/venv/bin/pip" install --quiet --disable-pip-version-check -r "$requirements"
  # Last, because it says that all the rest is there.
  cp "$requirements" "$home/installed.txt"
fi
python=$PWD/$home/venv/bin/python

# The command writes the solutions that those of the package are held against. The test is there for its
# dependencies alone: with them the selection of features is that of cargo test, and nothing is built twice.
built=${FFSM_BUILT:-}
if [ -z "$built" ]; then
  cargo build --release --locked --workspace --lib --bins --test public_types
  built=${CARGO_TARGET_DIR:-target}/release
fi
package=$home/package
rm -rf "$package"
mkdir -p "$package"
cp -R python/ffsm_ipopt "$package/"
cp "$built/libffsm_ipopt_native.so" "$package/ffsm_ipopt/_native.abi3.so"

export PYTHONPATH=$PWD/$package PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=agg MPLCONFIGDIR=$PWD/$home/matplotlib
FFSM_IPOPT=$(realpath "$built/ffsm-ipopt")
export FFSM_IPOPT
