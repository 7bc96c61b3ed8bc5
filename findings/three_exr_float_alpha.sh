#!/usr/bin/env bash
# three.js (npm's three 0.170.0), EXRLoader: alpha in floats beside colours in halves is read as halves.
# Guessed: each channel is read by its own pixel type, as the format stores one for each. Seen: colours are right, and the alpha 1 1 1 of a
# row is 0 1.875 0, the bytes of its first one and a half floats.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit three@0.170.0
cat > try.mjs <<'JS'
import {FloatType} from 'three';
import {EXRLoader} from 'three/examples/jsm/loaders/EXRLoader.js';
const kHalf = 1, kFloat = 2, kWidth = 3;
const ints = (...numbers) => Buffer.from(new Int32Array(numbers).buffer);
const attribute = (name, type, value) => Buffer.concat([Buffer.from(`${name}\0${type}\0`), ints(value.length), value]);
const box = ints(0, 0, kWidth - 1, 0);
// Colours are 1 (0x3c00 in halves, 0x3f800000 in floats), and so is alpha.
const picture = (alpha) => {
  const channels = [['A', alpha], ['B', kHalf], ['G', kHalf], ['R', kHalf]];
  const list = Buffer.concat([...channels.map(([name, type]) => Buffer.concat([Buffer.from(`${name}\0`), ints(type, 0, 1, 1)])), Buffer.from([0])]);
  const row = Buffer.concat(channels.map(([, type]) =>
    type === kHalf ? Buffer.from(new Uint16Array(kWidth).fill(0x3c00).buffer) : Buffer.from(new Float32Array(kWidth).fill(1).buffer)));
  const header = Buffer.concat([ints(20000630, 2), attribute('channels', 'chlist', list), attribute('compression', 'compression', Buffer.from([0])),
    attribute('dataWindow', 'box2i', box), attribute('displayWindow', 'box2i', box), attribute('lineOrder', 'lineOrder', Buffer.from([0])),
    attribute('pixelAspectRatio', 'float', Buffer.from(new Float32Array([1]).buffer)),
    attribute('screenWindowCenter', 'v2f', Buffer.from(new Float32Array([0, 0]).buffer)),
    attribute('screenWindowWidth', 'float', Buffer.from(new Float32Array([1]).buffer)), Buffer.from([0])]);
  return Buffer.concat([header, ints(header.length + 8, 0), ints(0, row.length), row]);
};
const loaded = (alpha) => {
  const bytes = picture(alpha);
  const data = new EXRLoader().setDataType(FloatType).parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)).data;
  const of = (place) => [0, 1, 2].map((x) => data[4 * x + place]).join(' ');
  return {red: of(0), alpha: of(3)};
};
const halves = loaded(kHalf), mixed = loaded(kFloat);
console.log(`alpha of halves: ${halves.alpha}; of floats: ${mixed.alpha} (red ${mixed.red})`);
if (halves.alpha !== '1 1 1' || mixed.red !== '1 1 1' || mixed.alpha !== '0 1.875 0') {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
