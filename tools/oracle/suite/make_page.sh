#!/usr/bin/env bash
# Writes MISTAKES.md and its plot, and the whole table to build/mistakes/MISTAKES.md: every mistake in every scene of the suite, two shards at once.
#   tools/oracle/suite/make_page.sh     Needs a release build, GNU parallel and matplotlib; takes a few minutes.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/oracle/suite/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

build=${BUILD:-build/release} out=${OUT:-build/mistakes}
tools/cluster/parallel.sh "$out" 31 -- "$build/tools/lab/strata_suite_mistakes"
tools/oracle/suite/page.py "$build/strata" "$out" -o tools/oracle/suite/MISTAKES.md --whole "$out/MISTAKES.md"
