#!/usr/bin/env bash
# JSCAD's AMF reader (npm's @jscad/amf-deserializer 2.3.13): what a constellation places isn't placed.
# Guessed: the two instances of an object stand at x = 10 and x = 20, as the file says. Seen: one object at the origin, and no word about it.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/amf-deserializer@2.3.13
cat > try.cjs <<'JS'
const { measurements } = require('@jscad/modeling');
const reader = require('@jscad/amf-deserializer');
const vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]].map(([x, y, z]) => `<vertex><coordinates><x>${x}</x><y>${y}</y><z>${z}</z></coordinates></vertex>`);
const triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(([a, b, c]) => `<triangle><v1>${a}</v1><v2>${b}</v2><v3>${c}</v3></triangle>`);
const mesh = `<mesh><vertices>${vertices.join('')}</vertices><volume>${triangles.join('')}</volume></mesh>`;
const read = body => reader.deserialize({ output: 'geometry' }, `<?xml version="1.0"?><amf unit="millimeter">${body}</amf>`);

const parts = [read(`<object id="1">${mesh}</object><constellation id="2"><instance objectid="1"><deltax>10</deltax></instance>` +
  '<instance objectid="1"><deltax>20</deltax></instance></constellation>')].flat(9);
const boxes = JSON.stringify(parts.map(p => measurements.measureBoundingBox(p)));
console.log(`two instances at x = 10 and x = 20 are ${parts.length} part, in ${boxes}`);
if (boxes !== '[[[0,0,0],[1,1,1]]]') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
