#!/usr/bin/env bash
# Makes RESULTS.md and its pictures anew: all knobs on the dragon, and on Sponza, whose literal runs are long, those of peels and chain.
#   tools/cost/make_page.sh [MODELS]     (default ../shared/models) Needs a release build. A sweep that was stopped goes on.
set -euo pipefail
cd "$(dirname "$0")/../.."
trap 'echo "tools/cost/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

models=${1:-../shared/models} out=build/cost
strata=${STRATA:-build/release/strata}
"$strata" cost "$models/dragon.glb" --alpha 0.5 -o "$out/dragon"
"$strata" cost "$models/sponza.glb" --alpha 0.5 --knob average_count,peels,chain,alone -o "$out/sponza"
rm -f tools/cost/RESULTS.*.svg
tools/cost/page.py "$out/dragon" "$out/sponza" -o tools/cost/RESULTS.md
