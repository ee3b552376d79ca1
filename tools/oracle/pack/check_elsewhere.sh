#!/bin/bash
# Checks packs of the usual build with a program that another compiler built, on every instruction set of this processor.
# usage: tools/oracle/pack/check_elsewhere.sh [FOLDER]     FOLDER: the build folder (default: build/elsewhere)
# COMPILER names the other compiler (default: clang++). Exit status 0: every byte is reproduced.
set -euo pipefail
cd "$(dirname "$0")/../../.."
folder=${1:-build/elsewhere}
compiler=${COMPILER:-clang++}
mkdir -p "$folder"
cmake --preset release > /dev/null
cmake --build --preset release --target strata
cmake -S . -B "$folder/other" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
    -DSTRATA_BUILD_TESTS=OFF -DSTRATA_BUILD_TOOLS=OFF -DSTRATA_INSTALL=OFF > /dev/null
cmake --build "$folder/other" --target strata_pack_check
rm -rf "$folder/packs"
write() { build/release/strata golden "${@:2}" -o "$folder/packs/$1"; }
mkdir "$folder/packs"
write teapot teapot --alpha 0.5 --size 48x36 --profile geforce8 --algorithm front_to_back,dual,weighted_average,stencil_routed_k_buffer
write showroom showroom --size 48x48 --profile geforce8_dx101 --algorithm dual_independent,coherent_stencil,layer_peel --depth-format d24
write random random:seed=7,triangles=200 --size 40x40 --profile geforce3 --algorithm shadow_map_depth_replace,painter
write planes hard:case=planes-8-close --size 32x32 --profile ideal --algorithm front_to_back,a_buffer --color-format rgba32f
write port teapot --alpha 0.5 --size 48x36 --profile llvmpipe --algorithm dual,front_to_back
write reversed planes:count=4 --size 32x24 --algorithm dual --depth-order greater --clip-depth zero-to-one
"$compiler" --version | head -1
"$folder/other/tools/oracle/strata_pack_check" "$folder"/packs/*
