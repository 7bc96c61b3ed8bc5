#!/usr/bin/env bash
# JSCAD's SVG reader (npm's @jscad/svg-deserializer 2.5.14): an arc whose flags are written together is lost.
# Guessed: a flag is one character (SVG 1.1 section 8.3.9), so that `A 20 20 0 0150 10` is `A 20 20 0 0 1 50 10`; programs that shorten SVG write it so.
# Seen: the path ends where the arc should begin, with one point.
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

const points = arc => read(`<path d="M10 10 ${arc} Z"/>`)[0].points.length;
const [apart, together] = [points('A 20 20 0 0 1 50 10'), points('A 20 20 0 0150 10')];
console.log(`the same arc has ${apart} points with its flags apart, and ${together} with them together`);
if (apart < 10 || together !== 1) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
