#!/usr/bin/env bash
# The units for systemd: systemd.sh SOURCE FOLDER. 77 (skipped) where there is no systemd-analyze.
set -euo pipefail
source=$1 folder=$2
# The most exposure that `systemd-analyze security` may find; docs/cluster.md tells it.
limit=1.4

if ! command -v systemd-analyze >/dev/null; then
  printf 'skipped: no systemd-analyze\n'
  exit 77
fi
mkdir -p "$folder"
for unit in "$source"/deploy/systemd/*.service; do
  copy=$folder/$(basename "$unit")
  # Neither the command nor its page need be installed here.
  sed -e 's#^ExecStart=graycube#ExecStart=/bin/true#' -e '/^Documentation=/d' "$unit" >"$copy"
  said=$(systemd-analyze verify "$copy" 2>&1) || { printf '%s\n' "$said"; exit 1; }
  [[ -z $said ]] || { printf '%s\n' "$said"; exit 1; }
  exposure=$(systemd-analyze security --offline=true "$copy" | sed -nE 's/.*exposure level for [^ ]+: ([0-9.]+) .*/\1/p')
  printf '%s: exposure %s\n' "$(basename "$unit")" "$exposure"
  [[ -n $exposure ]] && ! awk "BEGIN { exit !($exposure > $limit) }" || exit 1
done
