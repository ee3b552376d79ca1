#!/usr/bin/env bash
# Measures a sweep in shards by GNU parallel (Debian package "parallel"), and joins them.
#   tools/cluster/parallel.sh FOLDER SHARDS [OPTIONS OF parallel...] -- COMMAND...
# COMMAND is a subcommand of strata with --shard (invariance, cost, hard-cases, multisampling) and its arguments, or a path of an executable that
# takes -o FOLDER and --shard K/N. By default two workers on this computer; "--sshloginfile HOSTS --workdir ..." sends shards to others that have
# access to the same files. After an interruption, start it again: finished shards are skipped (FOLDER/joblog), others are measured again.
set -euo pipefail
fail() { echo "tools/cluster/parallel.sh: $*" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
. "$here/sweep.sh"

command -v parallel >/dev/null || fail "expected GNU parallel (apt-get install parallel), found none"
mkdir -p "$folder"
status=0
parallel --will-cite --quote --jobs 2 --joblog "$folder/joblog" --resume --resume-failed "${options[@]}" \
    "${command[@]}" -o "$folder" --shard "{}/$shards" ::: $(seq "$shards") || status=$?
"$here/join.py" "$folder" "$shards" || exit 2
exit "$((status > 0))"  # 1: a shard has this status, for instance because a hard case failed
