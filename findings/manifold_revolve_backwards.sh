#!/usr/bin/env bash
# Manifold 3.5.4 (npm's manifold-3d): revolved by a negative angle, a figure is an inside-out solid, and subtracting it adds.
# Guessed: -90 degrees sweeps the same quarter on the other side of the axis, with the same volume. Seen: status NoError and a negative volume;
# cut from a cube of volume 1000 it leaves 1003.9.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit manifold-3d@3.5.4
cat > try.mjs <<'JS'
import Module from 'manifold-3d';
const wasm = await Module();
wasm.setup();
const { Manifold, CrossSection } = wasm;

const quarter = degrees => Manifold.revolve(CrossSection.square([1, 1]).translate([2, 0]), 64, degrees);
const [forward, backward] = [quarter(90), quarter(-90)];
const cut = tool => Manifold.difference(Manifold.cube([10, 10, 10], true), tool).volume();
console.log(`90 degrees: volume ${forward.volume()}, leaves ${cut(forward)}; -90: ${backward.volume()} (${backward.status()}), leaves ${cut(backward)}`);
if (forward.volume() < 3.9 || backward.volume() > -3.9 || cut(backward) < 1003 || cut(forward) > 997) {
  console.error('not what was found');
  process.exit(1);
}
JS
node try.mjs
