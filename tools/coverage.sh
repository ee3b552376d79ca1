#!/usr/bin/env bash
# Counts the branches of rasterizer, pipeline and peeling that the tests execute, and the conditions of the stages that alone change a decision.
#   tools/coverage.sh          builds the core with counters (preset coverage), executes its tests, golden digests and three thousand
#                              frames of tests/fuzz, prints the shares
#   tools/coverage.sh --md     writes the same to tests/coverage/RESULTS.md
# Needs clang-19 and llvm-19 of Debian; exits with 77 where they are missing. Some eight minutes on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."

for program in clang++-19 llvm-cov-19 llvm-profdata-19; do
    command -v "$program" >/dev/null || { echo "tools/coverage.sh: skipped, for $program is missing" >&2; exit 77; }
done

folder=build/coverage
tests=(rasterizer pipeline peeling)
cmake --preset coverage >/dev/null
cmake --build --preset coverage --target "${tests[@]/%/_test}" core_digests differential_seeds >"$folder/build.log" || { tail -n 40 "$folder/build.log" >&2; exit 3; }

# run NAME PROGRAM ARGUMENT...: counts into NAME.raw, unless that file is newer than the program.
run() {
    local raw=$folder/$1.raw
    shift
    [ "$raw" -nt "$1" ] && return
    LLVM_PROFILE_FILE=$raw.part "$@" >"$raw.log" || { tail -n 40 "$raw.log" >&2; exit 1; }
    mv "$raw.part" "$raw"
}

# export_counts NAME PROGRAM: the counts of NAME*.raw for the three libraries. One program at a time: given several, LLVM's tools lose functions that
# have the same name and differ.
export_counts() {
    llvm-profdata-19 merge "$folder/$1"*.raw -o "$folder/$1.profdata"
    llvm-cov-19 export -skip-functions -instr-profile="$folder/$1.profdata" "$2" rasterizer pipeline peeling >"$folder/$1.json"
}

exports=()
for library in "${tests[@]}"; do
    program=$folder/tests/$library/${library}_test
    run "$library" "$program" "~[exhaustive]"
    export_counts "$library" "$program"
    exports+=("$folder/$library.json")
done
digests=$folder/tests/golden/core_digests
for setting in tile=64 "execution=literal tile=8 effects=all" simd=scalar; do
    # shellcheck disable=SC2086  # a setting is several words
    run "digests-${setting//[ =]/-}" "$digests" $setting check=tests/golden/core_digests.txt
done
export_counts digests "$digests"
seeds=$folder/tests/fuzz/differential_seeds
run seeds "$seeds" --seeds 0..3000
export_counts seeds "$seeds"

tests/coverage/report.py "${exports[@]}" "$folder/digests.json" "$folder/seeds.json" "$@"
