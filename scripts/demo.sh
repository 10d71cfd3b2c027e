#!/usr/bin/env bash
# Plans the trajectory of config/table1-relaxed.toml by A-RPM to 1e-5 and prints the result, installing first what is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

out=out/table1-relaxed
cargo build --release --locked --bin ffsm-ipopt
cargo run --release --locked --quiet --bin ffsm-ipopt -- plan config/table1-relaxed.toml --out "$out"

echo
echo "Look at:"
echo "  $out/solution.json    the solution and how it was reached"
echo "  $out/trajectory.csv   the trajectory over time, for plotting"
