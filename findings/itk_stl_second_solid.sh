#!/usr/bin/env bash
# ITK (npm's @itk-wasm/mesh-io 1.7.1): of a text STL of two solids the second is missing, without a word.
# Guessed: both are read into one mesh, as binary STL knows no solids at all. Seen: the first solid's triangle alone.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @itk-wasm/mesh-io@1.7.1
cat > try.mjs <<'JS'
import fs from 'node:fs';
import {readMeshNode} from '@itk-wasm/mesh-io';
const solid = (name, z) => `solid ${name}
facet normal 0 0 1
 outer loop
  vertex 0 0 ${z}
  vertex 1 0 ${z}
  vertex 0 1 ${z}
 endloop
endfacet
endsolid ${name}
`;
fs.writeFileSync('two.stl', solid('a', 0) + solid('b', 5));
const mesh = await readMeshNode('two.stl');
console.log(`${mesh.numberOfCells} triangle of 2, ${mesh.numberOfPoints} points`);
const isAsFound = Number(mesh.numberOfCells) === 1 && Number(mesh.numberOfPoints) === 3;
if (!isAsFound) console.error('not what was found');
process.exit(isAsFound ? 0 : 1);
JS
node try.mjs
