#!/usr/bin/env bash
# Builds with warnings as errors and runs every test: deploy/test.sh [--sanitizers]
# With --sanitizers then also under the address, undefined-behaviour and thread sanitizers. What is
# printed last is ctest's own summary.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

presets=(release)
case "${1-}" in
  '') ;;
  --sanitizers) presets+=(asan tsan) ;;
  *)
    printf 'usage: test.sh [--sanitizers]\n' >&2
    exit 2
    ;;
esac

say() { printf '==> %s\n' "$*"; }

say "Packages"
bash deploy/install_packages.sh --tests

for preset in "${presets[@]}"; do
  launcher=()
  # g++ 12's thread sanitizer can't live with the address randomization of recent kernels. The build
  # needs this too: it runs each test executable once, to list its tests.
  if [[ $preset == tsan ]] && setarch "$(uname -m)" --addr-no-randomize true 2>/dev/null; then
    launcher=(setarch "$(uname -m)" --addr-no-randomize)
  fi
  say "Building in build/$preset"
  cmake --preset "$preset" -DGRAYCUBE_TESTS=ON -DGRAYCUBE_WERROR=ON --log-level=WARNING
  "${launcher[@]}" cmake --build --preset "$preset" --parallel "$(nproc)" -- --quiet
  say "Testing build/$preset"
  "${launcher[@]}" ctest --preset "$preset" -j2 --output-on-failure
done
