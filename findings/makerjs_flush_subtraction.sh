#!/usr/bin/env bash
# Maker.js 0.19.2 (npm's makerjs): a rectangle minus its right half, or minus itself, keeps sides that it no longer has.
# Guessed: the left half, whose outline has length 30, and nothing. Seen: outlines of length 50 and 40: sides that both figures share stay.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit makerjs@0.19.2
cat > try.mjs <<'JS'
import makerjs from 'makerjs';
const { models, model, measure } = makerjs;
const length = cut => measure.modelPathLength(model.combineSubtraction(new models.Rectangle(10, 10), cut));
const [half, same, corner] = [model.move(new models.Rectangle(5, 10), [5, 0]), new models.Rectangle(10, 10), model.move(new models.Rectangle(10, 10), [5, 5])].map(length);
console.log(`length of the outline without the right half: ${half}; without itself: ${same}; without a corner, where nothing is flush: ${corner}`);
if (half !== 50 || same !== 40 || corner !== 40) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
