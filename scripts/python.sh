#!/usr/bin/env bash
# Tests the Python package, normally and under python -X dev, and its types; installs first what is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

. scripts/python-venv.sh

# The command writes the solutions that those of the package are held against. The test is there for its
# dependencies alone: with them the selection of features is that of cargo test, and nothing is built twice.
cargo build --release --locked --workspace --lib --bins --test public_types
built=${CARGO_TARGET_DIR:-target}/release
package=$home/package
rm -rf "$package"
mkdir -p "$package"
cp -R python/ffsm_ipopt "$package/"
cp "$built/libffsm_ipopt_native.so" "$package/ffsm_ipopt/_native.abi3.so"

export PYTHONPATH=$PWD/$package PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=agg MPLCONFIGDIR=$PWD/$home/matplotlib
FFSM_IPOPT=$(realpath "$built/ffsm-ipopt")
export FFSM_IPOPT
top=$PWD
(cd python && "$python" -m mypy --cache-dir "$top/$home/mypy" tests/typed.py)
cd "$home" # where no other ffsm_ipopt is
for mode in "" "-X dev"; do
  # shellcheck disable=SC2086 # an option and its value
  "$python" $mode -m pytest --config-file "$top/python/pyproject.toml" --rootdir "$top/python" \
    "$top/python/tests" "$@"
done
