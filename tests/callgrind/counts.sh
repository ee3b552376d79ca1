#!/usr/bin/env bash
# Counts the instructions of callgrind_jobs' jobs and compares them with counts.txt: none may differ by more than 5 %.
#   tests/callgrind/counts.sh build/release/tests/callgrind/callgrind_jobs            exit status 77: nothing could be compared
#   tests/callgrind/counts.sh build/release/tests/callgrind/callgrind_jobs --update   writes counts.txt again
set -euo pipefail
trap 'echo "counts.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR
kept="$(cd "$(dirname "$0")" && pwd)/counts.txt"
program=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

skip() {
    echo "skipped: $*"
    exit 77
}

# count JOB: the instructions between entry and return of strata_counted_job.
count() {
    local status=0
    valgrind --tool=callgrind --toggle-collect=strata_counted_job --callgrind-out-file="$scratch/out" "$program" "$1" \
        >"$scratch/log" 2>&1 || status=$?
    [ "$status" -eq 0 ] || { cat "$scratch/log" >&2; return "$status"; }
    awk '$1 == "totals:" { print $2 }' "$scratch/out"
}

command -v valgrind >/dev/null || skip "no valgrind: the instruction counts were not compared"
compiler=$("$program" --compiler)
jobs=$("$program" --list)
status=0
"$program" "${jobs%%$'\n'*}" || status=$?
[ "$status" -ne 77 ] || skip "this processor has no AVX2, for which the counts were made"

if [ "${2:-}" = --update ]; then
    {
        echo "# Instructions of each job: one thread, AVX2, Release. Made by tests/callgrind/counts.sh PROGRAM --update."
        echo "compiler $compiler"
        for job in $jobs; do echo "$job $(count "$job")"; done
    } >"$scratch/counts"
    mv "$scratch/counts" "$kept"
    cat "$kept"
    exit 0
fi

[ "$(sed -n 's/^compiler //p' "$kept")" = "$compiler" ] ||
    skip "counts.txt is of $(sed -n 's/^compiler //p' "$kept"), this build of $compiler"
worst=0
for job in $jobs; do
    expected=$(awk -v job="$job" '$1 == job { print $2 }' "$kept")
    awk -v job="$job" -v expected="${expected:-0}" -v found="$(count "$job")" 'BEGIN {
        change = expected > 0 ? 100 * (found - expected) / expected : 100
        printf "%-24s expected %10d found %10d %+.2f %%\n", job, expected, found, change
        exit !(change <= 5 && change >= -5)
    }' || worst=1
done
[ "$worst" -eq 0 ] || echo "a count differs by more than 5 %: find out why, then tests/callgrind/counts.sh $program --update" >&2
exit "$worst"
