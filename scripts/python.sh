#!/usr/bin/env bash
# Tests the Python package, normally and under python -X dev, and its types; installs first what is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

. scripts/python-package.sh

top=$PWD
(cd python && "$python" -m mypy --cache-dir "$top/$home/mypy" tests/typed.py)
cd "$home" # where no other ffsm_ipopt is
for mode in "" "-X dev"; do
  # shellcheck disable=SC2086 # an option and its value
  "$python" $mode -m pytest --config-file "$top/python/pyproject.toml" --rootdir "$top/python" \
    "$top/python/tests" "$@"
done
