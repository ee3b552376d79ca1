#!/usr/bin/env bash
# Installs what is missing, builds, and renders two built-in scenes with every algorithm into out/.
set -euo pipefail
cd "$(dirname "$0")/.."
trap 'echo "tools/demo.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

# Runs a command whose output matters only if it fails.
quietly() {
    local log
    log=$(mktemp)
    if "$@" >"$log" 2>&1; then rm -f "$log"; else
        cat "$log" >&2
        rm -f "$log"
        return 1
    fi
}

tools/setup.sh
[ -x build/release/strata ] || echo "building strata (a few minutes the first time)"
quietly cmake --preset release
quietly cmake --build --preset release --target strata

mkdir -p out
# Of the devices that there were, the DirectX 10.1 class runs the most algorithms; the three that it refuses are told by what they lack.
render() {  # render SCENE NAME [OPTIONS]: every algorithm's picture as out/NAME.ALGORITHM.png
    local scene=$1 name=$2
    shift 2
    echo
    echo "$scene"
    build/release/strata render "$scene" --algorithm all --profile geforce8_dx101 --size 800x800 "$@" -o "out/$name.png"
}
render teapot teapot --alpha 0.4 --background 1,1,1
render volume-beam:slices=16 volume-beam
echo
build/release/strata report teapot --alpha 0.4 --profile geforce8_dx101 --camera tools/docs/pictures/teapot.json -o out

echo
echo "Open out/report.html in a browser, or look at out/: teapot.dual.png is the teapot by dual depth peeling; the other names say scene and algorithm."
echo "In the tables, 'refused' is an algorithm that this device lacks a feature for, and lines below tell what went wrong on the device: both belong to the emulation."
echo "Then try: build/release/strata render MODEL.glb --alpha 0.3 -o out/model.png"
