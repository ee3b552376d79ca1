#!/usr/bin/env bash
# Writes RESULTS.md and its plot, and the whole page to build/invariance/RESULTS.md: the sweeps of results.json and formats.json, and the
# dragon of MODELS if that folder has it.
#   tools/lab/invariance/make_page.sh [MODELS]     (default ../shared/models) Needs a release build and python3-matplotlib.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/lab/invariance/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

models=${1:-../shared/models} out=build/invariance
strata=$(realpath "${STRATA:-build/release/strata}")
rm -rf "$out"  # the results of another plan would be rejected
mkdir -p "$out"
folders=("$out/built-in")
"$strata" invariance --plan tools/lab/invariance/results.json -o "$out/built-in"
if [ -r "$models/dragon.glb" ]; then
    plan=$(realpath tools/lab/invariance/dragon.json) to=$(realpath -m "$out/dragon")
    (cd "$models" && "$strata" invariance --plan "$plan" -o "$to")
    folders+=("$out/dragon")
fi
"$strata" invariance --plan tools/lab/invariance/formats.json --no-images -o "$out/formats"
rm -f tools/lab/invariance/RESULTS.*.svg
report=(tools/lab/invariance/report.py "${folders[@]}" --formats "$out/formats" --title "Invariance: what two depths do to a peel")
"${report[@]}" --short tools/lab/invariance/RESULTS.md
"${report[@]}" --markdown "$out/RESULTS.md"
"${report[@]}"
echo "tools/lab/invariance/RESULTS.md; whole: $out/RESULTS.md, and with pictures ${folders[0]}/index.html"
