#!/usr/bin/env bash
# Submits a sweep of `strata invariance` as a Slurm job array, a task per shard, and a job that merges the results.
#   tools/cluster/slurm.sh PLAN FOLDER SHARDS [OPTIONS OF sbatch...]
# PLAN, FOLDER and the command must be accessible on every node. A requeued task resumes; submit again after a failure: finished cells are not
# measured again. Prints the number of the merging job.
set -euo pipefail
fail() { echo "tools/cluster/slurm.sh: $*" >&2; exit 2; }

[ $# -ge 3 ] || fail "expected PLAN FOLDER SHARDS, found $# arguments"
plan=$(realpath "$1") folder=$(realpath -m "$2") shards=$3
shift 3
strata=${STRATA:-$(cd "$(dirname "$0")/../.." && pwd)/build/release/strata}
[ -x "$strata" ] || fail "$strata: expected the built command (STRATA names another)"
[ -r "$plan" ] || fail "$plan: expected a plan, found no readable file"
[[ $shards =~ ^[1-9][0-9]*$ ]] || fail "SHARDS: expected a whole number from 1, found '$shards'"
command -v sbatch >/dev/null || fail "expected Slurm's sbatch, found none"

mkdir -p "$folder"
sweep=$(printf '%q ' "$strata" invariance --plan "$plan" -o "$folder")
log=(--output "$folder/slurm.%A_%a.log")
array=$(sbatch --parsable --requeue --job-name strata-shards "${log[@]}" --array "1-$shards" "$@" \
    --wrap "$sweep --threads \${SLURM_CPUS_PER_TASK:-1} --shard \$SLURM_ARRAY_TASK_ID/$shards")
sbatch --parsable --job-name strata-merge --output "$folder/slurm.merge.log" --dependency "afterok:${array%%;*}" "$@" \
    --wrap "$sweep --merge $shards"
