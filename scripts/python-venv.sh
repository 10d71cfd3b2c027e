#!/usr/bin/env bash
# Makes the virtual environment of the Python tests in target/python, once for each list of packages, and sets `home`
# and `python`; sourced by python.sh and slurm-check.sh after install.sh.
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
# shellcheck disable=SC2034 # for who sources this
python=$PWD/$home/venv/bin/python
