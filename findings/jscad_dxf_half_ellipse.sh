#!/usr/bin/env bash
# JSCAD's DXF reader (npm's @jscad/dxf-deserializer 2.3.30): half an ellipse is a whole one.
# Guessed: groups 41 and 42, an ELLIPSE's first and last parameter, say which part is there, as angles do for ARC (which JSCAD reads as an open path).
# Seen: parameters 0 to pi and 0 to 2 pi give the same filled outline.
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

const ellipse = last => read(groups([[0, 'ELLIPSE'], [8, 0], [10, 0], [20, 0], [30, 0], [11, 4], [21, 0], [31, 0], [40, 0.5], [41, 0], [42, last]]))[0];
const [half, whole] = [ellipse(Math.PI), ellipse(2 * Math.PI)].map(e => measurements.measureArea(e));
console.log(`half of an ellipse has area ${half}, the whole ${whole}`);
if (half !== whole || Math.abs(whole - 8 * Math.PI) > 1) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
