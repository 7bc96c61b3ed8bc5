#!/usr/bin/env bash
# JSCAD's SVG reader (npm's @jscad/svg-deserializer 2.5.14): a <polygon> is open.
# Guessed: a polygon is a polyline that is closed; that is the only difference between the two (SVG 1.1 section 9.7). Seen: both are open paths, where <rect> is closed.
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

const closed = body => read(body)[0].isClosed;
const [polygon, rect] = [closed('<polygon points="0,0 10,0 10,10"/>'), closed('<rect width="10" height="10"/>')];
console.log(`closed: polygon ${polygon}, rect ${rect}`);
if (polygon || !rect) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
