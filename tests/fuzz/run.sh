#!/usr/bin/env bash
# Fuzzes every importer and decoder for some seconds each: tests/fuzz/run.sh BIN SECONDS [NAME…]
# With GRAYCUBE_FUZZ_SEED=N the inputs tried are the same each time, as far as the seconds reach.
# BIN holds the executables of a build with -DGRAYCUBE_FUZZ=ON. What a harness learns goes to a temporary folder;
# an input that breaks something stays in the current folder, as NAME-crash-…, NAME-timeout-… or NAME-oom-…, and
# belongs into corpus/NAME with the fix.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
top=$here/../..

if (($# < 2)) || ! [[ -d $1 && $2 =~ ^[0-9]+$ ]]; then
  printf 'usage: run.sh BIN SECONDS [NAME...]\n' >&2
  exit 2
fi
bin=$1 seconds=$2
shift 2
names=("$@")
((${#names[@]})) ||
  names=(brlcad openscad mesh part_stream cbor scene_json scene_render proto_batch proto_control proto_model)

learnt=$(mktemp -d)
trap 'rm -rf -- "$learnt"' EXIT
status=0
for name in "${names[@]}"; do
  seeds=("$here/corpus/${name/scene_render/scene_json}")
  # What takes long to read teaches less in the same time.
  longest=8192
  case $name in
    brlcad) seeds+=("$top/scenes/brlcad") longest=2500 ;;
    openscad) longest=1200 ;;
    mesh | part_stream) longest=1500 ;;
    scene_json | scene_render) seeds+=("$top/scenes") ;;
  esac
  options=(-max_total_time="$seconds" -timeout=20 -rss_limit_mb=1536 -malloc_limit_mb=512 -max_len="$longest"
    -seed="${GRAYCUBE_FUZZ_SEED-0}"
    -print_final_stats=1 -artifact_prefix="$name-")
  dictionary=$here/dictionaries/${name/scene_render/scene_json}.dict
  [[ -f $dictionary ]] && options+=(-dict="$dictionary")
  mkdir -p "$learnt/$name"
  printf '==> %s\n' "$name"
  # The log is long: only its end, unless something was found.
  if "$bin/${name}_fuzz" "${options[@]}" "$learnt/$name" "${seeds[@]}" &>"$learnt/$name.log"; then
    grep -E 'cov: ' "$learnt/$name.log" | tail -1
    grep -E 'stat::(number_of_executed_units|peak_rss_mb)' "$learnt/$name.log"
  else
    tail -50 "$learnt/$name.log"
    status=1
  fi
done
exit $status
