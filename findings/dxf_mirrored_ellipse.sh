#!/usr/bin/env bash
# dxf (npm's dxf 5.3.1): an ELLIPSE seen from below is mirrored, and a LWPOLYLINE isn't; it should be the other way round.
# Guessed: points of a LWPOLYLINE are in its own plane's coordinates (x goes left if its extrusion is 0 0 -1), those of an ELLIPSE in the world's, as
# the DXF reference says. Seen: a quarter of an ellipse from its end at x = 4 goes to x = -4, where it should run from (4, 0) to (0, -2);
# a LWPOLYLINE stays at x = 1 to 3 instead of -1 to -3. Circles, arcs and inserted blocks are right.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit dxf@5.3.1
cat > try.cjs <<'JS'
const {parseString, toPolylines} = require('dxf');
const kFromBelow = '210 0 220 0 230 -1';
const box = (entity) => {
  const text = ['0 SECTION 2 ENTITIES', entity, kFromBelow, '0 ENDSEC 0 EOF'].join(' ').split(' ').join('\n');
  const points = toPolylines(parseString(text)).polylines.flatMap((line) => line.vertices);
  const range = (axis) => [Math.min(...points.map((p) => p[axis])), Math.max(...points.map((p) => p[axis]))].map((v) => +v.toFixed(3) + 0);
  return `x ${range(0).join(' to ')}, y ${range(1).join(' to ')}`;
};
const ellipse = box('0 ELLIPSE 8 0 10 0 20 0 30 0 11 4 21 0 31 0 40 0.5 41 0 42 1.5707963');
const polyline = box('0 LWPOLYLINE 8 0 90 3 70 1 10 1 20 0 10 3 20 0 10 3 20 2');
const circle = box('0 CIRCLE 8 0 10 5 20 0 30 0 40 2');
console.log(`ellipse: ${ellipse}\nlwpolyline: ${polyline}\ncircle: ${circle}`);
if (ellipse !== 'x -4 to 0, y 0 to 2' || polyline !== 'x 1 to 3, y 0 to 2' || circle !== 'x -7 to -3, y -2 to 2') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
