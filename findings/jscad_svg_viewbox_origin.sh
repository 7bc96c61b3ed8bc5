#!/usr/bin/env bash
# JSCAD's SVG reader (npm's @jscad/svg-deserializer 2.5.14): where a viewBox begins is ignored, while its size counts.
# Guessed: viewBox="10 10 50 50" puts (10, 10) at the picture's corner. Seen: shapes are scaled by it, and lie 20 mm beside their place.
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

const box = JSON.stringify(measurements.measureBoundingBox(read('<rect x="10" y="10" width="20" height="30"/>', 'path', '10 10 50 50')[0]));
console.log(`a rectangle in the picture's corner has bounds ${box}`);
if (box !== '[[20,-80,0],[60,-20,0]]') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
