#!/usr/bin/env bash
# Renders every OpenSCAD model below a folder on nodes of this machine, and compares silhouettes: with --facets, the
# picture's must be that of the STL file that OpenSCAD itself exports, rendered as a mesh.
#   bench/against_openscad.sh [--bin DIR] [--nodes N] [--size WxH] [DIR]
# DIR is /usr/share/openscad/examples otherwise. One line a model, then totals. Status 1 where a silhouette differs by more than
# 0.5 % of the pixels, or less than 85 % of the models render. Flat models have no STL file to compare with.
set -euo pipefail

bin=build/release/bin
nodes=8
size=256x256
folder=/usr/share/openscad/examples
while (($# > 0)); do
  case $1 in
    --bin) bin=$2; shift ;;
    --nodes) nodes=$2; shift ;;
    --size) size=$2; shift ;;
    -*) printf 'against_openscad: unknown option %s\n' "$1" >&2; exit 2 ;;
    *) folder=$1 ;;
  esac
  shift
done
for program in "$bin/graycube" "$bin/compare_pictures"; do
  [[ -x $program ]] || { printf 'against_openscad: %s is not built; --bin says where\n' "$program" >&2; exit 2; }
done
command -v openscad >/dev/null || { printf 'against_openscad: there is no openscad\n' >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# A scene in black and white: what is hit is white. With a second argument that mesh is all there is.
silhouette() {
  python3 - "$1" "$2" "${3-}" <<'PYTHON'
import json, sys
source, target, mesh = sys.argv[1:]
scene = json.load(open(source))
scene["lights"], scene["background"], scene["ambient"], scene["max_depth"] = [], [0, 0, 0], [1, 1, 1], 0
for material in scene["materials"]:
    scene["materials"][material] = {"color": [1, 1, 1], "ambient": 1}
if mesh:
    scene["materials"]["stl"] = {"color": [1, 1, 1], "ambient": 1}
    scene["objects"] = [{"material": "stl", "csg": {"type": "mesh", "file": mesh}}]
json.dump(scene, open(target, "w"))
PYTHON
}

models=0 rendered=0 compared=0 alike=0
while IFS= read -r model; do
  name=${model#"$folder"/}
  models=$((models + 1))
  if ! "$bin/graycube" render "$model" -n "$nodes" --size 64x64 --timeout 300 -q -o "$work/m.exr" 2>"$work/why"; then
    printf '%-40s not rendered: %s\n' "$name" "$(grep -v 'ECHO' "$work/why" | tail -1 | cut -c1-200)"
    continue
  fi
  rendered=$((rendered + 1))
  rm -f "$work/m.stl"
  if ! timeout 600 openscad -o "$work/m.stl" "$model" 2>"$work/why" || [[ ! -s $work/m.stl ]]; then
    printf '%-40s rendered; no STL: %s\n' "$name" "$(grep 'top level' "$work/why" | tail -1)"
    continue
  fi
  compared=$((compared + 1))
  if ! {
    "$bin/graycube" convert "$model" "$work/m.json" --facets &&
      silhouette "$work/m.json" "$work/ours.json" && silhouette "$work/m.json" "$work/theirs.json" "m.stl" &&
      "$bin/graycube" render "$work/ours.json" --algorithm serial --size "$size" -q -o "$work/ours.exr" &&
      "$bin/graycube" render "$work/theirs.json" --algorithm serial --size "$size" -q -o "$work/theirs.exr"
  } 2>"$work/why"; then
    printf '%-40s rendered; not compared: %s\n' "$name" "$(tail -1 "$work/why" | cut -c1-200)"
    continue
  fi
  verdict=DIFFERS
  if result=$("$bin/compare_pictures" "$work/ours.exr" "$work/theirs.exr" --most-percent 0.5); then
    verdict=alike
    alike=$((alike + 1))
  fi
  printf '%-40s rendered; silhouette %s: %s\n' "$name" "$verdict" "$(tr '\n' ' ' <<<"$result" | cut -c1-120)"
done < <(find "$folder" -name '*.scad' | sort)
printf '%d models, %d rendered; %d silhouettes compared, %d within 0.5 %%\n' "$models" "$rendered" "$compared" "$alike"
((100 * rendered >= 85 * models && alike == compared))
