#!/usr/bin/env bash
# ITK (npm's @itk-wasm/mesh-io 1.7.1): an OFF file whose counts stand behind the word OFF is empty, and a COFF file's colours are taken for points.
# Guessed: "OFF 3 1 0" is read like the same numbers on the next line, and the colours behind COFF's points are read or skipped. Seen: no
# points at all, without an error; and of "0 0 0 255 0 0 255" the second point is 255 0 0.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @itk-wasm/mesh-io@1.7.1
cat > try.mjs <<'JS'
import fs from 'node:fs';
import {readMeshNode} from '@itk-wasm/mesh-io';
const read = async (lines) => {
  fs.writeFileSync('mesh.off', lines.join('\n') + '\n');
  const mesh = await readMeshNode('mesh.off');
  return {count: Number(mesh.numberOfPoints), points: [...(mesh.points ?? [])].join(' ')};
};
const body = ['0 0 0', '1 0 0', '1 1 0', '3 0 1 2'];
const usual = await read(['OFF', '3 1 0', ...body]);
const oneLine = await read(['OFF 3 1 0', ...body]);
const coloured = await read(['COFF', '3 1 0', ...body.slice(0, 3).map((point) => point + ' 255 0 0 255'), body[3]]);
console.log(`usual: ${usual.points}\ncounts behind OFF: ${oneLine.count} points\nCOFF: ${coloured.points}`);
const isAsFound = usual.points === '0 0 0 1 0 0 1 1 0' && oneLine.count === 0 && coloured.points === '0 0 0 255 0 0 255 1 0';
if (!isAsFound) console.error('not what was found');
process.exit(isAsFound ? 0 : 1);
JS
node try.mjs
