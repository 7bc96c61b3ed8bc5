#!/usr/bin/env bash
# loaders.gl (npm's @loaders.gl/ply 4.4.5): a PLY file's faces of more than four corners are left out, without a word.
# Guessed: they are cut into triangles, as faces of four corners are. Seen: of a prism over a pentagon come the five sides, and neither
# floor nor lid; a file of pentagons alone is a list of points.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @loaders.gl/core@4.4.5 @loaders.gl/ply@4.4.5
cat > try.mjs <<'JS'
import {parse} from '@loaders.gl/core';
import {PLYLoader} from '@loaders.gl/ply';
const corner = (i, z) => `${Math.cos(0.4 * Math.PI * i).toFixed(6)} ${Math.sin(0.4 * Math.PI * i).toFixed(6)} ${z}`;
const five = [0, 1, 2, 3, 4];
const points = [...five.map((i) => corner(i, 0)), ...five.map((i) => corner(i, 1))];
const floorAndLid = ['5 4 3 2 1 0', '5 5 6 7 8 9'];
const sides = five.map((i) => `4 ${i} ${(i + 1) % 5} ${(i + 1) % 5 + 5} ${i + 5}`);
const read = (faces) => {
  const text = ['ply', 'format ascii 1.0', `element vertex ${points.length}`, 'property float x', 'property float y', 'property float z',
    `element face ${faces.length}`, 'property list uchar int vertex_indices', 'end_header', ...points, ...faces].join('\n') + '\n';
  return parse(new TextEncoder().encode(text).buffer, PLYLoader);
};
const prism = await read([...floorAndLid, ...sides]);
const pentagons = await read(floorAndLid);
const triangles = prism.indices.value.length / 3;
console.log(`prism: ${triangles} triangles of 16; floor and lid alone: ${pentagons.topology}`);
if (triangles !== 10 || pentagons.topology !== 'point-list') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
