# Reads FOLDER SHARDS [OPTIONS...] -- COMMAND... into folder, shards, options and command; sourced by parallel.sh and slurm.sh.
[ $# -ge 4 ] || fail "expected FOLDER SHARDS [OPTIONS...] -- COMMAND..., found $# arguments"
folder=$1 shards=$2
shift 2
[[ $shards =~ ^[1-9][0-9]*$ ]] || fail "SHARDS: expected a whole number from 1, found '$shards'"
options=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
[ $# -ge 2 ] || fail "expected -- COMMAND..., found no command"
shift
command=("$@")
if [[ $1 != */* ]]; then
    strata=${STRATA:-$here/../../build/release/strata}
    [ -x "$strata" ] || fail "$strata: expected the built command (STRATA names another)"
    command=("$(realpath "$strata")" "$@")
fi
