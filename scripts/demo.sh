#!/usr/bin/env bash
# Plans the trajectory of config/table1-relaxed.toml by A-RPM to 1e-5 and prints the result, installing first what is missing;
# then one of an arm with joints to spare, which keeps its base still.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

out=out/table1-relaxed
cargo build --release --locked --bin ffsm-ipopt
cargo run --release --locked --quiet --bin ffsm-ipopt -- plan config/table1-relaxed.toml --out "$out"

still=out/still-base
cargo run --release --locked --quiet --bin ffsm-ipopt -- plan config/still-base.toml --out "$still" --quiet

echo
echo "Look at:"
echo "  $out/report.html      the motion played back, charts, why to trust it: open it in a browser"
echo "  $still/report.html          seven joints reach a point: the base keeps still"
echo "  $out/solution.json    the solution and how it was reached"
echo "  $out/trajectory.csv   the trajectory over time, for plotting"
