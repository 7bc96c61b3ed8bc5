#!/usr/bin/env bash
# loaders.gl (npm's @loaders.gl/ply 4.4.5): colours of a PLY file that are floats from 0 to 1 lose all between the two.
# Guessed: they stay floats, or become 0 to 255, since the header says "property float red". Seen: they are stored as bytes as they are: 0.5
# is 0, and 1 is 1 of 255, so a model in any such colours is black.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @loaders.gl/core@4.4.5 @loaders.gl/ply@4.4.5
cat > try.mjs <<'JS'
import {parse} from '@loaders.gl/core';
import {PLYLoader} from '@loaders.gl/ply';
const text = `ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float red
property float green
property float blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 1 0 0
1 0 0 0 0.5 0
0 1 0 0.9 0.9 0.9
3 0 1 2
`;
const mesh = await parse(new TextEncoder().encode(text).buffer, PLYLoader);
const colors = mesh.attributes.COLOR_0.value;
console.log(`${colors.constructor.name}: ${[...colors].join(' ')}`);
if (!(colors instanceof Uint8Array || colors instanceof Uint8ClampedArray) || [...colors].join(' ') !== '1 0 0 0 0 0 0 0 0') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
