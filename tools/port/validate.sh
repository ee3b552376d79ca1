#!/bin/bash
# Builds the port and Strata, renders packs of every profile on every installed OpenGL driver, and writes RESULTS.md.
# usage: tools/port/validate.sh [options of validate.py]
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset release -DSTRATA_PORT=ON > /dev/null
cmake --build --preset release --target strata strata_port
exec python3 tools/port/validate.py "$@"
