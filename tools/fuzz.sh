#!/usr/bin/env bash
# Fuzzes the inputs that users can supply (tests/fuzz/inputs.h), for any length of time.
#   tools/fuzz.sh TARGET SECONDS         by libFuzzer under the address and undefined-behaviour sanitizers (preset fuzz, needs clang)
#   tools/fuzz.sh --afl TARGET SECONDS   by AFL++ (preset afl, needs afl-fuzz), another engine on the same targets; it begins with the stored inputs
#   tools/fuzz.sh --keep                 stores new inputs in tests/fuzz/corpus: few files that together reach all code that any input reaches
#   tools/fuzz.sh --unpack FOLDER        writes the stored inputs as files, FOLDER/TARGET/*; --pack FOLDER makes the archives again, with the same
# bytes
# Targets: profile, camera, plan, pack, exr, calls or gltf. New inputs are written to build/fuzz/inputs/TARGET, from which --keep takes them, and
# inputs with a fault to build/fuzz/faults; a fault gives exit status 1 (libFuzzer stops at the first). The corpora of AFL++ are in build/afl/out.
set -euo pipefail
cd "$(dirname "$0")/.."

targets=(profile camera plan pack exr calls gltf)
archives=tests/fuzz/corpus  # TARGET.tar.xz
kept=build/fuzz/kept
# An EXR of a kilobyte may claim an attribute of 2 GB, which OpenEXR allocates at once: this is slow under the address sanitizer, whose shadow has an
# eighth of that size.
limits=(-timeout=60 -rss_limit_mb=6000 -malloc_limit_mb=6000 -print_funcs=0 -close_fd_mask=3)

fail() { echo "tools/fuzz.sh: $*" >&2; exit 2; }
is_target() { local one; for one in "${targets[@]}"; do [ "$one" = "$1" ] && return 0; done; return 1; }
# The greatest length of an input in bytes: longer ones take more time and reach no other code.
length_of() { case "$1" in exr|gltf) echo 8192 ;; calls) echo 1536 ;; *) echo 4096 ;; esac; }
quietly() { mkdir -p build; "$@" >build/fuzz.log 2>&1 || { tail -n 30 build/fuzz.log >&2; echo "tools/fuzz.sh: failed: $*" >&2; exit 3; }; }

unpack() { cmake -D FROM="$archives" -D TO="$1" -P tests/fuzz/unpack.cmake; }
# Names in order and no times, so that the same files give the same archive.
pack() {
    local target
    for target in "${targets[@]}"; do [ -d "$1/$target" ] || fail "$1: expected a folder $target, found none"; done
    for target in "${targets[@]}"; do
        tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=0644 --format=ustar -C "$1/$target" -cf - . | xz -9e >"$archives/$target.tar.xz"
    done
}

build_fuzz() {
    quietly cmake --preset fuzz
    quietly cmake --build --preset fuzz --target input_fuzz replay_inputs load_render_fuzz make_corpus
    build/fuzz/tests/fuzz/replay_inputs --write build/fuzz/seeds
    build/fuzz/tests/fuzz/make_corpus build/fuzz/seeds/gltf
}

# The program of a target, built by the preset fuzz or another one.
command_of() { if [ "$1" = gltf ]; then echo "build/${2:-fuzz}/tests/fuzz/load_render_fuzz"; else echo "build/${2:-fuzz}/tests/fuzz/$1_fuzz"; fi; }

fuzz() {
    local target=$1 seconds=$2 status=0
    build_fuzz
    unpack "$kept"
    mkdir -p "build/fuzz/inputs/$target" build/fuzz/faults
    "$(command_of "$target")" "${limits[@]}" -max_len="$(length_of "$target")" -max_total_time="$seconds" -print_final_stats=1 \
        -artifact_prefix="build/fuzz/faults/$target-" "build/fuzz/inputs/$target" "build/fuzz/seeds/$target" "$kept/$target" \
        >"build/fuzz/$target.log" 2>&1 || status=1
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "build/fuzz/$target.log") inputs in $seconds s, status $status; build/fuzz/$target.log"
    return $status
}

# Statistics of afl-fuzz.
afl_stat() { sed -n "s/^$2 *: *//p" "build/afl/out/$1/default/fuzzer_stats"; }

# One fuzzer for TARGET; because the address sanitizer reserves more memory than any limit would allow, there is none (-m none).
fuzz_by_afl() {
    local target=$1 seconds=$2 program
    command -v afl-fuzz >/dev/null || { echo "tools/fuzz.sh: skipped: afl-fuzz is not here (Debian's package afl++)"; exit 77; }
    quietly cmake --preset afl
    quietly cmake --build --preset afl --target input_fuzz load_render_fuzz
    program=$(command_of "$target" afl)
    unpack "$kept"
    rm -rf "build/afl/out/$target"
    mkdir -p "build/afl/out" build/fuzz/faults "build/fuzz/inputs/$target"
    AFL_NO_UI=1 AFL_NO_AFFINITY=1 AFL_SKIP_CPUFREQ=1 AFL_I_DONT_CARE_ABOUT_MISSING_CRASHES=1 \
        afl-fuzz -V "$seconds" -m none -t 10000 -G "$(length_of "$target")" -i "$kept/$target" -o "build/afl/out/$target" -- "$program" \
        >"build/afl/$target.log" 2>&1 || { tail -n 20 "build/afl/$target.log" >&2; exit 1; }
    find "build/afl/out/$target/default/queue" -maxdepth 1 -name 'id:*' ! -name '*orig:*' -exec cp -t "build/fuzz/inputs/$target" {} +
    find "build/afl/out/$target/default/crashes" "build/afl/out/$target/default/hangs" -name 'id:*' -exec cp -t build/fuzz/faults {} +
    echo "$target: $(afl_stat "$target" execs_done) inputs in $(afl_stat "$target" run_time) s by AFL++, $(afl_stat "$target" corpus_found) new paths," \
        "$(afl_stat "$target" saved_crashes) crashes, $(afl_stat "$target" saved_hangs) hangs; build/afl/$target.log"
    [ "$(afl_stat "$target" saved_crashes)$(afl_stat "$target" saved_hangs)" = 00 ]
}

keep() {
    build_fuzz
    unpack "$kept"
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
    pack "$kept"
    echo "$(du -cb "$archives"/*.tar.xz | tail -n 1 | cut -f1) bytes in all"
}

engine=fuzz
case "${1:-}" in
    --keep) keep; exit 0 ;;
    --pack | --unpack) [ $# = 2 ] || fail "$1 needs a folder"; "${1#--}" "$2"; exit 0 ;;
    --afl) engine=fuzz_by_afl; shift ;;
esac
is_target "${1:-}" && [[ "${2:-}" =~ ^[0-9]+$ ]] || fail "expected TARGET SECONDS with TARGET one of ${targets[*]}, found '$*'"
"$engine" "$1" "$2"
