#!/usr/bin/env bash
# Makes a Debian 12 root that reaches the network as this machine does, and runs commands in it; sourced, by a script that has `die`.

home=/home/newcomer # inside the root

# make_root DIR: debootstrap's smallest Debian 12 in DIR, a new folder; the log beside it.
make_root() {
  local root=$1 sources mirror file
  mkdir -p "$root"
  # This machine's Debian mirrors, in sources.list form; debootstrap's own default without them.
  # shellcheck disable=SC2016 # apt expands these
  sources=$(apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' 2>/dev/null | grep ' bookworm' || true)
  mirror=$(sed -n 's/^deb \(.*\) bookworm main$/\1/p' <<<"$sources" | sed -n 1p)
  debootstrap --variant=minbase bookworm "$root" ${mirror:+"$mirror"} >"$root.log" 2>&1 || {
    tail -n 25 "$root.log" >&2
    die "debootstrap failed"
  }
  [ -z "$mirror" ] || echo "$sources" >"$root/etc/apt/sources.list"

  # How this machine reaches the network: names, apt's proxy, certificate authorities of its own, settings of
  # cargo and pip.
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
  apt-config dump | grep -E '^Acquire::(https?|Check|Retries|Proxy)' >"$root/etc/apt/apt.conf.d/90host" || true
  mkdir -p "$root/usr/local/share/ca-certificates" "$root$home/.cargo"
  for file in /usr/local/share/ca-certificates/*.crt "${CARGO_HTTP_CAINFO:-}" "${SSL_CERT_FILE:-}"; do
    [ ! -f "$file" ] || [ "$file" = /etc/ssl/certs/ca-certificates.crt ] ||
      cp -L "$file" "$root/usr/local/share/ca-certificates/$(basename "${file%.*}").crt"
  done
  for file in "${CARGO_HOME:-$HOME/.cargo}"/config{,.toml}; do
    [ ! -f "$file" ] || cp -L "$file" "$root$home/.cargo/"
  done
  [ ! -f /etc/pip.conf ] || cp -L /etc/pip.conf "$root/etc/"
}

# Settings of proxies, cargo and pip that go into the root with the commands; certificate files and secrets do not.
settings=()
while IFS= read -r -d '' pair; do
  case ${pair%%=*} in
    *_TOKEN | CARGO_HTTP_CAINFO) ;;
    *_proxy | *_PROXY | PIP_INDEX_URL | PIP_DEFAULT_TIMEOUT | CARGO_HTTP_* | CARGO_NET_* | CARGO_REGISTRIES_* | CARGO_SOURCE_*) settings+=("$pair") ;;
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
