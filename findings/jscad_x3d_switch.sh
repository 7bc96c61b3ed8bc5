#!/usr/bin/env bash
# JSCAD's X3D reader (npm's @jscad/x3d-deserializer 2.2.13): a Switch shows all its children.
# Guessed: whichChoice says which child is there, and -1, its default, none (X3D, grouping component). Seen: both shapes of a Switch are solids of the result, whatever it chooses.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/x3d-deserializer@2.2.13
cat > try.cjs <<'JS'
const reader = require('@jscad/x3d-deserializer');
const count = choice => [reader.deserialize({ output: 'geometry' }, '<?xml version="1.0"?><X3D profile="Interchange" version="3.3"><Scene>' +
  `<Switch whichChoice="${choice}"><Shape><Box/></Shape><Shape><Sphere/></Shape></Switch></Scene></X3D>`)].flat(9).length;
console.log(`shapes of a Switch of two: ${count(-1)} with choice -1, ${count(0)} with choice 0`);
if (count(-1) !== 2 || count(0) !== 2) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
