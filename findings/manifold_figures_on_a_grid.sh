#!/usr/bin/env bash
# Manifold 3.5.4 (npm's manifold-3d): corners of figures lie on a grid of about 1e-8, those of solids don't, so that the two aren't flush.
# Guessed: a plate extruded from the points 0 and 1/3, minus a cube of the same size, is nothing. Seen: a sliver as thick as the rounding is left:
# figures go through integers, whatever their size or unit is. (A figure made by square() isn't rounded before it is used.)
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

const plate = Manifold.extrude([[[0, 0], [1 / 3, 0], [1 / 3, 1], [0, 1]]], 1);
const cube = Manifold.cube([1 / 3, 1, 1]);
const left = Manifold.difference(plate, cube);
const side = plate.boundingBox().max[0];
console.log(`a third is ${side} in a figure and ${cube.boundingBox().max[0]} in a cube; between them lies a solid of ${left.numTri()} triangles`);
if (left.isEmpty() || Math.abs(side - 1 / 3) < 1e-10 || Math.abs(side - 1 / 3) > 1e-7) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
