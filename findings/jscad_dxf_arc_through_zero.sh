#!/usr/bin/env bash
# JSCAD's DXF reader (npm's @jscad/dxf-deserializer 2.3.30): an arc from 350 to 10 degrees has one point, which isn't a number.
# Guessed: ARC runs anticlockwise from its first angle to its second, so that this is an arc of 20 degrees; every fillet on the right of a plate is one.
# Seen: a path of one point (NaN, NaN), no error. An arc from 0 to 90 is read right.
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

const arc = (from, to) => read(groups([[0, 'ARC'], [8, 0], [10, 0], [20, 0], [30, 0], [40, 2], [50, from], [51, to]]))[0].points;
const [quarter, through] = [arc(0, 90), arc(350, 10)];
console.log(`0 to 90 degrees: ${quarter.length} points; 350 to 10 degrees: ${through.length}, at (${through[0]})`);
if (quarter.length < 3 || through.length !== 1 || !Number.isNaN(through[0][0])) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
