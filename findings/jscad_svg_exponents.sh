#!/usr/bin/env bash
# JSCAD's SVG reader (npm's @jscad/svg-deserializer 2.5.14): 1e1 in a path is 11.
# Guessed: numbers of path data may have exponents (SVG 1.1 section 8.3.9), so that 1e1 is 10; or an error. Seen: the e is skipped, and nothing is said.
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

const corner = x => read(`<path d="M0 0 L${x} 0 L0 10 Z"/>`)[0].points[1][0];
console.log(`x of a corner: ${corner('10')} where the file says 10, ${corner('1e1')} where it says 1e1`);
if (corner('10') !== 10 || corner('1e1') !== 11) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
