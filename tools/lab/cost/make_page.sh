#!/usr/bin/env bash
# Writes RESULTS.md and its plots, and the whole page to build/cost/RESULTS.html: all choices for the dragon and Sponza, and the teapot twice, two
# shards of each at once.
#   tools/lab/cost/make_page.sh [MODELS]     (default ../shared/models) Needs a release build, GNU parallel and python3-matplotlib.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/lab/cost/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

models=${1:-../shared/models} out=${OUT:-build/cost}
# A shard has one thread and measures processor time, which other programs hardly affect.
sweep() { tools/cluster/parallel.sh "$out/$1" 16 -- cost "${@:2}" --alpha 0.5 --threads 1 --clock processor; }

# From the usual 30 degrees the dragon's file happens to list its triangles from back to front, so that the order would not matter.
sweep dragon "$models/dragon.glb" --orbit 120,20 --repeat 5
sweep sponza "$models/sponza.glb" --repeat 5
for run in once again; do sweep "$run" teapot --size 128x128; done
rm -f tools/lab/cost/RESULTS.*.svg
tools/lab/cost/page.py "$out/dragon" "$out/sponza" --twice "$out/once" "$out/again" --short -o tools/lab/cost/RESULTS.md
tools/lab/cost/page.py "$out/dragon" "$out/sponza" -o "$out/RESULTS.html"
