#!/usr/bin/env bash
# Tests the page report.html in Chromium, over pages of shipped problems that are planned first; installs what is missing.
# FFSM_BUILT names a folder that cargo built to before, to be used as it is; FFSM_CHROMIUM a browser other than Debian's.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

home=target/page
problems=(config/{table1-relaxed,capture,dual-arm,chaser-7dof,tumbling}.toml tests/page/*.toml)

FFSM_CHROMIUM=${FFSM_CHROMIUM:-$(command -v chromium || true)}
if [ -z "$FFSM_CHROMIUM" ]; then
  missing=(chromium)
  find_missing() {
    missing=()
    command -v chromium >/dev/null || missing=(chromium)
  }
  install_missing
  FFSM_CHROMIUM=$(command -v chromium)
fi
if ! command -v npm >/dev/null; then
  missing=(nodejs npm)
  find_missing() {
    missing=()
    command -v npm >/dev/null || missing=(nodejs npm)
  }
  install_missing
fi

mkdir -p "$home"
if ! cmp -s tests/page/package-lock.json "$home/installed.json"; then
  cp tests/page/package.json tests/page/package-lock.json "$home/"
  (cd "$home" && npm ci --no-audit --no-fund --loglevel=error)
  # Last, because it says that all the rest is there.
  cp tests/page/package-lock.json "$home/installed.json"
fi

built=${FFSM_BUILT:-}
if [ -z "$built" ]; then
  cargo build --release --locked --workspace --lib --bins --test public_types
  built=${CARGO_TARGET_DIR:-target}/release
fi
pages=$home/pages
rm -rf "$pages"
for problem in "${problems[@]}"; do
  case $problem in *-robot.toml) continue ;; esac
  "$built/ffsm-ipopt" plan "$problem" --quiet --out "$pages/$(basename "$problem" .toml)"
done
# What other studies found, each with a page of its own or on that of its plan.
"$built/ffsm-ipopt" plan config/table1-smooth.toml --search 6 --quiet --out "$pages/searched"
"$built/ffsm-ipopt" disperse "$pages/chaser-7dof/solution.json" --samples 2000 --quiet --out "$pages/dispersed"
"$built/ffsm-ipopt" pareto config/table1-smooth.toml --points 4 --fill 0 --out "$pages/traded" >"$home/pareto.log"

FFSM_PAGE_HOME=$PWD/$home FFSM_PAGES=$PWD/$pages FFSM_CHROMIUM=$FFSM_CHROMIUM \
  node --test --test-concurrency=1 "$@" tests/page/*.test.mjs
