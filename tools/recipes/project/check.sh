#!/usr/bin/env bash
# Builds this project and holds its pictures to the reference. What differs is told by kind and first pixel; build/pictures keeps the
# pictures, build/report.xml is for the service's page.
#   STRATA_PREFIX=WHERE ./check.sh     where Strata is installed, if not in a usual place
set -euo pipefail
cd "$(dirname "$0")"
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Debug ${STRATA_PREFIX:+-DCMAKE_PREFIX_PATH=$STRATA_PREFIX}
cmake --build build
export STRATA_PICTURES=$PWD/build/pictures
status=0
build/panes_test || status=1

# The same from the command line, for a program in any language that leaves a file of pixels behind.
PATH=${STRATA_PREFIX:+$STRATA_PREFIX/bin:}$PATH
build/panes build/panes.raw
build/reference build/reference.exr
strata compare build/reference.exr build/panes.raw --layout 64x48:rgba8 --junit build/report.xml || status=1
exit $status
