#!/usr/bin/env bash
# Builds Strata without its tests and installs it, for a container or a runner of continuous integration.
#   tools/recipes/install.sh [PREFIX]    default: /usr/local
# STRATA_PACKAGES=no installs no Debian packages; STRATA_BUILD=FOLDER installs the build of that folder.
set -euo pipefail
prefix=${1:-/usr/local}
cd "$(dirname "$0")/../.."

if [ "${STRATA_PACKAGES:-yes}" != no ]; then
    tools/setup.sh program
fi
if [ -z "${STRATA_BUILD:-}" ]; then
    STRATA_BUILD=build/recipe
    cmake -S . -B "$STRATA_BUILD" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTRATA_BUILD_TESTS=OFF -DSTRATA_WERROR=OFF
    cmake --build "$STRATA_BUILD"
fi
cmake --install "$STRATA_BUILD" --prefix "$prefix"
