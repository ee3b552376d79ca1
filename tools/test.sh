#!/usr/bin/env bash
# Installs what is missing, builds, and executes the tests.
#   tools/test.sh               unit and golden tests, all except those that take seconds each
#   tools/test.sh --long        these
#   tools/test.sh --ci          both, and the fast ones and 2,000 frames under sanitizers: for continuous integration
#   tools/test.sh --nightly     tests that compile other projects: users of an installation, the recipe, builds without a build type
#   tools/test.sh --sanitizers  every test of the libraries under the sanitizers, the slow ones and the scenes' too, and the tests themselves; half a
#                               minute of guided fuzzing each for frames and for the loader
#   tools/test.sh --instrumented  the core's golden scenes under the thread and the memory sanitizer, and 2,000 frames under the first
#   tools/test.sh --matrix      the core alone by g++ and clang++ at -O0, -O2, -O3: the same digests?
#   tools/test.sh --exhaustive  the tests of every value
set -euo pipefail
cd "$(dirname "$0")/.."
trap 'echo "tools/test.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

step() { echo "--- $*"; }

# build PRESET [TARGET...]: configures and builds with $jobs compilers at a time, and shows the log only if that fails.
jobs=$(nproc)
build() {
    local preset=$1 log=build/$1.log
    shift
    mkdir -p build
    if ! { cmake --preset "$preset" && cmake --build --preset "$preset" --parallel "$jobs" ${1:+--target "$@"}; } >"$log" 2>&1; then
        tail -n 60 "$log" >&2
        echo "tools/test.sh: the build failed; all of it stands in $log" >&2
        exit 3
    fi
}

# quietly LOG COMMAND...: shows the end of its output only if it fails.
quietly() {
    local log=build/$1.log
    shift
    "$@" >"$log" 2>&1 || {
        tail -n 60 "$log" >&2
        echo "tools/test.sh: $1 failed; all of its output stands in $log" >&2
        exit 1
    }
}

# sanitizer_preset PRESET: that preset if clang++ is installed, which compiles faster under sanitizers, and whose build can be fuzzed.
sanitizer_preset() { if command -v clang++ >/dev/null; then echo "$1"; else echo asan; fi; }

# Every test of the libraries under the sanitizers.
sanitizers() {
    local preset
    preset=$(sanitizer_preset fuzz)
    step "all tests of the libraries under the address and undefined-behaviour sanitizers (preset $preset)"
    local targets=(rasterizer_test pipeline_test peeling_test scenes_test images_test hardware_check_test core_digests)
    [ "$preset" = asan ] || targets+=(make_corpus load_render_fuzz replay_inputs differential_seeds differential_fuzz)
    build "$preset" "${targets[@]}"
    ctest --test-dir "build/$preset" -LE 'exhaustive|nightly|golden|command|fuzz|lint|specification|docs|browser|python|port|engines|callgrind|afl' -E 'NOT_BUILT|^fuzz-' --output-on-failure -j "$(nproc)"
    if [ "$preset" = asan ]; then
        step "no clang++: fuzzing left out"
        return
    fi
    step "the kept inputs, and fuzzing the loader with glTF bytes and the ways of running a frame against each other"
    ctest --test-dir build/fuzz -R '^fuzz-' --output-on-failure -j "$(nproc)"
}

# The two builds are executed at the same time: the last and longest sources of one leave a processor to the other. The second has half as many
# compilers: six at a time took a fifth longer on two processors. The tests' own sources are not instrumented here.
builds() {
    local preset targets=(rasterizer_test pipeline_test peeling_test core_digests differential_seeds)
    preset=$(sanitizer_preset sanitized)
    step "building, and beside it the core under the address and undefined-behaviour sanitizers (preset $preset)"
    jobs=$(((jobs + 1) / 2)) build "$preset" "${targets[@]}" &
    sanitized=$!  # used by the trap, which outlives the function
    trap 'kill "$sanitized" 2>/dev/null || true' EXIT
    build release
    trap - EXIT
    wait "$sanitized"
}

