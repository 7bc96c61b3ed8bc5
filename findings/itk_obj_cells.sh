#!/usr/bin/env bash
# ITK (npm's @itk-wasm/mesh-io 1.7.1): faces of an OBJ are lists of 64-bit numbers that hold two 32-bit numbers each, and points counted
# from the end are points that don't exist.
# Guessed: cells are [kind, number of points, points ...], as for the same triangle in an OFF file: 2 3 0 1 2. Seen: 12884901892, which is 4 and 3,
# then 4294967296, which is 0 and 1, then 2; and of "f -3 -2 -1", the same triangle, the points are -4, -3 and -2.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @itk-wasm/mesh-io@1.7.1
cat > try.mjs <<'JS'
import fs from 'node:fs';
import {readMeshNode} from '@itk-wasm/mesh-io';
const cells = async (name, text) => {
  fs.writeFileSync(name, text);
  return (await readMeshNode(name)).cells;
};
const points = 'v 0 0 0\nv 1 0 0\nv 0 1 0\n';
const off = await cells('a.off', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n');
const obj = await cells('a.obj', points + 'f 1 2 3\n');
const fromEnd = await cells('b.obj', points + 'f -3 -2 -1\n');
const halves = (list) => [...new Int32Array(list.buffer.slice(list.byteOffset, list.byteOffset + 20))].join(' ');
console.log(`OFF: ${[...off].join(' ')}\nOBJ: ${[...obj].slice(0, 3).join(' ')} (in halves: ${halves(obj)})\nfrom the end: ${halves(fromEnd)}`);
const isAsFound = [...off].join(' ') === '2 3 0 1 2' && [...obj].slice(0, 3).join(' ') === '12884901892 4294967296 2' &&
  halves(obj) === '4 3 0 1 2' && halves(fromEnd) === '4 3 -4 -3 -2';
if (!isAsFound) console.error('not what was found');
process.exit(isAsFound ? 0 : 1);
JS
node try.mjs
