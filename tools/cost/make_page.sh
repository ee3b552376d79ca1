#!/usr/bin/env bash
# Writes RESULTS.md and its pictures, and the whole page to build/cost/RESULTS.md: all options for the dragon and Sponza, in two shards at once, and
# the teapot twice.
#   tools/cost/make_page.sh [MODELS]     (default ../shared/models) Needs a release build. Resumes after an interruption.
set -euo pipefail
cd "$(dirname "$0")/../.."
trap 'echo "tools/cost/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

models=${1:-../shared/models} out=${OUT:-build/cost}
strata=${STRATA:-build/release/strata}
TIMEFORMAT='a shard: %U s of processor time, %R s on the clock'

# Takes a folder's name, a scene and its options. A shard has one thread and measures processor time, which other programs do not affect.
sweep() {
  local folder=$out/$1
  shift
  local words=("$@" --alpha 0.5 --threads 1 --clock processor -o "$folder")
  time "$strata" cost "${words[@]}" --shard 1/2 &
  local first=$!
  time "$strata" cost "${words[@]}" --shard 2/2
  wait "$first"
  "$strata" cost "${words[@]}" --merge 2 >"$folder/report.txt"
}

# From the usual 30 degrees the dragon's file happens to list its triangles from back to front, so that the order would not matter.
sweep dragon "$models/dragon.glb" --orbit 120,20 --repeat 5
sweep sponza "$models/sponza.glb" --repeat 5
for run in once again; do sweep "$run" teapot --size 128x128; done
rm -f tools/cost/RESULTS.*.svg
tools/cost/page.py "$out/dragon" "$out/sponza" --twice "$out/once" "$out/again" -o tools/cost/RESULTS.md --whole "$out/RESULTS.md"
