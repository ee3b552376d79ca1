#!/usr/bin/env bash
# Submits a sweep as a Slurm job array, a task per shard, and a job after it that joins the shards.
#   tools/cluster/slurm.sh FOLDER SHARDS [OPTIONS OF sbatch...] -- COMMAND...
# COMMAND as for parallel.sh. Its files, FOLDER and the program must be accessible on every node. A requeued task measures its shard again. Prints
# the number of the joining job.
set -euo pipefail
fail() { echo "tools/cluster/slurm.sh: $*" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
. "$here/sweep.sh"

command -v sbatch >/dev/null || fail "expected Slurm's sbatch, found none"
folder=$(realpath -m "$folder")
mkdir -p "$folder"
sweep=$(printf '%q ' "${command[@]}" -o "$folder")
log=(--output "$folder/slurm.%A_%a.log")
array=$(sbatch --parsable --requeue --job-name strata-shards "${log[@]}" --array "1-$shards" "${options[@]}" \
    --wrap "$sweep --shard \$SLURM_ARRAY_TASK_ID/$shards")
sbatch --parsable --job-name strata-join --output "$folder/slurm.join.log" --dependency "afterany:${array%%;*}" "${options[@]}" \
    --wrap "$(printf '%q ' "$here/join.py" "$folder" "$shards")"
