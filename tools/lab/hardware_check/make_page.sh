#!/usr/bin/env bash
# Writes RESULTS.md and its plot, and the whole page to build/hardware_check/RESULTS.html: tools/lab/hardware_check/make_page.sh CAPTURES [STRATA]
# CAPTURES has the files SUITE/NAME.png of abaire/nxdk_pgraph_tests_golden_results (CC0 1.0), or some of them.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/lab/hardware_check/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR
[ $# -ge 1 ] || { echo "usage: tools/lab/hardware_check/make_page.sh CAPTURES [STRATA]" >&2; exit 2; }
captures=$1 strata=${2:-build/release/strata} out=${OUT:-build/hardware_check}
here=tools/lab/hardware_check

status=0
"$strata" hardware-check "$captures" -o "$out" >/dev/null || status=$?
[ "$status" -le 1 ] || exit "$status"  # 1: a picture is outside its bound, which the page reports
"$strata" hardware-check "$captures" --hypotheses >"$out/hypotheses.txt"
rm -f "$here"/RESULTS.*svg
"$here/page.py" "$out" -o "$here/RESULTS.md"
"$here/page.py" "$out" --whole --hypotheses "$out/hypotheses.txt" -o "$out/RESULTS.html"
