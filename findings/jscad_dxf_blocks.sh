#!/usr/bin/env bash
# JSCAD's DXF reader (npm's @jscad/dxf-deserializer 2.3.30): blocks are drawn where they are defined, and nowhere else.
# Guessed: a block shows where an INSERT puts it, with the INSERT's place and scale, and not at all without one. Seen: a circle of a block that nothing
# inserts is in the result, and inserting it at x = 100, twice as large, changes nothing.
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

const block = groups([[0, 'BLOCK'], [8, 0], [2, 'B'], [70, 0], [10, 0], [20, 0], [30, 0], [3, 'B'],
  [0, 'CIRCLE'], [8, 0], [10, 5], [20, 0], [30, 0], [40, 2], [0, 'ENDBLK'], [8, 0]]);
const line = groups([[0, 'LINE'], [8, 0], [10, 0], [20, 0], [30, 0], [11, 1], [21, 1], [31, 0]]);
const insert = groups([[0, 'INSERT'], [8, 0], [2, 'B'], [10, 100], [20, 0], [30, 0], [41, 2], [42, 2], [43, 2], [50, 0]]);
const circle = geometries => JSON.stringify(geometries.filter(g => g.sides).map(g => measurements.measureBoundingBox(g)));
const [unused, inserted] = [circle(read(line, block)), circle(read(insert, block))];
console.log(`not inserted: ${unused}; inserted at x = 100, twice as large: ${inserted}`);
if (unused !== '[[[3,-2,0],[7,2,0]]]' || inserted !== unused) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
