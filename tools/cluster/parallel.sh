#!/usr/bin/env bash
# Distributes a sweep of `strata invariance` in shards over several workers, by GNU parallel (Debian package "parallel"), and merges the results.
#   tools/cluster/parallel.sh PLAN FOLDER SHARDS [OPTIONS OF parallel...]
# By default two workers on this computer; "--sshloginfile HOSTS --workdir ..." sends shards to others that have access to the same files. After an
# interruption, start it again: finished shards are skipped (FOLDER/joblog), others resume.
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
