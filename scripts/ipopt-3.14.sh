#!/usr/bin/env bash
# Runs the test suite against Ipopt 3.14, where the system has an older one.
#
# The CasADi wheel on PyPI carries a shared Ipopt 3.14 with MUMPS, and its headers. They go to
# target/ipopt-3.14, which a second run uses again; delete it to fetch them anew.
#
#     scripts/ipopt-3.14.sh [arguments of cargo test]
set -euo pipefail

wheel=casadi==3.8.2

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
home=$root/target/ipopt-3.14
library=$home/wheel/casadi

if [ ! -f "$home/ipopt.pc" ]; then
    rm -rf "$home/wheel" "$home/download"
    mkdir -p "$home/download"
    python3 -m pip download --quiet --no-deps --only-binary :all: --dest "$home/download" "$wheel"
    python3 -m zipfile -e "$home"/download/casadi-*.whl "$home/wheel"
    rm -rf "$home/download"

    header=$library/include/coin-or/IpoptConfig.h
    version=$(sed -n 's/^#define IPOPT_VERSION "\(.*\)"/\1/p' "$header")
    case $version in
    3.14.*) ;;
    *)
        echo "$wheel has Ipopt '$version', not 3.14: name another version in $0" >&2
        exit 1
        ;;
    esac
    # A directory of its own, so that the linker sees none of the wheel's other libraries.
    mkdir -p "$home/lib"
    ln -sf ../wheel/casadi/libipopt.so.3 "$home/lib/libipopt.so"
    # Last, because its presence says that all the rest is there.
    cat >"$home/ipopt.pc.new" <<EOF
Name: Ipopt
Description: Interior point optimiser, from $wheel
Version: $version
Cflags: -I\${pcfiledir}/wheel/casadi/include/coin-or
Libs: -L\${pcfiledir}/lib -lipopt
EOF
    mv "$home/ipopt.pc.new" "$home/ipopt.pc"
fi

export PKG_CONFIG_PATH=$home${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
export LD_LIBRARY_PATH=$library${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
# The linker follows libipopt's own needs within the wheel.
export RUSTFLAGS="${RUSTFLAGS:-} -C link-arg=-Wl,-rpath-link,$library"
export CARGO_TARGET_DIR=$home/build

echo "Ipopt $(pkg-config --modversion ipopt), from $wheel"
cd "$root"
cargo test --release --locked "$@"
