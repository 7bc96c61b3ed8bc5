#!/bin/sh
# run_spin.sh MODEL EXPECTED [-DNAME…]: checks a Promela model exhaustively and says whether the
# outcome is the expected one.
#   holds  no assertion fails and nothing gets stuck
#   ends   the model's LTL claim holds under weak fairness
#   fails  an assertion can fail (the model shows why a rule is needed)
#   stuck  the model can stop before its end (likewise)
# SPIN and CC name the programs. Works in a directory of its own, and removes it.
set -eu

model=$1
expected=$2
shift 2
spin=${SPIN:-spin}
cc=${CC:-cc}
memory_mb=1000
depth=3000000

fail() {
  echo "run_spin.sh: $(basename "$model"): $expected: $1" >&2
  exit 1
}

case $model in /*) ;; *) model=$PWD/$model ;; esac
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT
trap 'exit 1' HUP INT TERM
cd "$directory"

"$spin" -a "$@" "$model" >spin.out 2>&1 || { cat spin.out >&2; fail "spin refuses the model"; }
case $expected in
  ends) "$cc" -O1 -w -DMEMLIM=$memory_mb -DCOLLAPSE -DNFAIR=5 -o pan pan.c; options="-a -f" ;;
  holds | fails | stuck) "$cc" -O1 -w -DMEMLIM=$memory_mb -DCOLLAPSE -DSAFETY -o pan pan.c; options="" ;;
  *) fail "expected is holds, ends, fails or stuck" ;;
esac
# shellcheck disable=SC2086  # options are words
./pan $options -m$depth -w22 >pan.out 2>&1 || true
cat pan.out

# An interrupted or truncated search proves nothing.
for trouble in "max search depth too small" "reached -DMEMLIM" "out of memory"; do
  if grep -q -- "$trouble" pan.out; then fail "search incomplete: $trouble"; fi
done
counterexample() {
  grep -q -- "$1" pan.out || fail "no counterexample found"
  echo "counterexample:"
  trail=$(basename "$model").trail
  shift
  "$spin" -t -p -g -k "$trail" "$@" "$model" 2>/dev/null | tail -n 40 || true
}

case $expected in
  fails) counterexample "assertion violated" "$@" ;;
  stuck) counterexample "invalid end state" "$@" ;;
  *)
    grep -q "errors: 0" pan.out || fail "an error was found"
    if grep -q "Search not completed" pan.out; then fail "search not completed"; fi ;;
esac
