#!/usr/bin/env bash
# JSCAD's STL reader (npm's @jscad/stl-deserializer 2.1.30): text whose normals are 0 0 0 is read inside out.
# Guessed: the normal is ignored, or taken from the corners' order, as programs that write 0 0 0 mean it. Seen: the solid's volume is negative.
# (With normals that agree with the corners it is positive. Graycube looks at the corners alone.)
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

const volume = normals => measurements.measureVolume(reader.deserialize({ output: 'geometry' }, `solid s\n${tetrahedron(0, normals)}endsolid s\n`)[0]);
const [stated, zero] = [volume(right), volume(Array(4).fill('0 0 0'))];
console.log(`the same corners have volume ${stated} with their normals, and ${zero} with normals of 0 0 0`);
if (Math.abs(stated - 1 / 6) > 1e-9 || Math.abs(zero + 1 / 6) > 1e-9) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.cjs
