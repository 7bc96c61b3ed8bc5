#!/usr/bin/env bash
# clipper2-js 1.2.4, a port of Clipper2: every point lies on the outline of a square.
# Guessed: (5, 5) is inside a square of 10, (15, 5) outside, (0, 5) on it. Seen: IsOn for all three.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit clipper2-js@1.2.4
cat > try.mjs <<'JS'
import { Clipper, EndType, JoinType, Path64, Paths64, Point64, PointInPolygonResult } from 'clipper2-js';
const square = side => {
  const path = new Path64();
  for (const [x, y] of [[0, 0], [side, 0], [side, side], [0, side]]) path.push(new Point64(x, y));
  return path;
};

const where = ([x, y]) => PointInPolygonResult[Clipper.pointInPolygon(new Point64(x, y), square(10))];
const found = [[5, 5], [15, 5], [0, 5]].map(where);
console.log(`inside: ${found[0]}, outside: ${found[1]}, on the outline: ${found[2]}`);
if (found.some(f => f !== 'IsOn')) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
