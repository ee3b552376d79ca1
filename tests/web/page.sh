#!/usr/bin/env bash
# Builds the page that renders in a browser and compares it with the command: page.sh STRATA. Exit status 77 (skipped) without Emscripten
# or Chromium.
set -euo pipefail
cd "$(dirname "$0")/../.."
for program in emcmake chromium chromedriver; do
    command -v "$program" >/dev/null || { echo "SKIPPED: the page needs $program: apt-get install emscripten chromium chromium-driver python3-selenium"; exit 77; }
done
tools/web/build.sh
exec tools/web/test.sh "$1"
