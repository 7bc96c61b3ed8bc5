#!/usr/bin/env bash
# The files of deploy against schemas: schemas.sh SOURCE FOLDER. The schemas come from npm into FOLDER, once.
# 77 (skipped) where there is no node, or no registry.
set -euo pipefail
source=$1 folder=$2

skip() {
  printf 'skipped: %s\n' "$1"
  exit 77
}
command -v node >/dev/null || skip 'no node'
command -v npm >/dev/null || skip 'no npm'
mkdir -p "$folder"
if ! cmp -s "$source/tests/deploy/package.json" "$folder/installed.json"; then
  cp "$source/tests/deploy/package.json" "$folder/package.json"
  timeout 120 npm install --prefix "$folder" --no-audit --no-fund --ignore-scripts --silent || skip 'npm has no schemas for us'
  cp "$source/tests/deploy/package.json" "$folder/installed.json"
fi

check() { node "$source/tests/deploy/validate.cjs" "$folder" "$@"; }
check kubernetes "$source"/deploy/kubernetes/*.yaml
check compose "$source/deploy/compose.yaml"

# Each mistake is found: the checks can fail.
fails() { # KIND FILE FROM TO
  sed "s/$3/$4/" "$source/deploy/$2" >"$folder/wrong.yaml"
  if cmp -s "$source/deploy/$2" "$folder/wrong.yaml" || check "$1" "$folder/wrong.yaml" >/dev/null; then
    printf '%s with %s instead of %s is not refused\n' "$2" "$4" "$3"
    exit 1
  fi
}
fails kubernetes kubernetes/hosts.yaml podFailurePolicy podFailurePolcy
fails kubernetes kubernetes/hosts.yaml 'action: Ignore' 'action: Skip'
fails kubernetes kubernetes/hosts.yaml 'backoffLimit: 24' 'backoffLimit: many'
fails kubernetes kubernetes/frontal.yaml readOnlyRootFilesystem readonlyRootFilesystem
fails kubernetes kubernetes/service.yaml 'apiVersion: v1' 'apiVersion: v2'
fails compose compose.yaml read_only read_onyl
printf 'fine\n'
