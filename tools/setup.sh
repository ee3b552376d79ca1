#!/usr/bin/env bash
# Installs the Debian packages of tools/packages.txt that are missing. Says nothing when none is.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "tools/setup.sh: $*" >&2; exit 3; }

# The names after the mark $1: "" for needed packages, "?" for optional ones.
listed() { sed -e 's/#.*//' tools/packages.txt | awk -v mark="$1" '(mark == "?") == ($1 == "?") && NF { print $NF }'; }
missing() {
    local package
    while read -r package; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null </dev/null)" = installed ] || echo "$package"
    done
}
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }
install() { as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null; }

command -v dpkg-query >/dev/null || fail "expected Debian 12 or one of its kin (dpkg-query, apt-get); elsewhere install what tools/packages.txt lists"
mapfile -t needed < <(listed "" | missing)
mapfile -t optional < <(listed "?" | missing)
[ $((${#needed[@]} + ${#optional[@]})) -gt 0 ] || exit 0

[ "$(id -u)" = 0 ] || command -v sudo >/dev/null || fail "expected root or sudo to install: ${needed[*]} ${optional[*]}"
echo "installing ${needed[*]} ${optional[*]}"
as_root apt-get update -qq || fail "apt-get update failed; is there a network?"
[ ${#needed[@]} = 0 ] || install "${needed[@]}" || fail "apt-get could not install: ${needed[*]}"
[ ${#optional[@]} = 0 ] || install "${optional[@]}" || echo "tools/setup.sh: without ${optional[*]}: no fuzzing, no clang++, no instruction counts, no plots, no GNU parallel, no tools/port" >&2
