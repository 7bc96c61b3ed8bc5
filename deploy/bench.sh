#!/usr/bin/env bash
# Measures Graycube beside POV-Ray and Embree, on a bare Debian 12: installs what is absent, builds
# in build/bench, generates scenes, runs, prints tables. Arguments go to bench/compare.py, as in
#   deploy/bench.sh --quick
#   deploy/bench.sh --seeds 21,22,23 --size 1024 --families csg:1000,flake:5 --json out/bench.json
# `deploy/bench.sh --kernels [Google Benchmark's options]` runs the micro-benchmarks instead, and `deploy/bench.sh --farm SCENE…` (with
# bench/farm_cost.py's options) measures farms: what their processes cost, and renders beside serial.
set -euo pipefail
called_from=$PWD
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

say() { printf '==> %s\n' "$*" >&2; }
fail() {
  printf 'bench: %s\n' "$*" >&2
  exit 1
}

install_absent() {
  local package status missing=() as_root=()
  for package in "$@"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || missing+=("$package")
  done
  ((${#missing[@]} > 0)) || return 0
  if (($(id -u) != 0)); then
    sudo -n true 2>/dev/null || fail "run as root, or install by your own means: ${missing[*]}"
    as_root=(sudo -n)
  fi
  say "Installing ${missing[*]}"
  # What was installed before has updated the lists, or this does it.
  local install=(apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 install --yes
    --no-install-recommends "${missing[@]}")
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "${install[@]}" >/dev/null 2>&1 || {
    "${as_root[@]}" apt-get -qq update
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "${install[@]}" >/dev/null
  } || fail "apt-get install failed: ${missing[*]}"
}

say "Packages"
bash deploy/install_packages.sh >&2
install_absent povray libembree-dev libbenchmark-dev python3

say "Building in build/bench"
# Tests are configured for compare_pictures, which is among them.
cmake -S . -B build/bench -G Ninja -DCMAKE_BUILD_TYPE=Release -DGRAYCUBE_BENCH=ON \
  -DGRAYCUBE_TESTS=ON --log-level=WARNING >&2
cmake --build build/bench --parallel "$(nproc)" --target graycube compare_pictures scene_family \
  trace_time plain_tracer rays_vs_embree kernels graycube-frontal graycube-node bare_farm -- --quiet >&2

if [[ ${1-} == --kernels ]]; then
  exec build/bench/bin/kernels "${@:2}"
fi
programs=$PWD/build/bench/bin
if [[ ${1-} == --farm ]]; then
  "$programs/bare_farm" 16 64
  farm_cost=$PWD/bench/farm_cost.py
  cd -- "$called_from"
  exec python3 "$farm_cost" --graycube "$programs/graycube" "${@:2}"
fi
say "Running; a full comparison takes ten minutes or so"
compare=$PWD/bench/compare.py
cd -- "$called_from" # so that --json's file is where the caller means it
exec python3 "$compare" --bin "$programs" "$@"
