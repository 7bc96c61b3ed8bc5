#!/bin/sh
# against_rt.sh MODEL VIEW REFERENCE.png OBJECT... : renders normals of a BRL-CAD model as rt would and compares them
# with rt's own picture (rt -B -M -s512 -H0 -J0 -l2 -o REFERENCE.png MODEL.g OBJECT... < VIEW).
# BIN: where graycube and compare_normals are (default build/release/bin); SIZE: WxH (default 512x512);
# MOST_OFF: percent of pixels that may be off (default 0.3).
set -eu
if [ $# -lt 4 ]; then
  sed -n 2,5p "$0" >&2
  exit 2
fi
bin=${BIN:-build/release/bin}
model=$1 view=$2 reference=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
objects=
for o in "$@"; do objects="$objects --object $o"; done
# shellcheck disable=SC2086 # names of BRL-CAD objects hold no blanks
"$bin/graycube" render "$model" --view "$view" $objects --aov normal --algorithm serial --max-depth 0 \
  --size "${SIZE:-512x512}" -q -o "$folder/normals.exr"
"$bin/compare_normals" "$folder/normals.exr" "$reference" "${MOST_OFF:-0.3}"
