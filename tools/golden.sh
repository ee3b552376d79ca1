#!/usr/bin/env bash
# Writes tests/golden/*.txt again. A golden never changes silently: read the difference and say in the commit why it is right.
set -euo pipefail
cd "$(dirname "$0")/.."
trap 'echo "tools/golden.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

tools/setup.sh
cmake --preset release >/dev/null
cmake --build --preset release --target scene_digests core_digests >/dev/null
mkdir -p build/golden
build/release/tests/golden/scene_digests >build/golden/scene_digests.txt
build/release/tests/golden/core_digests >build/golden/core_digests.txt
mv build/golden/scene_digests.txt build/golden/core_digests.txt tests/golden/
