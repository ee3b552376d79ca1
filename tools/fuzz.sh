#!/usr/bin/env bash
# Fuzzes what people hand to the program (tests/fuzz/inputs.h), as long as one likes.
#   tools/fuzz.sh TARGET SECONDS         by libFuzzer under the address and undefined-behaviour sanitizers (preset fuzz, needs clang)
#   tools/fuzz.sh --keep                 takes what was found into tests/fuzz/corpus: few files that together reach all the code that all reach
# Targets: profile, camera, plan, pack, exr, calls or gltf. What is found stays in build/fuzz/inputs/TARGET; a fault ends the run with status 1 and
# leaves its bytes in build/fuzz/faults.
set -euo pipefail
cd "$(dirname "$0")/.."

targets=(profile camera plan pack exr calls gltf)
kept=tests/fuzz/corpus
# An EXR of a kilobyte may claim an attribute of 2 GB, for which OpenEXR asks at once: slow under the address sanitizer, whose shadow is
# an eighth of that.
limits=(-timeout=60 -rss_limit_mb=6000 -malloc_limit_mb=6000 -print_funcs=0 -close_fd_mask=3)

fail() { echo "tools/fuzz.sh: $*" >&2; exit 2; }
is_target() { local one; for one in "${targets[@]}"; do [ "$one" = "$1" ] && return 0; done; return 1; }
# The longest input, bytes: longer ones take time and reach nothing new.
length_of() { case "$1" in exr|gltf) echo 8192 ;; calls) echo 1536 ;; *) echo 4096 ;; esac; }
quietly() { mkdir -p build; "$@" >build/fuzz.log 2>&1 || { tail -n 30 build/fuzz.log >&2; echo "tools/fuzz.sh: failed: $*" >&2; exit 3; }; }

build_fuzz() {
    quietly cmake --preset fuzz
    quietly cmake --build --preset fuzz --target input_fuzz replay_inputs load_render_fuzz make_corpus
    build/fuzz/tests/fuzz/replay_inputs --write build/fuzz/seeds
    build/fuzz/tests/fuzz/make_corpus build/fuzz/seeds/gltf
}

# The program of a target.
command_of() { if [ "$1" = gltf ]; then echo build/fuzz/tests/fuzz/load_render_fuzz; else echo "build/fuzz/tests/fuzz/$1_fuzz"; fi; }

fuzz() {
    local target=$1 seconds=$2 status=0
    build_fuzz
    mkdir -p "build/fuzz/inputs/$target" build/fuzz/faults
    # shellcheck disable=SC2046
    "$(command_of "$target")" "${limits[@]}" -max_len="$(length_of "$target")" -max_total_time="$seconds" -print_final_stats=1 \
        -artifact_prefix="build/fuzz/faults/$target-" "build/fuzz/inputs/$target" "build/fuzz/seeds/$target" $([ -d "$kept/$target" ] && echo "$kept/$target") \
        >"build/fuzz/$target.log" 2>&1 || status=1
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$target.log") inputs in $seconds s, status $status; build/fuzz/$target.log"
    return $status
}

keep() {
    build_fuzz
    local target
    for target in "${targets[@]}"; do
        local from=() folder
        for folder in "build/fuzz/inputs/$target" "build/fuzz/seeds/$target" "$kept/$target"; do
            if [ -d "$folder" ]; then from+=("$folder"); fi
        done
        rm -rf build/fuzz/minimal && mkdir build/fuzz/minimal
        "$(command_of "$target")" "${limits[@]}" -set_cover_merge=1 -max_len="$(length_of "$target")" build/fuzz/minimal "${from[@]}" >build/fuzz/merge.log 2>&1 ||
            { tail -n 20 build/fuzz/merge.log >&2; exit 1; }
        rm -rf "${kept:?}/$target" && mkdir -p "$kept/$target" && mv build/fuzz/minimal/* "$kept/$target/"
        echo "$target: $(find "$kept/$target" -type f | wc -l) inputs"
    done
    echo "$(du -sb "$kept" | cut -f1) bytes in all"
}

case "${1:-}" in
    --keep) keep ;;
    *) is_target "${1:-}" && [[ "${2:-}" =~ ^[0-9]+$ ]] || fail "expected TARGET SECONDS with TARGET one of ${targets[*]}, found '$*'"; fuzz "$1" "$2" ;;
esac
