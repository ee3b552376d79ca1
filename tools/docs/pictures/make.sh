#!/usr/bin/env bash
# Makes the pictures of README.md and of tools/docs anew. Needs a release build and oiiotool.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/docs/pictures/make.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

out=tools/docs/pictures work=build/pictures
mkdir -p "$work"
view=(teapot --size 400x300 --camera "$out/teapot.json")
# One row of pictures, without the writer's name and date: the same bytes every time.
row() {  # row FILE PICTURE...
    local file=$1 pictures=()
    shift
    for picture; do pictures+=("$picture" --ch R,G,B); done
    oiiotool "${pictures[@]}" --mosaic:pad=4 "$#x1" --nosoftwareattrib --eraseattrib ".*" -d uint8 -o "$out/$file"
}

# As the triangles come, peeled, and four times the difference.
build/release/strata render "${view[@]}" --alpha 0.75 --background 1,1,1 --algorithm unsorted,dual -o "$work/problem.png" >/dev/null
oiiotool "$work/problem.unsorted.png" "$work/problem.dual.png" --absdiff --mulc 4 --ch R,G,B -o "$work/difference.png"
row problem.png "$work/problem.unsorted.png" "$work/problem.dual.png" "$work/difference.png"

# The picture, then its layers 0, 1 and 2 over white.
build/release/strata render "${view[@]}" --background 1,1,1 -o "$work/all.png" >/dev/null
build/release/strata layers "${view[@]}" -o "$work/layers.exr" >/dev/null
layers=()
for layer in 0 1 2; do
    oiiotool "$work/layers.exr" --subimage $layer --ch R,G,B,A --pattern constant:color=1,1,1,1 400x300 4 --over \
        -d uint8 -o "$work/layer.$layer.png"
    layers+=("$work/layer.$layer.png")
done
row layers.png "$work/all.png" "${layers[@]}"

# Every target of dual peeling after every pass.
build/release/strata passes "${view[@]/400x300/200x150}" --background 1,1,1 --algorithm dual -o "$work/passes" >/dev/null
oiiotool "$work/passes/contact.png" --nosoftwareattrib --eraseattrib ".*" -d uint8 -o "$out/passes.png"

# Shadow-map peeling of the first device: two depths that differ, and the same with a depth bias.
for bias in 0 4; do
    build/release/strata render "${view[@]}" --alpha 0.75 --background 1,1,1 --algorithm shadow_map --profile geforce3 --depth d24 \
        --depth-path window_z --reference-path perspective_rq --max-passes 8 --polygon-offset 0,$bias -o "$work/bias.$bias.png" >/dev/null
done
row invariance.png "$work/bias.0.png" "$work/bias.4.png"

# A report, as a browser shows it.
/usr/bin/python3 tools/docs/pictures/report.py build/release/strata
