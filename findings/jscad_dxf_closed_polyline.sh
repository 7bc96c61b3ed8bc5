#!/usr/bin/env bash
# JSCAD's DXF reader (npm's @jscad/dxf-deserializer 2.3.30): a closed POLYLINE is open, where a closed LWPOLYLINE is closed.
# Guessed: flag 1 of group 70 means the same for both, as the DXF reference says. Seen: the older entity, which R12 files have, is a path without its last side.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/dxf-deserializer@2.3.30
cat > try.cjs <<'JS'
const { measurements } = require('@jscad/modeling');
const reader = require('@jscad/dxf-deserializer');
const groups = pairs => pairs.map(([code, value]) => `${code}\n${value}\n`).join('');
const section = (name, body) => `0\nSECTION\n2\n${name}\n${body}0\nENDSEC\n`;
const read = (entities, blocks = '') => [reader.deserialize({ output: 'geometry' },
  (blocks ? section('BLOCKS', blocks) : '') + section('ENTITIES', entities) + '0\nEOF\n')].flat(9);

const corners = [[0, 0], [10, 0], [10, 10]];
const light = read(groups([[0, 'LWPOLYLINE'], [8, 0], [90, 3], [70, 1], ...corners.flatMap(([x, y]) => [[10, x], [20, y]])]))[0];
const old = read(groups([[0, 'POLYLINE'], [8, 0], [66, 1], [70, 1], [10, 0], [20, 0], [30, 0],
  ...corners.flatMap(([x, y]) => [[0, 'VERTEX'], [8, 0], [10, x], [20, y], [30, 0]]), [0, 'SEQEND']]))[0];
console.log(`LWPOLYLINE: ${light.points.length} points, closed ${light.isClosed}; POLYLINE: ${old.points.length} points, closed ${old.isClosed}`);
if (!light.isClosed || old.isClosed || old.points.length !== 3) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
