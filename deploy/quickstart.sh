#!/usr/bin/env bash
# From a bare Debian 12 or 13 to a picture: installs packages, builds, renders scenes/engine_block.json on eight
# nodes, and says what to try next. May be run again; only what is absent is done again.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

say() { printf '==> %s\n' "$*"; }
# The whole number behind some text of the statistics file, which is one line.
figure() { sed -nE "s/.*$1([0-9]+).*/\1/p" out/engine_block.json; }

say "Packages"
bash deploy/install_packages.sh --user

say "Building in build/release"
# A compiler that we don't know yet may warn of more: for users that is no error.
cmake --preset release -DGRAYCUBE_TESTS=OFF --log-level=WARNING
cmake --build --preset release --parallel "$(nproc)" -- --quiet

say "Rendering scenes/engine_block.json: 1024 x 768 pixels of 3 x 3 rays each, on 8 nodes"
mkdir -p out
build/release/bin/graycube render scenes/engine_block.json -n 8 --algorithm macro --size 1024x768 --samples 3 \
  -o out/engine_block.exr --png out/engine_block.png --stats out/engine_block.json

say "Done. In $PWD/out:"
printf '    engine_block.png   the picture, 8-bit sRGB\n'
printf '    engine_block.exr   the picture, linear 32-bit float\n'
printf '    engine_block.json  what the render did: rays, messages, times\n'
printf '\nEach node held a part of the scene. Rays went on to a neighbour %s times; a token went round the\n' \
  "$(($(figure '"forwarded":\{"shadow":') + $(figure '"secondary":')))"
printf 'ring of nodes %s times until it had found nothing left to do.\n' "$(figure '"rounds":')"
cat <<'NEXT'

Three commands to try next:
    build/release/bin/graycube render scenes/openscad/lantern.scad -n 4 --samples 2 -o out/lantern.exr --png out/lantern.png
    build/release/bin/graycube compare scenes/engine_block.json -n 4 --size 256x192
    build/release/bin/graycube up -n 4 --http 127.0.0.1:8080    # a farm; its web page is at that address
NEXT
