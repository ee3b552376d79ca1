#!/usr/bin/env bash
# Makes RESULTS.md and pictures/ of this folder anew, in two shards: five minutes of one core of its own. A run that was ended goes on
# where it was. The five cases that take minutes each are left out; strata hard-cases NAME runs them.
set -euo pipefail
cd "$(dirname "$0")/../.."
trap 'echo "tools/hard_cases/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

strata=build/release/strata out=build/hard_cases
slow='layers-500|layer-ladder|counts-past-2048|million-in-a-pixel|frame-16384x1'
mapfile -t names < <("$strata" hard-cases --list | awk 'NR > 1 {print $1}' | grep -vxE "$slow")
"$strata" hard-cases "${names[@]}" -o "$out" --shard 1/2 &
first=$!
"$strata" hard-cases "${names[@]}" -o "$out" --shard 2/2
wait "$first"
"$strata" hard-cases "${names[@]}" -o "$out" --merge 2
cp "$out/RESULTS.md" tools/hard_cases/
cp "$out"/pictures/*.png tools/hard_cases/pictures/
