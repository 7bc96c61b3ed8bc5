#!/usr/bin/env bash
# Builds with warnings as errors and runs every test: deploy/test.sh [--sanitizers | --fuzz [SECONDS]]
# With --sanitizers then also under the address, undefined-behaviour and thread sanitizers. What is
# printed last is ctest's own summary. With --fuzz nothing but the fuzzers of tests/fuzz, 60 seconds each.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

say() { printf '==> %s\n' "$*"; }

presets=(release)
case "${1-}" in
  --fuzz)
    say "Packages"
    bash deploy/install_packages.sh --fuzz
    say "Building in build/fuzz"
    cmake --preset fuzz --log-level=WARNING
    cmake --build --preset fuzz --parallel "$(nproc)" -- --quiet
    exec bash tests/fuzz/run.sh build/fuzz/bin "${2-60}"
    ;;
  '') ;;
  --sanitizers) presets+=(asan tsan) ;;
  *)
    printf 'usage: test.sh [--sanitizers | --fuzz [SECONDS]]\n' >&2
    exit 2
    ;;
esac

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
