#!/usr/bin/env bash
# assimp (npm's assimpjs 0.0.10): a fourth number behind a point of an OBJ file divides it.
# Guessed: w is for rational curves and surfaces ("v x y z w" in the OBJ specification, default 1), and polygons ignore it. Seen: a box of
# 1 x 2 x 3 whose points end in 2 comes in as 0.5 x 1 x 1.5.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
npm install --silent --no-fund --no-audit assimpjs@0.0.10
cat > try.cjs <<'JS'
const points = [[0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0], [0, 0, 3], [1, 0, 3], [1, 2, 3], [0, 2, 3]];
const faces = [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];
require('assimpjs')().then((assimp) => {
  const size = (fourth) => {
    const text = [...points.map((p) => `v ${p.join(' ')}${fourth}`), ...faces.map((f) => `f ${f.join(' ')}`)].join('\n') + '\n';
    const list = new assimp.FileList();
    list.AddFile('box.obj', new TextEncoder().encode(text));
    const result = assimp.ConvertFileList(list, 'assjson');
    const numbers = JSON.parse(new TextDecoder().decode(result.GetFile(0).GetContent())).meshes[0].vertices;
    return [0, 1, 2].map((axis) => Math.max(...numbers.filter((_, i) => i % 3 === axis)));
  };
  console.log(`without: ${size('')}, with w = 2: ${size(' 2')}`);
  if (size('').join() !== '1,2,3' || size(' 2').join() !== '0.5,1,1.5') {
    console.error('not what was found');
    process.exit(1);
  }
});
JS
node try.cjs
