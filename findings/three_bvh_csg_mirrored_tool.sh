#!/usr/bin/env bash
# three-bvh-csg 0.0.18 with three 0.187.0: a mirrored tool cuts less than it should.
# Guessed: a brush whose scale is -1 along x cuts as its mirror image does; three.js draws it so. Seen: a slot of volume 2, cut by a bar that is mirrored
# into its place, leaves 6.67 of a cube of 8, and the same bar put there without mirroring leaves 6.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit three@0.187.0 three-bvh-csg@0.0.18 three-mesh-bvh@0.9.17
cat > try.mjs <<'JS'
import * as THREE from 'three';
import { Brush, Evaluator, SUBTRACTION } from 'three-bvh-csg';
const volume = mesh => {
  const p = (mesh.geometry.index ? mesh.geometry.toNonIndexed() : mesh.geometry).attributes.position;
  const corner = i => new THREE.Vector3().fromBufferAttribute(p, i);
  let sum = 0;
  for (let i = 0; i < p.count; i += 3) sum += corner(i).dot(corner(i + 1).cross(corner(i + 2))) / 6;
  return sum;
};
const brush = (geometry, mirrored) => {
  const result = new Brush(geometry);
  if (mirrored) result.scale.x = -1;
  result.updateMatrixWorld();
  return result;
};
console.warn = () => {};
const evaluator = new Evaluator();
evaluator.attributes = ['position', 'normal'];
evaluator.useGroups = false;
const cut = (cube, bar) => volume(evaluator.evaluate(cube, bar, SUBTRACTION));
const cube = () => brush(new THREE.BoxGeometry(2, 2, 2), false);
const placed = cut(cube(), brush(new THREE.BoxGeometry(1, 1, 4).translate(-0.5, 0, 0), false));
const mirrored = cut(cube(), brush(new THREE.BoxGeometry(1, 1, 4).translate(0.5, 0, 0), true));
console.log(`left of 8: ${placed} by a bar in its place, ${mirrored} by one mirrored into it`);
if (Math.abs(placed - 6) > 1e-6 || Math.abs(mirrored - 20 / 3) > 1e-3) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
