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
rm -rf --one-file-system "$top"
. scripts/debian-root.sh
mkdir -p "$top"
trap '[ $? = 0 ] || echo "failed; the Debian root is left in $top" >&2' EXIT

make_base() {
  make_root "$base"

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
