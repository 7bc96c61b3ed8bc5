#!/usr/bin/env bash
# deploy/slurm/render.sbatch with stand-ins for graycube and Slurm: slurm.sh SOURCE FOLDER. What it passes on, and
# that a render which was told to stop is queued again, but not one that failed or that was done.
set -euo pipefail
source=$1 folder=$2

rm -rf "$folder"
mkdir -p "$folder/bin"
cd "$folder"
cat >bin/graycube <<'END'
#!/usr/bin/env bash
printf '%s\n' "$*" >told
while (($#)); do
  [[ $1 == --checkpoint ]] && checkpoint=$2
  shift
done
trap 'exit 143' TERM
: >"$checkpoint"
case $MODE in
  fails) exit 2 ;;
  done) rm "$checkpoint"; exit 0 ;;
  done-late) trap 'rm "$checkpoint"; exit 0' TERM ;;
esac
touch began
while sleep 0.05; do :; done
END
cat >bin/scontrol <<'END'
#!/usr/bin/env bash
printf '%s\n' "$*" >queued
END
chmod +x bin/*
export PATH=$folder/bin:$PATH SLURM_JOB_ID=77

# expect MODE IS-TOLD STATUS QUEUED
expect() {
  rm -f began queued told ./*.checkpoint
  MODE=$1 bash "$source/deploy/slurm/render.sbatch" 'my scene.json' '' --samples 2 2>err &
  local job=$!
  if [[ $2 == told ]]; then
    until [[ -e began ]]; do sleep 0.01; done
    kill -TERM "$job"
  fi
  local status=0
  wait "$job" || status=$?
  local queued=no
  [[ ! -e queued ]] || queued=$(cat queued)
  if [[ $status != "$3" || $queued != "$4" ]]; then
    printf '%s, %s: status %s, queued %s instead of status %s, queued %s\n' "$1" "$2" "$status" "$queued" "$3" "$4"
    cat err
    exit 1
  fi
}
expect done untold 0 no
grep -qxF 'render my scene.json --algorithm macro -n 16 -o my scene.exr --checkpoint my scene.exr.checkpoint --samples 2' told
expect fails untold 2 no
expect goes-on told 0 'requeue 77'
expect done-late told 0 no
for script in "$source"/deploy/slurm/*.sbatch; do bash -n "$script"; done
printf 'fine\n'
