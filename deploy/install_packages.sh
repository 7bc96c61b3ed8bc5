#!/usr/bin/env bash
# Installs what Graycube is built from, on Debian 12: deploy/install_packages.sh [--tests | --fuzz]
# With --tests also the tools that tests and benchmarks compare with, with --fuzz what the fuzzers need.
# Does nothing when all is there.
set -euo pipefail

fail() {
  printf 'install_packages: %s\n' "$*" >&2
  exit 1
}

packages=(
  g++ cmake git ninja-build pkg-config
  libzmq3-dev cppzmq-dev nlohmann-json3-dev libsimdjson-dev libopenexr-dev libpng-dev zlib1g-dev
  libpolyclipping-dev libqhull-dev catch2 libcli11-dev libhwy-dev libcpp-httplib-dev
)
case "${1-}" in
  '') ;;
  --tests) packages+=(spin openscad povray libbenchmark-dev curl python3) ;;
  --fuzz) packages+=(clang libclang-rt-14-dev) ;;
  *) fail "usage: install_packages.sh [--tests | --fuzz]" ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "no apt-get here; install by your own means: ${packages[*]}"
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  printf 'All packages are installed.\n'
  exit 0
fi

as_root=()
if (($(id -u) != 0)); then
  command -v sudo >/dev/null || fail "run as root, or install sudo; missing: ${missing[*]}"
  sudo -n true 2>/dev/null || fail "sudo asks for a password; run as root; missing: ${missing[*]}"
  as_root=(sudo -n)
fi

# `env` rather than an assignment, which sudo would drop.
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@"
}

printf 'Installing %s ...\n' "${missing[*]}"
apt update || { sleep 5 && apt update; } || fail "apt-get update failed twice; is there a network?"
apt install --yes --no-install-recommends "${missing[@]}" >/dev/null ||
  fail "apt-get install failed: ${missing[*]}"
printf 'Installed.\n'
