#!/usr/bin/env bash
# Proves that demo.sh, test.sh and reproduction.sh run on a Debian 12 that has only Rust added, and install nothing the second time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage="usage: scripts/fresh-debian.sh [--worktree] [demo|test|reproduction|all]
  --worktree  take the work tree, uncommitted changes and all, instead of HEAD
Makes target/fresh-debian (about 3 GB, removed when all is well); needs root and debootstrap."

die() {
  echo "error: $*" >&2
  exit 1
}

from=HEAD
scripts=(demo test)
for arg; do
  case $arg in
    --worktree) from=worktree ;;
    demo | test | reproduction) scripts=("$arg") ;;
    all) scripts=(demo test reproduction) ;;
    -h | --help) echo "$usage" && exit ;;
    *) die "$usage" ;;
  esac
done

PATH=$PATH:/usr/sbin:/sbin # where debootstrap and chroot are
[ "$(id -u)" = 0 ] || die "making and entering a Debian root needs root"
for tool in debootstrap unshare git rustc; do
  command -v "$tool" >/dev/null || die "$tool not found (debootstrap: apt-get install debootstrap)"
done
sysroot=$(rustc --print sysroot)
[[ -x $sysroot/bin/cargo && $sysroot != /usr ]] || die "needs a Rust toolchain in a folder of its own (rustup)"

# The mounts made below live in a name space of this process and go when it ends, however it ends.
[ -n "${FRESH_DEBIAN:-}" ] ||
  FRESH_DEBIAN=1 exec unshare --mount --propagation private "$BASH" scripts/fresh-debian.sh "$@"

top=$PWD/target/fresh-debian
base=$top/base
home=/home/newcomer # inside the new Debian
rm -rf --one-file-system "$top"
mkdir -p "$base"
trap '[ $? = 0 ] || echo "failed; the Debian root is left in $top" >&2' EXIT

make_base() {
  local sources mirror file
  # This machine's Debian mirrors, in sources.list form; debootstrap's own default without them.
  # shellcheck disable=SC2016 # apt expands these
  sources=$(apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' 2>/dev/null | grep ' bookworm' || true)
  mirror=$(sed -n 's/^deb \(.*\) bookworm main$/\1/p' <<<"$sources" | sed -n 1p)
  debootstrap --variant=minbase bookworm "$base" ${mirror:+"$mirror"} >"$top/debootstrap.log" 2>&1 || {
    tail -n 25 "$top/debootstrap.log" >&2
    die "debootstrap failed"
  }
  [ -z "$mirror" ] || echo "$sources" >"$base/etc/apt/sources.list"

  # How this machine reaches the network: names, apt's proxy, certificate authorities of its own, cargo's settings.
  cp -L /etc/resolv.conf /etc/hosts "$base/etc/"
  apt-config dump | grep -E '^Acquire::(https?|Check|Retries|Proxy)' >"$base/etc/apt/apt.conf.d/90host" || true
  mkdir -p "$base/usr/local/share/ca-certificates" "$base$home/.cargo"
  for file in /usr/local/share/ca-certificates/*.crt "${CARGO_HTTP_CAINFO:-}" "${SSL_CERT_FILE:-}"; do
    [ ! -f "$file" ] || [ "$file" = /etc/ssl/certs/ca-certificates.crt ] ||
      cp -L "$file" "$base/usr/local/share/ca-certificates/$(basename "${file%.*}").crt"
  done
  for file in "${CARGO_HOME:-$HOME/.cargo}"/config{,.toml}; do
    [ ! -f "$file" ] || cp -L "$file" "$base$home/.cargo/"
  done

  mkdir -p "$base/opt/rust" "$base$home/ffsm-ipopt"
  tar -C "$sysroot" --exclude=./share -cf - . | tar -C "$base/opt/rust" -xf -
  if [ "$from" = worktree ]; then
    git ls-files -z --cached --others --exclude-standard |
      while IFS= read -r -d '' file; do [ ! -e "$file" ] || printf '%s\0' "$file"; done |
      tar --null -T - -cf -
  else
    git archive HEAD
  fi | tar -C "$base$home/ffsm-ipopt" -xf -
}

# Proxy and cargo settings that go into the root with the commands; certificate files and secrets do not.
settings=()
while IFS= read -r -d '' pair; do
  case ${pair%%=*} in
    *_TOKEN | CARGO_HTTP_CAINFO) ;;
    *_proxy | *_PROXY | CARGO_HTTP_* | CARGO_NET_* | CARGO_REGISTRIES_* | CARGO_SOURCE_*) settings+=("$pair") ;;
  esac
done < <(env -0)

# enter ROOT COMMAND...: runs the command in the root, under $wrapper if that is not empty.
wrapper=()
enter() {
  local root=$1
  shift
  env -i HOME="$home" LANG=C.UTF-8 TERM="${TERM:-dumb}" "${settings[@]}" \
    PATH=/opt/rust/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    "${wrapper[@]}" chroot "$root" "$@" </dev/null
}

report=()
timed() {
  local what=$1 start=$SECONDS
  shift
  printf '\n==== %s ====\n' "$what"
  "$@"
  report+=("$(printf '%5d s  %s' $((SECONDS - start)) "$what")")
}

timed "a Debian 12 minbase root, Rust and $from copied in" make_base

for name in "${scripts[@]}"; do
  root=$top/$name
  cp -a --reflink=auto "$base" "$root"
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"

  wrapper=()
  timed "scripts/$name.sh, from nothing" enter "$root" "$home/ffsm-ipopt/scripts/$name.sh"
  before=$(enter "$root" dpkg -l)
  # Without any network an installation or a download could only fail.
  wrapper=(unshare --net)
  timed "scripts/$name.sh again, network cut off" enter "$root" "$home/ffsm-ipopt/scripts/$name.sh"
  wrapper=()
  after=$(enter "$root" dpkg -l)

  [ "$before" = "$after" ] || die "the second run of scripts/$name.sh changed the installed packages"
  report+=("         the second run installed nothing: $(grep -c ^ii <<<"$after") packages before and after")
  umount -R "$root/dev" "$root/proc"
  rm -rf --one-file-system "$root"
done
rm -rf --one-file-system "$top"

printf '\n==== Summary ====\n'
printf '%s\n' "${report[@]}"
