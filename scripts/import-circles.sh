#!/usr/bin/env bash
# Prints the circles of files that import each other, re-exports resolved.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

exec cargo test --quiet --release --locked --test import_circles no_circles -- --nocapture
