#!/bin/sh
# against_rt.sh MODEL VIEW REFERENCE.png OBJECT... : renders normals of a BRL-CAD model as rt would and compares them
# with rt's own picture (rt -B -M -s512 -H0 -J0 -l2 -o REFERENCE.png MODEL.g OBJECT... < VIEW).
# BIN: where graycube, compare_normals and compare_pictures are (default build/release/bin); SIZE: WxH (default 512x512);
# MOST_OFF: percent of pixels that may be off (default 0.3). LIT=1: compares the lit picture instead (rt -l0), where that
# many percent (default 2) of the pixels that show something may be off by more than TOLERANCE/255 (default 6).
set -eu
if [ $# -lt 4 ]; then
  sed -n 2,6p "$0" >&2
  exit 2
fi
bin=${BIN:-build/release/bin}
model=$1 view=$2 reference=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
objects=
for o in "$@"; do objects="$objects --object $o"; done
if [ -n "${LIT:-}" ]; then
  # shellcheck disable=SC2086 # names of BRL-CAD objects hold no blanks
  "$bin/graycube" render "$model" --view "$view" $objects --algorithm serial --size "${SIZE:-512x512}" -q \
    -o "$folder/lit.exr"
  "$bin/compare_pictures" "$folder/lit.exr" "$reference" --tolerance $((257 * ${TOLERANCE:-6})) \
    --most-percent "${MOST_OFF:-2}" --covered
  exit
fi
# shellcheck disable=SC2086 # names of BRL-CAD objects hold no blanks
"$bin/graycube" render "$model" --view "$view" $objects --aov normal --algorithm serial --max-depth 0 \
  --size "${SIZE:-512x512}" -q -o "$folder/normals.exr"
"$bin/compare_normals" "$folder/normals.exr" "$reference" "${MOST_OFF:-0.3}"
