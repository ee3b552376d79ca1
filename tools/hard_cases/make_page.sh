#!/usr/bin/env bash
# Writes RESULTS.md and its picture, and the whole page with a picture per case to build/hard_cases, in two shards at once. Resumes after an
# interruption. Three cases are omitted (README.md): frame-8192x8192 takes 6 GiB, and the peels of layer-ladder and counts-past-2048 half an hour.
set -euo pipefail
cd "$(dirname "$0")/../.."
trap 'echo "tools/hard_cases/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

strata=${STRATA:-build/release/strata} out=${OUT:-build/hard_cases}
mkdir -p "$out"
mapfile -t names < <("$strata" hard-cases --list | awk 'NR > 1 {print $1}' | grep -vxE 'frame-8192x8192|layer-ladder|counts-past-2048')

# Stores the processor time, so that the times of interrupted calls are added.
shard() {
  TIMEFORMAT=%U
  { time "$strata" hard-cases "${names[@]}" -o "$out" --shard "$1" 2>&3; } 3>&2 2>>"$out/processor_seconds"
}
shard 1/2 &
first=$!
shard 2/2
wait "$first"
"$strata" hard-cases "${names[@]}" -o "$out" --merge 2
tools/hard_cases/page.py "$out" -o tools/hard_cases/RESULTS.md
