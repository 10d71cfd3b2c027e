#!/usr/bin/env bash
# Runs every test in release, installing first what is missing; arguments go on to cargo test, which then runs alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

cargo test --release --locked --workspace "$@"
[ $# != 0 ] || scripts/python.sh
