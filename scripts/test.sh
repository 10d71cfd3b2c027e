#!/usr/bin/env bash
# Runs every test in release, installing first what is missing; arguments go on to cargo test.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

exec cargo test --release --locked --workspace "$@"
