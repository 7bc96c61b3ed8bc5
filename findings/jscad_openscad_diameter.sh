#!/usr/bin/env bash
# JSCAD's translator of OpenSCAD (npm's @jscad/openscad-openjscad-translator 0.0.11): diameters and the root modifier mean nothing to it.
# Guessed: sphere(d = 4) has radius 2, or is refused, and ! leaves out all else. Seen: it has radius 1, what a sphere has that says nothing;
# cylinder(d = 4) has 1, too; and what ! should leave out is there.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/openscad-openjscad-translator@0.0.11
cat > try.cjs <<'JS'
const translator = require('@jscad/openscad-openjscad-translator');
const text = (scad) => String(translator.parse(scad));
const sphere = text('sphere(d = 4);'), cylinder = text('cylinder(h = 3, d = 4);'), root = text('!sphere(1); cube(2);');
console.log(sphere, cylinder, root);
if (!/radius: 1\b/.test(sphere) || !/radiusStart: 1\b/.test(cylinder) || !/CSG\.cube/.test(root)) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
