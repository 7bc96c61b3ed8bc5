#!/usr/bin/env bash
# @flatten-js/core 1.6.15: a circle minus itself is the circle.
# Guessed: nothing is left, as of a square minus itself. Seen: all of its area. (A circle that is smaller or beside it is cut out right.)
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit @flatten-js/core@1.6.15
cat > try.mjs <<'JS'
import Flatten from '@flatten-js/core';
const { Polygon, Circle, BooleanOperations, point } = Flatten;
const circle = radius => {
  const polygon = new Polygon();
  polygon.addFace([new Circle(point(0, 0), radius).toArc(true)]);
  return polygon;
};
const square = () => {
  const polygon = new Polygon();
  polygon.addFace([point(0, 0), point(9, 0), point(9, 9), point(0, 9)]);
  return polygon;
};
const left = (a, b) => BooleanOperations.subtract(a, b).area();
const [same, smaller, squares] = [left(circle(5), circle(5)), left(circle(5), circle(2)), left(square(), square())];
console.log(`a circle minus itself: ${same}; minus a smaller one: ${smaller}; a square minus itself: ${squares}`);
if (Math.abs(same - 25 * Math.PI) > 1e-9 || Math.abs(smaller - 21 * Math.PI) > 1e-9 || squares !== 0) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
