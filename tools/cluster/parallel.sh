#!/usr/bin/env bash
# A sweep of `strata invariance` in shards on several workers, by GNU parallel (Debian package "parallel"), then merged.
#   tools/cluster/parallel.sh PLAN FOLDER SHARDS [OPTIONS OF parallel...]
# By default two workers on this machine; "--sshloginfile HOSTS --workdir ..." sends shards to others that see the same files.
# Run again after any interruption: shards that are done are skipped (FOLDER/joblog), others go on where they stopped.
set -euo pipefail
fail() { echo "tools/cluster/parallel.sh: $*" >&2; exit 2; }

[ $# -ge 3 ] || fail "expected PLAN FOLDER SHARDS, found $# arguments"
plan=$1 folder=$2 shards=$3
shift 3
strata=${STRATA:-$(cd "$(dirname "$0")/../.." && pwd)/build/release/strata}
[ -x "$strata" ] || fail "$strata: expected the built command (STRATA names another)"
[ -r "$plan" ] || fail "$plan: expected a plan, found no readable file"
[[ $shards =~ ^[1-9][0-9]*$ ]] || fail "SHARDS: expected a whole number from 1, found '$shards'"
command -v parallel >/dev/null || fail "expected GNU parallel (apt-get install parallel), found none"

mkdir -p "$folder"
parallel --will-cite --jobs 2 --joblog "$folder/joblog" --resume --resume-failed "$@" \
    "$strata" invariance --plan "$plan" -o "$folder" --threads 1 --shard "{}/$shards" ::: $(seq "$shards")
"$strata" invariance --plan "$plan" -o "$folder" --merge "$shards"
