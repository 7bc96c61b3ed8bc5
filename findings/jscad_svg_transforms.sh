#!/usr/bin/env bash
# JSCAD's SVG reader (npm's @jscad/svg-deserializer 2.5.14): transform="rotate(a x y)" gives coordinates that aren't numbers, and matrix() is ignored.
# Guessed: both are read, as SVG 1.1 section 7.6 has them, or refused. Seen: NaN without an error; and the untransformed square. (translate and scale are read.)
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/svg-deserializer@2.5.14
cat > try.cjs <<'JS'
const { measurements } = require('@jscad/modeling');
const reader = require('@jscad/svg-deserializer');
const bounds = (transform) => JSON.stringify(measurements.measureBoundingBox([reader.deserialize(
  { output: 'geometry', addMetaData: false, target: 'geom2' },
  `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100"><rect width="5" height="5" transform="${transform}"/></svg>`)].flat(2)[0]));
for (const transform of ['translate(10 20) scale(2)', 'matrix(2 0 0 2 10 20)', 'rotate(90 2.5 2.5)']) console.log(transform, bounds(transform));
if (bounds('matrix(2 0 0 2 10 20)') !== '[[0,-5,0],[5,0,0]]' || !bounds('rotate(90 2.5 2.5)').includes('null')) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
