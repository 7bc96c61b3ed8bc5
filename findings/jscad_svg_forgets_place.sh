#!/usr/bin/env bash
# JSCAD's SVG writer (npm's @jscad/svg-serializer 2.3.21): what is written lies at the origin, wherever it was.
# Guessed: a square around (20, 30) is one around (20, 30) in the file. Seen: the file is that of a square at (0, 0), so that parts written one by
# one no longer lie as they did to each other; all of them in one call keep their places to each other, and lose the common one.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/svg-serializer@2.3.21
cat > try.cjs <<'JS'
const { primitives } = require('@jscad/modeling');
const writer = require('@jscad/svg-serializer');
const path = (...center) => writer.serialize({ unit: 'mm' }, primitives.square({ size: 10, center })).join('').match(/ d="([^"]*)"/)[1];
console.log('around (20, 30):', path(20, 30));
console.log('around (-7, 100):', path(-7, 100));
if (path(20, 30) !== path(-7, 100) || path(20, 30) !== 'M0 10L10 10L10 0L0 0L0 10') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
