#!/usr/bin/env bash
# Makes the Debian package in target/deb, and tries it in a new Debian 12 without Rust: install, plan, manual.
#
# The trial needs root and debootstrap; --build-only leaves it out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

trial=yes
case ${1-} in
  '') ;;
  --build-only) trial= ;;
  *) die "usage: scripts/deb.sh [--build-only]" ;;
esac
PATH=$PATH:/usr/sbin:/sbin # where debootstrap and chroot are
if [ -n "$trial" ]; then
  [ "$(id -u)" = 0 ] || die "making and entering a Debian root needs root (--build-only does without)"
  command -v debootstrap >/dev/null || die "debootstrap not found: apt-get install debootstrap"
  # The mounts made below live in a name space of this process and go when it ends, however it ends.
  [ -n "${DEB_MOUNTS:-}" ] || DEB_MOUNTS=1 exec unshare --mount --propagation private "$BASH" scripts/deb.sh "$@"
fi

top=$PWD/target/deb
tool="cargo-deb 3.8.0"
if [ "$(cat "$top/installed.txt" 2>/dev/null)" != "$tool" ]; then
  mkdir -p "$top"
  cargo install --quiet --locked --root "$top/tools" "cargo-deb@${tool#* }"
  # Last, because it says that all the rest is there.
  echo "$tool" >"$top/installed.txt"
fi

cargo build --release --locked --bin ffsm-ipopt
program=${CARGO_TARGET_DIR:-target}/release/ffsm-ipopt
rm -rf "$top"/{man,completions,dist}
mkdir -p "$top"/{completions,dist}
"$program" man "$top/man" >/dev/null
for shell in bash zsh fish; do
  "$program" completions "$shell" >"$top/completions/ffsm-ipopt.$shell"
done

# The version is that of the tag; between two tags, what comes after the last.
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
if ! git describe --exact-match --match "v$version" HEAD >/dev/null 2>&1; then
  version="$version~$(git log -1 --format=%cd --date=format:%Y%m%d%H%M%S).$(git rev-parse --short HEAD)"
fi
PATH=$top/tools/bin:$PATH
cargo deb --quiet --locked --no-build --no-strip --deb-version "$version" --output "$top/dist/"
package=$(echo "$top"/dist/*.deb)
ls -l "$package"
dpkg-deb --info "$package" | sed -n 's/^ \(Version\|Depends\|Installed-Size\)/\1/p'
[ -n "$trial" ] || exit 0

. scripts/debian-root.sh
root=$top/root
rm -rf --one-file-system "$root"
make_root "$root"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
cp "$package" "$root$home/"
enter "$root" bash -euc '
  cd "$0"
  export DEBIAN_FRONTEND=noninteractive
  apt-get -qq update
  apt-get -qq install -y --no-install-recommends ./*.deb >/dev/null 2>&1
  ffsm-ipopt --version
  ffsm-ipopt init starter
  ffsm-ipopt plan starter/problem.toml
  zcat -f /usr/share/man/man1/ffsm-ipopt-plan.1* | grep -q "^.SH OPTIONS"
  test -s /usr/share/bash-completion/completions/ffsm-ipopt
  ffsm-ipopt plan /usr/share/doc/ffsm-ipopt/examples/table1-smooth.toml --quiet --out smooth
  apt-get -qq purge -y ffsm-ipopt >/dev/null 2>&1
  test ! -e /usr/bin/ffsm-ipopt
' "$home"
umount -R "$root/dev" "$root/proc"
rm -rf --one-file-system "$root" "$root.log"
echo "The package installs in a new Debian 12, plans there, and goes again."
