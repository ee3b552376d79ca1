#!/usr/bin/env bash
# Builds the page that renders in a browser into build/web/page: tools/web/build.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
command -v emcmake >/dev/null || { echo "tools/web/build.sh: expected Emscripten (Debian: apt-get install emscripten), found none" >&2; exit 2; }
# Emscripten's scripts need Debian's modules, which a node of another origin does not search.
export NODE_PATH="${NODE_PATH:+$NODE_PATH:}/usr/share/nodejs"
emcmake cmake -S . -B build/web -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTRATA_WEB=ON -DSTRATA_CORE_ONLY=ON -DSTRATA_BUILD_TESTS=OFF \
    -DSTRATA_BUILD_TOOLS=OFF -DSTRATA_INSTALL=OFF -DSTRATA_WERROR=OFF >/dev/null
cmake --build build/web "$@"
