#!/usr/bin/env bash
# From a bare Debian 12 to a first picture: installs packages, builds, renders scenes/first.json.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

say() { printf '==> %s\n' "$*"; }

say "Packages"
bash deploy/install_packages.sh

say "Building in build/release"
cmake --preset release -DGRAYCUBE_TESTS=OFF --log-level=WARNING
cmake --build --preset release --parallel "$(nproc)" -- --quiet

say "Rendering scenes/first.json on 8 nodes"
mkdir -p out
build/release/bin/graycube render scenes/first.json -n 8 \
  -o out/first.exr --png out/first.png --stats out/first.json

say "Done. In $PWD/out:"
printf '    first.png   the picture, 8-bit sRGB\n'
printf '    first.exr   the picture, linear 32-bit float\n'
printf '    first.json  what the render did: rays, messages, times\n'
