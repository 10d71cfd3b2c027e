#!/usr/bin/env bash
# Our linear solver against MUMPS on the systems of whole solves, in turns in one process.
#
# Needs MUMPS's headers: apt-get install libmumps-seq-dev. The program itself does not.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
home=$root/target/bench
mkdir -p "$home"
cd "$root"

if ! echo '#include "dmumps_c.h"' | cc -E -I/usr/include/mumps_seq -x c - >/dev/null 2>&1; then
    echo "bench-kkt: no dmumps_c.h; apt-get install libmumps-seq-dev" >&2
    exit 1
fi
cc -O2 -shared -fPIC -I/usr/include/mumps_seq -o "$home/libmumps_shim.so" benches/mumps.c -ldmumps_seq
FFSM_MUMPS_SHIM=$home/libmumps_shim.so cargo bench --locked --bench kkt -- "$@"
