#!/usr/bin/env bash
# JSCAD's AMF reader (npm's @jscad/amf-deserializer 2.3.13): an inch has 25.40005 mm.
# Guessed: unit="inch" scales by 25.4. Seen: by 1 / 0.03937, so that a part of 100 inches is 5 micrometres too long, and no longer flush with one
# that was drawn in millimetres. (assimp, which Graycube reads AMF with, doesn't scale by the unit at all.)
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/amf-serializer@2.1.23 @jscad/amf-deserializer@2.3.13
cat > try.cjs <<'JS'
const { primitives, measurements } = require('@jscad/modeling');
const writer = require('@jscad/amf-serializer'), reader = require('@jscad/amf-deserializer');
const text = writer.serialize({ unit: 'inch' }, primitives.cube({ size: 100 })).join('');
const [low, high] = measurements.measureBoundingBox([reader.deserialize({ output: 'geometry' }, text)].flat(2)[0]);
const side = high[0] - low[0];
console.log(`a cube of 100 inches is ${side} mm wide, where 2540 are right`);
if (Math.abs(side - 100 / 0.03937) > 1e-6) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