# The fast tests of the core under the sanitizers, and at the same time 2,000 frames that no earlier commit has tested: scenes and images, which take
# as long to compile again as the core does, are only tested by --sanitizers.
sanitized() {
    local preset first frames
    preset=$(sanitizer_preset sanitized)
    first=$(($(git rev-list --count HEAD 2>/dev/null || echo 0) * 2000))
    step "the fast tests of the core under the sanitizers, and beside them the frames of seeds $first..$((first + 2000))"
    quietly frames "build/$preset/tests/fuzz/differential_seeds" --seeds "$first..$((first + 2000))" &
    frames=$!
    quietly sanitized ctest --test-dir "build/$preset" -LE 'exhaustive|nightly|long|slow|golden|command|fuzz|lint|specification|docs|browser|python|port|engines|afl' -E 'NOT_BUILT|^fuzz-' --output-on-failure -j "$(nproc)"
    quietly sanitized-golden ctest --test-dir "build/$preset/tests/golden" -R 'golden.core_digests.(threads=2|together)' --output-on-failure -j "$(nproc)"
    wait "$frames"
}

# Is a race found, and an uninitialised number? Then the core's own frames: on four threads, and on one by the scalar reference, because the memory
# sanitizer treats a store of some lanes of a vector as one of all.
instrumented() {
    step "the core under the thread sanitizer (preset tsan)"
    build tsan core_digests differential_seeds race
    quietly tsan-race ctest --test-dir build/tsan -R '^faults' --output-on-failure
    quietly tsan-digests build/tsan/tests/golden/core_digests threads=4 tile=8 check=tests/golden/core_digests.txt
    build/tsan/tests/fuzz/differential_seeds --seeds 0..2000 --threads 4
    if ! command -v clang++ >/dev/null; then
        step "no clang++: the memory sanitizer left out"
        return
    fi
    step "the core under the memory sanitizer (preset msan)"
    build msan core_digests unset
    quietly msan-unset ctest --test-dir build/msan -R '^faults' --output-on-failure
    local settings
    for settings in tile=64 "execution=literal tile=8 effects=all"; do
        # The program does not read the file itself, because the library's streams are not instrumented.
        # shellcheck disable=SC2086
        build/msan/tests/golden/core_digests simd=scalar $settings | diff - tests/golden/core_digests.txt
    done
}

# Compares the digests of tests/golden/core_digests.txt with a core of each compiler at each level of optimisation.
matrix() {
    local compiler level folder
    for compiler in g++ clang++; do
        if ! command -v "$compiler" >/dev/null; then
            step "no $compiler: left out"
            continue
        fi
        for level in -O0 -O2 -O3; do
            step "core alone, $compiler $level"
            folder=build/matrix/$compiler$level
            mkdir -p "$folder"
            cmake -S . -B "$folder" -G Ninja -DSTRATA_CORE_ONLY=ON -DCMAKE_BUILD_TYPE= -DCMAKE_CXX_COMPILER="$compiler" \
                -DCMAKE_CXX_FLAGS="$level" >"$folder/build.log"
            cmake --build "$folder" --target core_digests >>"$folder/build.log" 2>&1 || { tail -n 60 "$folder/build.log" >&2; exit 3; }
            "$folder/tests/golden/core_digests" >"$folder/digests.txt"
            diff -u tests/golden/core_digests.txt "$folder/digests.txt" || {
                echo "tools/test.sh: $compiler $level gives other bits than tests/golden/core_digests.txt" >&2
                exit 1
            }
        done
    done
    echo "every compiler and level gives the digests of tests/golden/core_digests.txt"
}

case "${1:-}" in
    "") tools/setup.sh; step "building"; build release; preset=short ;;
    --ci) tools/setup.sh; builds; sanitized; preset=release ;;
    --long) tools/setup.sh; build release; ctest --preset release -L long -j "$(nproc)"; exit 0 ;;
    --nightly) tools/setup.sh; build release; ctest --test-dir build/release -L nightly --output-on-failure -j "$(nproc)"; exit 0 ;;
    --sanitizers) tools/setup.sh; sanitizers; exit 0 ;;
    --instrumented) tools/setup.sh; instrumented; exit 0 ;;
    --matrix) tools/setup.sh; matrix; exit 0 ;;
    --exhaustive) tools/setup.sh; build release; ctest --preset exhaustive -j "$(nproc)"; exit 0 ;;
    *) echo "tools/test.sh: expected nothing, --ci, --long, --nightly, --sanitizers, --instrumented, --matrix or --exhaustive, found '$1'" >&2; exit 2 ;;
esac

step "unit and golden tests"
ctest --preset "$preset" -j "$(nproc)"
