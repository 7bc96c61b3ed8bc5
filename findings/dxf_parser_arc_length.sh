#!/usr/bin/env bash
# dxf-parser 1.1.2: the angle of an arc through zero is negative, and nearly a whole turn.
# Guessed: angleLength of an ARC from 350 to 10 degrees is 20 degrees. Seen: 10 - 350 = -340, in radians, which is the other part of the circle, turned backwards.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit dxf-parser@1.1.2
cat > try.mjs <<'JS'
import DxfParser from 'dxf-parser';
const Parser = DxfParser.default ?? DxfParser.DxfParser ?? DxfParser;
const arc = (from, to) => new Parser().parseSync('0\nSECTION\n2\nENTITIES\n' +
  [[0, 'ARC'], [8, 0], [10, 0], [20, 0], [30, 0], [40, 2], [50, from], [51, to]].map(([code, value]) => `${code}\n${value}\n`).join('') +
  '0\nENDSEC\n0\nEOF\n').entities[0].angleLength * 180 / Math.PI;
console.log(`0 to 90 degrees: ${arc(0, 90)}; 350 to 10: ${arc(350, 10)}`);
if (Math.abs(arc(0, 90) - 90) > 1e-9 || Math.abs(arc(350, 10) + 340) > 1e-9) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
