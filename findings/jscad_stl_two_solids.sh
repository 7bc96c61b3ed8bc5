#!/usr/bin/env bash
# JSCAD's STL reader (npm's @jscad/stl-deserializer 2.1.30): a text file of two solids is read as both, twice.
# Guessed: two solids, or one that holds both. Seen: a list of two geometries, each of which has the facets of both solids,
# so that whoever writes out the list again, or adds up its volumes, has everything twice. One solid a file is read right.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @jscad/modeling@2.13.0 @jscad/stl-deserializer@2.1.30
cat > try.cjs <<'JS'
const { measurements } = require('@jscad/modeling');
const reader = require('@jscad/stl-deserializer');
const facet = (normal, corners) => `facet normal ${normal}\nouter loop\n${corners.map(c => `vertex ${c}\n`).join('')}endloop\nendfacet\n`;
const tetrahedron = (x, normals) => {
  const [o, a, b, c] = [`${x} 0 0`, `${x + 1} 0 0`, `${x} 1 0`, `${x} 0 1`];
  return facet(normals[0], [o, b, a]) + facet(normals[1], [o, a, c]) + facet(normals[2], [a, b, c]) + facet(normals[3], [o, c, b]);
};
const right = ['0 0 -1', '0 -1 0', '0.577350 0.577350 0.577350', '-1 0 0'];

const text = `solid one\n${tetrahedron(0, right)}endsolid one\nsolid two\n${tetrahedron(5, right)}endsolid two\n`;
const solids = reader.deserialize({ output: 'geometry' }, text);
const volumes = solids.map(s => measurements.measureVolume(s));
console.log(`two solids of volume ${1 / 6} are read as ${solids.length} of volume ${volumes.join(' and ')}`);
if (solids.length !== 2 || volumes.some(v => Math.abs(v - 1 / 3) > 1e-9)) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
