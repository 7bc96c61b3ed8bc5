#!/usr/bin/env bash
# Manifold 3.5.4 (npm's manifold-3d): a column twisted to the left has a tenth more volume than its mirror image, twisted to the right.
# Guessed: +360 and -360 degrees give mirror images. Seen: each bent side is cut along the same diagonal whichever way it turns, outward for one sense
# and inward for the other: 41.9 against 37.8 for a square of 2 x 2 x 10 in 40 steps, where 40 is right.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit manifold-3d@3.5.4
cat > try.mjs <<'JS'
import Module from 'manifold-3d';
const wasm = await Module();
wasm.setup();
const { Manifold, CrossSection } = wasm;

const volume = degrees => Manifold.extrude(CrossSection.square([2, 2], true), 10, 40, degrees).volume();
console.log(`twisted by 360 degrees: ${volume(360)}; by -360: ${volume(-360)}`);
if (volume(360) < 41 || volume(-360) > 39) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
