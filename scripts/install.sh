#!/usr/bin/env bash
# Installs the Debian packages the build needs and this machine lacks (none the second time); sourced by demo.sh and test.sh.
set -euo pipefail

die() {
  echo "error: $*" >&2
  exit 1
}

# A C program compiles and links.
have_cc() (
  dir=$(mktemp -d)
  trap 'rm -rf "$dir"' EXIT
  printf '#include <stdio.h>\nint main(void) { return 0; }\n' >"$dir/probe.c"
  cc "$dir/probe.c" -o "$dir/probe" >/dev/null 2>&1
)

# A libclang library is where bindgen's clang-sys looks for it, and clang's own C headers are installed too.
have_libclang() (
  shopt -s nullglob
  IFS=:
  if [ -n "${LIBCLANG_PATH:-}" ]; then
    dirs=("$LIBCLANG_PATH" "${LIBCLANG_PATH%/*}")
  else
    llvm=$("${LLVM_CONFIG_PATH:-llvm-config}" --prefix 2>/dev/null)
    # shellcheck disable=SC2206 # the two lists are meant to be split
    dirs=("$llvm"/lib* ${LD_LIBRARY_PATH:-} ${LIBRARY_PATH:-}
      /usr/local/{llvm*/lib*,lib*/*/*,lib*/*,lib*} /usr/{lib*/*/*,lib*/*,lib*})
  fi
  for dir in "${dirs[@]}"; do
    for lib in "$dir"/libclang{.so,-*.so,.so.*,-*.so.*}; do
      [[ -e $lib && $lib != *-cpp.* ]] || continue
      lib=$(readlink -f "$lib")
      headers=({"${lib%/*}",/usr/lib*,/usr/lib*/llvm*/lib*,/usr/local/lib*}/clang/*/include/stddef.h)
      [ ${#headers[@]} = 0 ] || exit 0
    done
  done
  exit 1
)

# Cargo finds certificates to reach the crate registry with.
have_certificates() {
  local file
  for file in "${CARGO_HTTP_CAINFO:-}" "${SSL_CERT_FILE:-}" /etc/ssl/certs/ca-certificates.crt \
    /etc/ssl/cert.pem /etc/ssl/ca-bundle.pem /etc/pki/tls/certs/ca-bundle.crt; do
    [ ! -s "$file" ] || return 0
  done
  return 1
}

check_cargo() {
  local need have
  need=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' "$(dirname "${BASH_SOURCE[0]}")/../Cargo.toml" | head -n 1)
  command -v cargo >/dev/null || PATH="${CARGO_HOME:-$HOME/.cargo}/bin:$PATH"
  command -v cargo >/dev/null ||
    die "cargo not found: get Rust $need or newer from https://rustup.rs, then run this again"
  have=$(cargo --version | cut -d' ' -f2)
  [ "$(printf '%s\n' "$need" "$have" | sort -V | head -n 1)" = "$need" ] ||
    die "cargo $have is too old: Rust $need or newer is needed (rustup update stable, or https://rustup.rs)"
}

# Sets `first` and `missing` to the packages that stand for what the probes do not find; fails where there are none.
find_missing() {
  first=()
  missing=()
  have_certificates || first+=(ca-certificates)
  have_cc || first+=(gcc libc6-dev)
  command -v "${PKG_CONFIG:-pkg-config}" >/dev/null || missing+=(pkg-config)
  "${PKG_CONFIG:-pkg-config}" --exists "ipopt >= 3.11" 2>/dev/null || missing+=(coinor-libipopt-dev)
  have_libclang || missing+=(libclang-dev)
  [ $((${#first[@]} + ${#missing[@]})) != 0 ]
}

# Starts to build what needs no more than certificates and a linker: most of the dependencies. Where it comes to the
# bindings before Ipopt is there, it fails without a word; the build that follows waits for it and goes on from there.
build_meanwhile() {
  (
    trap - INT # which background jobs of a script ignore
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    exec cargo build --release --locked --keep-going --bin ffsm-ipopt \
      2> >(exec grep --line-buffered -E '^ *(Downloaded|Compiling)' >&2)
  ) </dev/null &
  building=$!
}

install_missing() {
  local sudo=() apt log building=
  command -v apt-get >/dev/null ||
    die "needed here, by their Debian package names: ${first[*]} ${missing[*]} (no apt-get to install them with)"
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null ||
      die "not root and no sudo: as root, run apt-get install --no-install-recommends ${first[*]} ${missing[*]}"
    sudo=(sudo)
  fi
  echo "Installing Debian packages: ${first[*]} ${missing[*]}"
  log=$(mktemp)
  apt=("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
  # An unrelated source that cannot be read fails the update, so only the installs decide.
  "${apt[@]}" update </dev/null >"$log" 2>&1 || true
  install_packages "${first[@]}"
  [ ${#missing[@]} = 0 ] || build_meanwhile
  install_packages "${missing[@]}"
  ! find_missing || die "installed, but still not found: ${first[*]} ${missing[*]}; the log is $log"
  rm -f "$log"
}

install_packages() {
  [ $# != 0 ] || return 0
  "${apt[@]}" install -y --no-install-recommends "$@" </dev/null >>"$log" 2>&1 && return
  tail -n 25 "$log" >&2
  [ -z "$building" ] || kill "$building" 2>/dev/null || true
  die "apt-get could not install them; the whole log is $log"
}

check_cargo
! find_missing || install_missing
