#!/usr/bin/env bash
# Compares the browser's page with the command: tools/web/test.sh [STRATA]. Eleven scenes by every algorithm; needs tools/web/build.sh first.
set -euo pipefail
cd "$(dirname "$0")/../.."
exec /usr/bin/python3 -B tools/web/check_page.py "${1:-build/release/strata}" build/web/page
