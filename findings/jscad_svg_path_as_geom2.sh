#!/usr/bin/env bash
# JSCAD's SVG reader (npm's @jscad/svg-deserializer 2.5.14): a <path> as geom2 is one side of four ends.
# Guessed: target geom2 gives a figure that can be extruded: a square of area 81. Seen: its list of sides has one entry, which holds the four corners, so that
# its area is 4.5. The same square as <rect> is right.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/svg-deserializer@2.5.14
cat > try.cjs <<'JS'
const { measurements } = require('@jscad/modeling');
const reader = require('@jscad/svg-deserializer');
const read = (body, target = 'path', view = '0 0 100 100') => [reader.deserialize({ output: 'geometry', target },
  `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="${view}">${body}</svg>`)].flat(9);

const [path, rect] = [read('<path d="M1 1 L10 1 L10 10 L1 10 Z"/>', 'geom2')[0], read('<rect x="1" y="1" width="9" height="9"/>', 'geom2')[0]];
console.log(`path: ${path.sides.length} side, area ${measurements.measureArea(path)}; rect: ${rect.sides.length} sides, area ${measurements.measureArea(rect)}`);
if (path.sides.length !== 1 || path.sides[0].length !== 4 || rect.sides.length !== 4) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
