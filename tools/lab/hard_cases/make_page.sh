#!/usr/bin/env bash
# Writes RESULTS.md and its picture, and the whole page to build/hard_cases/RESULTS.html, two shards at once. Needs a release build and GNU parallel.
# Three cases are left out (README.md): frame-8192x8192 takes 6 GiB, and the peels of layer-ladder and counts-past-2048 half an hour.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/lab/hard_cases/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

strata=${STRATA:-build/release/strata} out=${OUT:-build/hard_cases}
mapfile -t names < <("$strata" hard-cases --list | awk 'NR > 1 {print $1}' | grep -vxE 'frame-8192x8192|layer-ladder|counts-past-2048')
tools/cluster/parallel.sh "$out" 64 -- hard-cases "${names[@]}"
tools/lab/hard_cases/page.py "$out" -o tools/lab/hard_cases/RESULTS.md
tools/lab/hard_cases/whole_page.py "$out" -o "$out/RESULTS.html"
