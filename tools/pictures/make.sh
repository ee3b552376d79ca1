#!/usr/bin/env bash
# Makes the README's picture anew: the teapot by dual peeling, then its layers 0, 1 and 2 over white. Needs a release build.
set -euo pipefail
cd "$(dirname "$0")/../.."
trap 'echo "tools/pictures/make.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

mkdir -p build/pictures
view=(teapot --size 400x300 --camera tools/pictures/teapot.json --no-audit)
build/release/strata render "${view[@]}" --background 1,1,1 -o build/pictures/all.png >/dev/null
build/release/strata layers "${view[@]}" -o build/pictures/layers.exr >/dev/null
pictures=(build/pictures/all.png --ch 'R,G,B')
for layer in 0 1 2; do
    oiiotool build/pictures/layers.exr --subimage $layer --ch R,G,B,A --pattern constant:color=1,1,1,1 400x300 4 --over \
        --ch R,G,B -d uint8 -o "build/pictures/layer.$layer.png"
    pictures+=("build/pictures/layer.$layer.png")
done
oiiotool "${pictures[@]}" --mosaic:pad=0 4x1 --nosoftwareattrib --eraseattrib ".*" -d uint8 -o tools/pictures/teapot.png
