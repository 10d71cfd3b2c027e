#!/usr/bin/env bash
# Tests the Python package, normally and under python -X dev, and its types; installs first what is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

. scripts/python-package.sh

top=$PWD
(cd python && "$python" -m mypy --cache-dir "$top/$home/mypy" tests/typed.py)
cd "$home" # where no other ffsm_ipopt is
pytest=(-m pytest --config-file "$top/python/pyproject.toml" --rootdir "$top/python" "$top/python/tests" "$@")
# Both at the same time, each on one core for most of it; the second is printed when it is done.
"$python" -X dev "${pytest[@]}" >dev-mode.log 2>&1 &
trap 'kill $! 2>/dev/null || true' EXIT
"$python" "${pytest[@]}"
passed=0
wait $! || passed=$?
cat dev-mode.log
exit $passed
