#!/usr/bin/env bash
# clipper2-js 1.2.4, a port of Clipper2: a square of 100 that is offset by 10 with mitred corners isn't the square of 120.
# Guessed: area 14400, as Clipper2 gives it. Seen: 12100, an outline of six corners: two corners of four keep their place. Shrunk by 10 it has more than the 6400 of a square of 80.
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

const offset = by => {
  const paths = new Paths64();
  paths.push(square(100));
  return [...Clipper.InflatePaths(paths, by, JoinType.Miter, EndType.Polygon)];
};
const area = paths => paths.reduce((sum, path) => sum + Clipper.area(path), 0);
const [grown, shrunk] = [offset(10), offset(-10)];
console.log(`grown: area ${area(grown)}, corners ${[...grown[0]].map(p => `(${p.x}, ${p.y})`).join(' ')}; shrunk: ${area(shrunk)}`);
if (area(grown) !== 12100 || area(shrunk) <= 6400) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
