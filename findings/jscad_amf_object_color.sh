#!/usr/bin/env bash
# JSCAD's AMF reader (npm's @jscad/amf-deserializer 2.3.13): an object with a colour of its own is a colour, and no object.
# Guessed: a red solid. Seen: the result holds the colour's four numbers where a solid should stand, so that whatever takes it as one fails later.
# (A colour inside <volume> is read right.)
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

const color = '<color><r>1</r><g>0</g><b>0</b></color>';
const [own, inside] = [read(`<object id="1">${color}${mesh}</object>`), read(`<object id="1">${mesh.replace('<volume>', `<volume>${color}`)}</object>`)];
console.log(`colour of the object: ${JSON.stringify(own)}; colour of its volume: ${inside[0].polygons.length} polygons`);
if (JSON.stringify(own) !== '[[1,0,0,1]]' || inside[0].polygons.length !== 4) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
