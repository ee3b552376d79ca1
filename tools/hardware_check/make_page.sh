#!/usr/bin/env bash
# Writes RESULTS.md and its plot, and the whole page to build/hardware_check/RESULTS.md: tools/hardware_check/make_page.sh CAPTURES [STRATA]
# CAPTURES has the files SUITE/NAME.png of abaire/nxdk_pgraph_tests_golden_results (CC0 1.0), or some of them.
set -euo pipefail
cd "$(dirname "$0")/../.."
trap 'echo "tools/hardware_check/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR
[ $# -ge 1 ] || { echo "usage: tools/hardware_check/make_page.sh CAPTURES [STRATA]" >&2; exit 2; }
captures=$1 strata=${2:-build/release/strata} out=${OUT:-build/hardware_check}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

status=0
"$strata" hardware-check "$captures" -o "$work/report" >/dev/null || status=$?
[ "$status" -le 1 ] || exit "$status"  # 1: a picture is outside its bound, which the page reports
"$strata" hardware-check "$captures" --hypotheses >"$work/hypotheses.txt"
tools/hardware_check/head.py "$work/report/report.md" tools/hardware_check/RESULTS.svg >tools/hardware_check/RESULTS.md
mkdir -p "$out"
{
    cat tools/hardware_check/introduction.md
    echo
    sed -e '1,2d' -e '/!\[difference\]/d' "$work/report/report.md" | cat -s
    echo
    echo "## Hypotheses, each scored on the captures that it can change"
    echo
    echo '```'
    cat "$work/hypotheses.txt"
    echo '```'
} >"$out/RESULTS.md"
