#!/usr/bin/env bash
# JSCAD 2.13.0 (npm's @jscad/modeling): a profile left of the axis is revolved to an inside-out solid, and a union with it loses everything.
# Guessed: extrudeRotate of a circle around x = -4 is the torus that x = 4 gives. Seen: bounds are the torus's, its volume is negative, the
# union of a block with it has volume 0, and the difference gives the intersection.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0
cat > try.cjs <<'JS'
const { primitives, booleans, transforms, measurements, extrusions } = require('@jscad/modeling');
const ring = (x) => extrusions.extrudeRotate({ segments: 64 }, transforms.translate([x, 0], primitives.circle({ radius: 1 })));
const block = primitives.cuboid({ size: [12, 12, 4] });
const volumes = (x) => [ring(x), booleans.union(block, ring(x)), booleans.subtract(block, ring(x))]
  .map((solid) => Number(measurements.measureVolume(solid).toFixed(3)));
console.log('circle at x = 4: ring, block + ring, block - ring:', ...volumes(4));
console.log('circle at x = -4:                                ', ...volumes(-4));
if (volumes(4).join() !== '78.325,576,497.675' || volumes(-4).join() !== '-78.325,0,78.325') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
