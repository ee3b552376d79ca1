#!/usr/bin/env bash
# Installs what is missing, builds the program, and renders two built-in scenes with every algorithm into out/.
set -euo pipefail
cd "$(dirname "$0")/.."
trap 'echo "tools/demo.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

# Executes a command of the build, shows its progress (ninja's [n/m]: in place on a terminal, else a line for each tenth), and all of its output if it
# fails.
log=$(mktemp)
trap 'rm -f "$log"' EXIT
steps() {
    local line shown=-1
    "$@" 2>&1 | tee "$log" | while IFS= read -r line; do
        [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
        if [ -t 1 ]; then
            printf '\r  step %d of %d  ' "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
        elif [ $((BASH_REMATCH[1] * 10 / BASH_REMATCH[2])) != "$shown" ]; then
            shown=$((BASH_REMATCH[1] * 10 / BASH_REMATCH[2]))
            echo "  step ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]}"
        fi
    done || { cat "$log" >&2; return 1; }
    if [ -t 1 ]; then printf '\r%-40s\r' ""; fi
}

tools/setup.sh program
if [ ! -x build/release/strata ]; then
    echo "building the program with $(nproc) compilers at a time: about $((8 / $(nproc) + 1)) minutes the first time"
fi
steps cmake --preset release -DSTRATA_BUILD_TESTS=OFF
steps cmake --build --preset release --target strata

mkdir -p out
look=(--alpha 0.4 --background "1,1,1")
build/release/strata render teapot "${look[@]}" --algorithm dual --size 800x800 --no-audit -o out/first.png >/dev/null
echo "the first picture is there: out/first.png, a transparent teapot by dual depth peeling; now the same by every algorithm"

# Of the real devices, the DirectX 10.1 class supports the most algorithms; it refuses three, with the missing features.
render() {  # render SCENE NAME [OPTIONS]: every algorithm's picture as out/NAME.ALGORITHM.png
    local scene=$1 name=$2
    shift 2
    echo
    echo "$scene"
    build/release/strata render "$scene" --algorithm all --profile geforce8_dx101 --size 800x800 "$@" -o "out/$name.png"
}
render teapot teapot "${look[@]}"
render volume-beam:slices=16 volume-beam
echo
build/release/strata report teapot "${look[@]}" --profile geforce8_dx101 --camera tools/docs/pictures/teapot.json -o out

echo
echo "Open out/report.html in a browser, or look at out/: teapot.dual.png is the teapot by dual depth peeling; the other names say scene and algorithm."
echo "In the tables, 'refused' is an algorithm that needs a feature which this device lacks, and the lines below say what went wrong on the device: both are part of the emulation."
echo "Then try: build/release/strata render MODEL.glb --alpha 0.3 -o out/model.png"
echo "The experiments (strata cost, bench, invariance ...) are built by: cmake --build --preset release --target strata_lab"
