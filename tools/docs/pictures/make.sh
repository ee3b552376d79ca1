#!/usr/bin/env bash
# Makes the pictures of README.md and of tools/docs again. Needs a release build and oiiotool.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/docs/pictures/make.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

out=tools/docs/pictures work=build/pictures
mkdir -p "$work"
view=(teapot --size 400x300 --camera "$out/teapot.json")
# A row of pictures, without the writer's name and date, so that the bytes are always the same.
row() {  # row FILE PICTURE...
    local file=$1 pictures=()
    shift
    for picture; do pictures+=("$picture" --ch R,G,B); done
    oiiotool "${pictures[@]}" --mosaic:pad=4 "$#x1" --nosoftwareattrib --eraseattrib ".*" -d uint8 -o "$out/$file"
}

# In submission order, peeled, and four times the difference.
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

# Shadow-map peeling on geforce3: with two depths that differ, and the same with a depth bias.
for bias in 0 16; do
    build/release/strata render "${view[@]}" --alpha 0.75 --background 1,1,1 --algorithm shadow_map --profile geforce3 --depth-format d24 \
        --depth-path window_z --reference-path perspective_rq --max-passes 8 --polygon-offset 0,$bias -o "$work/bias.$bias.png" >/dev/null
done
row invariance.png "$work/bias.0.png" "$work/bias.16.png"

# The output of compare --side: for two algorithms (first-peel.md), and for a port without a factor (port-dual.md).
build/release/strata render teapot --size 400x300 --background 1,1,1 --algorithm dual,weighted_average -o "$work/all.png" >/dev/null
build/release/strata compare "$work/all.dual.png" "$work/all.weighted_average.png" --side "$out/first-peel.png" >/dev/null || true
port=(random:seed=3,triangles=200 --size 48x36 --algorithm dual)
build/release/strata render "${port[@]}" -o "$work/right.png" >/dev/null
build/release/strata render "${port[@]}" --mistake program_without_transmittance -o "$work/wrong.png"
build/release/strata compare "$work/right.png" "$work/wrong.png" --side "$work/side.png" >/dev/null || true
oiiotool "$work/side.png" --resample 300% --nosoftwareattrib --eraseattrib ".*" -d uint8 -o "$out/port-dual.png"

# The errors of a peel by a shadow map with biases of 0, 2, 4 and 64 units (bias.md).
rm -rf "$work/planes"
build/release/strata invariance planes:gap=4,count=4 --size 128x96 --depth-format d24 --remedy none,bias:2,bias:4,bias:64 -o "$work/planes" >/dev/null
for cell in 0 1 2 3; do oiiotool "$work/planes/images/000$cell.errors.png" --resample 200% -o "$work/errors.$cell.png"; done
row bias.png "$work"/errors.{0,1,2,3}.png

# A wireframe over glass in submission order and peeled (how-to.md).
build/release/strata render wireframe "${view[@]:1}" --background 1,1,1 --algorithm unsorted,dual -o "$work/wireframe.png" >/dev/null
row wireframe.png "$work/wireframe.unsorted.png" "$work/wireframe.dual.png"

# The light at the eye, and two lights with highlights by OpenGL's formulas and by GeForce3's lighting unit (how-to.md).
lights=(--lights directional,-1,-1,-0.5,color=1:0.9:0.6/point,0,3,2,color=0.2:0.4:1 --light-model specular=1:1:1,shininess=32,separate-specular)
build/release/strata render "${view[@]}" --alpha 0.75 --background 1,1,1 -o "$work/lit.0.png" >/dev/null
build/release/strata render "${view[@]}" --alpha 0.75 --background 1,1,1 "${lights[@]}" -o "$work/lit.1.png" >/dev/null
build/release/strata render "${view[@]}" --alpha 0.75 --background 1,1,1 "${lights[@]}" --profile geforce3 --algorithm depth_units -o "$work/lit.2.png" >/dev/null
row lights.png "$work"/lit.{0,1,2}.png

# A decal by an offset of its own, and distant surfaces by three depth buffers (how-to.md).
/usr/bin/python3 tools/docs/pictures/depths.py build/release/strata

# A report in a browser.
/usr/bin/python3 tools/docs/pictures/report.py build/release/strata
