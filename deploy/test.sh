#!/usr/bin/env bash
# Builds with warnings as errors and runs every test: deploy/test.sh [--ci | --sanitizers | --fuzz [SECONDS]]
# With --ci before that the quick suites under the address and undefined-behaviour sanitizers, and every fuzzer for
# ten seconds. With --sanitizers before that every test under these and the thread sanitizer. What is printed last
# is ctest's own summary. With --fuzz nothing but the fuzzers, 60 seconds each.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

say() { printf '==> %s (%d s)\n' "$*" "$SECONDS"; }

# build PRESET [LAUNCHER...]
build() {
  say "Building in build/$1"
  cmake --preset "$1" -DGRAYCUBE_TESTS=ON -DGRAYCUBE_WERROR=ON --log-level=WARNING
  "${@:2}" cmake --build --preset "$1" --parallel "$(nproc)" -- --quiet
}

# build_and_test PRESET
build_and_test() {
  local launcher=()
  # g++ 12's thread sanitizer can't live with the address randomization of recent kernels. The build
  # needs this too: it runs each test executable once, to list its tests.
  if [[ $1 == tsan ]] && setarch "$(uname -m)" --addr-no-randomize true 2>/dev/null; then
    launcher=(setarch "$(uname -m)" --addr-no-randomize)
  fi
  build "$1" "${launcher[@]}"
  say "Testing build/$1"
  "${launcher[@]}" ctest --preset "$1" -j2 --output-on-failure
}

usage() {
  printf 'usage: test.sh [--ci | --sanitizers | --fuzz [SECONDS]]\n' >&2
  exit 2
}

what=${1-}
case $what in
  '' | --ci | --sanitizers | --fuzz) ;;
  *) usage ;;
esac

say "Packages"
[[ $what == --fuzz ]] || bash deploy/install_packages.sh --tests
[[ $what != --fuzz && $what != --ci ]] || bash deploy/install_packages.sh --fuzz

if [[ $what == --fuzz ]]; then
  build fuzz
  exec bash tests/fuzz/run.sh build/fuzz/bin "${2-60}"
fi
case $what in
  --ci)
    build_and_test smoke
    say "Fuzzing"
    GRAYCUBE_FUZZ_SEED=1 bash tests/fuzz/run.sh build/smoke/bin 10
    ;;
  --sanitizers)
    build_and_test asan
    build_and_test tsan
    ;;
esac
build_and_test release
