#!/usr/bin/env bash
# loaders.gl (npm's @loaders.gl/obj 4.4.5): a line in an OBJ file ("l 1 2") goes into the list of triangles, and shifts those behind it.
# Guessed: lines are left out, or a mesh of their own. Seen: its two points stand before the triangle's three, with mode 4 (triangles) for
# all five, so what is drawn is the triangle of points 1, 2 and 1.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @loaders.gl/core@4.4.5 @loaders.gl/obj@4.4.5
cat > try.mjs <<'JS'
import {parse} from '@loaders.gl/core';
import {OBJLoader} from '@loaders.gl/obj';
const read = (lines) =>
  parse(new TextEncoder().encode(['v 0 0 0', 'v 2 0 0', 'v 0 2 0', ...lines].join('\n') + '\n').buffer, OBJLoader);
const text = (mesh) => [...mesh.attributes.POSITION.value].join(' ');
const plain = await read(['f 1 2 3']), lined = await read(['l 1 2', 'f 1 2 3']);
console.log(`face: ${text(plain)}; line and face: ${text(lined)}, mode ${lined.mode}`);
if (text(plain) !== '0 0 0 2 0 0 0 2 0' || text(lined) !== '0 0 0 2 0 0 0 0 0 2 0 0 0 2 0' || lined.mode !== 4) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
