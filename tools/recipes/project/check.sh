#!/usr/bin/env bash
# Builds this project and compares its pictures with the reference. Differences are reported by kind and first pixel; build/pictures has the pictures,
# build/report.xml is for the page of the CI service.
#   STRATA_PREFIX=WHERE ./check.sh     where Strata is installed, if not in a usual place
set -euo pipefail
cd "$(dirname "$0")"
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Debug ${STRATA_PREFIX:+-DCMAKE_PREFIX_PATH=$STRATA_PREFIX}
cmake --build build
export STRATA_PICTURES=$PWD/build/pictures
status=0
build/panes_test || status=1

# The same on the command line, for a program in any language that writes a file of pixels.
PATH=${STRATA_PREFIX:+$STRATA_PREFIX/bin:}$PATH
build/panes build/panes.raw
build/reference build/reference.exr
strata compare build/reference.exr build/panes.raw --layout 64x48:rgba8 --junit build/report.xml || status=1
exit $status
