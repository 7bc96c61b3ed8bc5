#!/usr/bin/env bash
# Installs what Graycube is built from, on Debian 12 and 13:
#   deploy/install_packages.sh [--user | --package | --tests | --fuzz]
# With --user also what renders use, with --package also what cpack calls, with --tests also the tools that tests
# and benchmarks compare with, with --fuzz also what the fuzzers need. Does nothing when all is there.
set -euo pipefail

fail() {
  printf 'install_packages: %s\n' "$*" >&2
  exit 1
}

# The version of clang that `clang` stands for; its run-time library has it in its name.
clang_version() {
  case $(. /etc/os-release 2>/dev/null && printf '%s' "${VERSION_ID-}") in
    13) printf 19 ;;
    *) printf 14 ;;
  esac
}

# clang-format formats differently from version to version: tests compare with this one's, where it is.
formatter() {
  [[ $(. /etc/os-release 2>/dev/null && printf '%s' "${VERSION_ID-}") != 12 ]] || printf clang-format-14
}

packages=(
  g++ cmake git ninja-build pkg-config
  libzmq3-dev cppzmq-dev nlohmann-json3-dev libsimdjson-dev libopenexr-dev libpng-dev zlib1g-dev
  libpolyclipping-dev libqhull-dev catch2 libcli11-dev libhwy-dev libboost-dev
  libsqlite3-dev libsodium-dev prometheus-cpp-dev
  libassimp-dev
)
case "${1-}" in
  '') ;;
  --user) packages+=(openscad) ;;
  --package) packages+=(dpkg-dev file) ;;
  --tests) packages+=(spin gcc openscad povray libbenchmark-dev curl python3 $(formatter)
    iproute2 slurmctld slurmd slurm-client munge) ;; # spin's verifiers are C
  --fuzz) packages+=(clang "libclang-rt-$(clang_version)-dev") ;;
  *) fail "usage: install_packages.sh [--user | --package | --tests | --fuzz]" ;;
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
  if ! sudo -n true 2>/dev/null; then
    printf 'Some packages are not installed yet, and that needs your password. Run this, then start again:\n\n'
    if command -v sudo >/dev/null; then
      printf '  sudo apt-get update && sudo apt-get install --yes --no-install-recommends %s\n' "${missing[*]}"
    else
      printf '  su -c "apt-get update && apt-get install --yes --no-install-recommends %s"\n' "${missing[*]}"
    fi
    exit 1
  fi >&2
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
