#!/usr/bin/env bash
# JSCAD's X3D writer (npm's @jscad/x3d-serializer 2.4.13): models stand a hair askew in the file.
# Guessed: numbers of a file that turns z up to y up are those of the model. Seen: the turn is written as -1.5708 radians, so that a box of
# 1 x 2 x 3, read back by JSCAD's own reader, is 1 x 3.000007 x 2.000011 in the file's axes: faces that were flush with another part's aren't.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/x3d-serializer@2.4.13 @jscad/x3d-deserializer@2.2.13
cat > try.cjs <<'JS'
const { primitives, measurements } = require('@jscad/modeling');
const writer = require('@jscad/x3d-serializer'), reader = require('@jscad/x3d-deserializer');
const text = writer.serialize({}, primitives.cuboid({ size: [1, 2, 3] })).join('');
const turn = text.match(/rotation="([^"]*)"/)[1];
const [low, high] = measurements.measureBoundingBox([reader.deserialize({ output: 'geometry' }, text)].flat(2)[0]);
const sides = [0, 1, 2].map((axis) => high[axis] - low[axis]);
console.log(`rotation="${turn}", sides of a 1 x 2 x 3 box read back: ${sides}`);
if (turn !== '1 0 0 -1.5708' || Math.abs(sides[2] - 2) < 1e-6 || Math.abs(sides[2] - 2) > 1e-4) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
