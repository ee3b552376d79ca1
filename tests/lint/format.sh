#!/usr/bin/env bash
# Checks that every C++ source is formatted by clang-format 14 (of Debian 12) with .clang-format. Exit status 77 (skipped) without that version.
#   tests/lint/format.sh          names the files that differ
#   tests/lint/format.sh --mend   formats them
set -euo pipefail
cd "$(dirname "$0")/../.."
version=14
formatter=$(command -v clang-format-$version || command -v clang-format || true)
if [ -z "$formatter" ] || ! "$formatter" --version | grep -q "version $version\."; then
    echo "SKIPPED: the format is checked by clang-format $version; found ${formatter:+$("$formatter" --version)}${formatter:-none}"
    exit 77
fi
if ! sources=$(git ls-files '*.h' '*.cpp' 2>/dev/null) || [ -z "$sources" ]; then
    echo "SKIPPED: the list of sources comes from git, and this is no checkout"
    exit 77
fi
case "${1:-}" in
    "") mode=(--dry-run -Werror) ;;
    --mend) mode=(-i) ;;
    *) echo "tests/lint/format.sh: expected nothing or --mend, found '$1'" >&2; exit 2 ;;
esac
if ! xargs -P "$(nproc)" -n 60 "$formatter" "${mode[@]}" <<<"$sources"; then
    echo "tests/lint/format.sh --mend formats these files"
    exit 1
fi
