#!/usr/bin/env bash
# Computes the paper's tables, figures and claims again and writes docs/reproduction.md from them, installing first what is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

out=out/reproduction
cargo build --release --locked --bin ffsm-ipopt
cargo run --release --locked --quiet --bin ffsm-ipopt -- reproduce --out "$out"
mkdir -p docs/figures
cp "$out/reproduction.md" docs/
cp "$out"/figures/*.svg docs/figures/

echo
echo "Look at:"
echo "  docs/reproduction.md  what of the paper holds, claim by claim"
echo "  $out/                 the same with its data, and every figure as SVG and PNG"
