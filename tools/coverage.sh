#!/usr/bin/env bash
# Which branches of rasterizer, pipeline and peeling do the tests take, and which conditions of the stages turn a decision round?
#   tools/coverage.sh          builds the core with counters (preset coverage), runs its tests and golden digests, prints the shares
#   tools/coverage.sh --md     the same into tests/coverage/RESULTS.md
# Needs clang-19 and llvm-19 of Debian; exits with 77 where they are missing. Half an hour on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."

for program in clang++-19 llvm-cov-19 llvm-profdata-19; do
    command -v "$program" >/dev/null || { echo "tools/coverage.sh: skipped, for $program is missing" >&2; exit 77; }
done

folder=build/coverage
tests=(rasterizer pipeline peeling)
cmake --preset coverage >/dev/null
cmake --build --preset coverage --target "${tests[@]/%/_test}" core_digests >"$folder/build.log" || { tail -n 40 "$folder/build.log" >&2; exit 3; }

# run NAME COMMAND...: counts into NAME.raw, unless it did since the program was built.
run() {
    local raw=$folder/$1.raw
    shift
    [ "$raw" -nt "$1" ] && return
    LLVM_PROFILE_FILE=$raw.part "$@" >"$raw.log" || { tail -n 40 "$raw.log" >&2; exit 1; }
    mv "$raw.part" "$raw"
}
programs=()
for floor in "${tests[@]}"; do
    programs+=("$folder/tests/$floor/${floor}_test")
    run "$floor" "${programs[-1]}" "~[exhaustive]"
done
digests=$folder/tests/golden/core_digests
for setting in tile=64 "execution=literal tile=8 effects=all" simd=scalar; do
    # shellcheck disable=SC2086  # a setting is several words
    run "digests-${setting//[ =]/-}" "$digests" $setting check=tests/golden/core_digests.txt
done

llvm-profdata-19 merge "$folder"/*.raw -o "$folder/all.profdata"
objects=()
for program in "${programs[@]}"; do objects+=(-object "$program"); done
llvm-cov-19 export -skip-functions -instr-profile="$folder/all.profdata" "$digests" "${objects[@]}" rasterizer pipeline peeling >"$folder/export.json"
tests/coverage/report.py "$folder/export.json" "$@"
