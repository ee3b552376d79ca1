#!/usr/bin/env bash
# Installs the Debian packages of tools/packages.txt that are missing. Prints nothing if none is.
#   tools/setup.sh program  those for building the program
#   tools/setup.sh [tests]  and those of the tests
#   tools/setup.sh all      and those of tools and tests that are only started by name
#   tools/setup.sh python   those for building the program, and the Python package and its tests
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "tools/setup.sh: $*" >&2; exit 3; }

case "${1:-tests}" in
    program) needed_sets="program" optional_sets="program?" ;;
    tests) needed_sets="program tests" optional_sets="program? tests?" ;;
    all) needed_sets="program tests" optional_sets="program? tests? all?" ;;
    python) needed_sets="program python" optional_sets="program? python?" ;;
    *) echo "tools/setup.sh: expected program, tests, all or python, found '$1'" >&2; exit 2 ;;
esac

# Lines "PACKAGE # why" of the named sets.
listed() { awk -v sets=" $* " '/^[^#]/ && index(sets, " " $1 " ") { $1 = ""; print substr($0, 2) }' tools/packages.txt; }
missing() {
    local package why
    while read -r package why; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null </dev/null)" = installed ] || echo "$package $why"
    done
}
names() { printf '%s\n' "$@" | cut -d ' ' -f 1; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo env DEBIAN_FRONTEND=noninteractive "$@"; fi; }

# The progress of apt-get, from the output of APT::Status-Fd: in place on a terminal, else a line for each quarter.
progress() {
    local line doing percent before=""
    while IFS= read -r line; do
        [[ $line =~ ^(dl|pm)status:.*:([0-9]+)(\.[0-9]*)?:(.*)$ ]] || continue
        if [ "${BASH_REMATCH[1]}" = dl ]; then doing="downloading"; else doing="installing"; fi
        percent=${BASH_REMATCH[2]}
        if [ -t 1 ]; then
            printf '\r  %s %3d %%  %-50.50s' "$doing" "$percent" "${BASH_REMATCH[4]}"
        elif [ "$doing $((percent / 25))" != "$before" ]; then
            before="$doing $((percent / 25))"
            echo "  $doing: $percent %"
        fi
    done
    if [ -t 1 ]; then printf '\r%-80s\r' ""; fi
}
# apt-get makes the descriptor of its status non-blocking, which a script of a package must not have as its standard output: therefore the status has
# a separate descriptor, opened after sudo, which closes it. Other output is shown on failure.
install() {
    local log status=0
    log=$(mktemp)
    as_root sh -c 'exec apt-get install -y -qq --no-install-recommends -o APT::Status-Fd=3 "$@" 3>&1 >&2' \
        install "$@" 2>"$log" | progress || { cat "$log" >&2; status=1; }
    rm -f "$log"
    return "$status"
}
export DEBIAN_FRONTEND=noninteractive

command -v dpkg-query >/dev/null || fail "this is neither Debian 12 nor one of its kin (no dpkg-query, no apt-get); install what tools/packages.txt lists"
# shellcheck disable=SC2086
{
    mapfile -t needed < <(listed $needed_sets | missing)
    mapfile -t optional < <(listed $optional_sets | missing)
}
headers=()
[[ "$needed_sets" != *tests* ]] || mapfile -t headers < <(listed headers | while read -r package _; do [ -d "build/headers/$package" ] || echo "$package"; done)
[ $((${#needed[@]} + ${#optional[@]} + ${#headers[@]})) -gt 0 ] || exit 0

all=("${needed[@]}" "${optional[@]}")
if [ ${#all[@]} -gt 0 ]; then
    mapfile -t packages < <(names "${all[@]}")
    [ "$(id -u)" = 0 ] || command -v sudo >/dev/null || fail "needs root or sudo to install ${packages[*]}"
    echo "installing what is missing:"
    printf '%s\n' "${all[@]}" | awk '{ name = $1; $1 = ""; sub(/^ # /, ""); printf "  %-20s %s\n", name, $0 }'
    as_root apt-get update -qq || fail "apt-get update failed; is there a network?"
    # apt-get's own sentence: the size of the download and of the installation.
    LC_ALL=C apt-get install --assume-no --no-install-recommends "${packages[@]}" 2>/dev/null | sed -n -e 's/^Need to get/  to download:/p' -e 's/^After this operation,/  then:/p' || true
fi
if [ ${#needed[@]} -gt 0 ]; then
    mapfile -t packages < <(names "${needed[@]}")
    install "${packages[@]}" || fail "apt-get could not install ${packages[*]}"
fi
if [ ${#optional[@]} -gt 0 ]; then
    mapfile -t packages < <(names "${optional[@]}")
    install "${packages[@]}" || echo "tools/setup.sh: goes on without ${packages[*]}: what needs them says that it is skipped" >&2
fi
for package in "${headers[@]}"; do
    folder=$(mktemp -d)
    if (cd "$folder" && { apt-get download -qq "$package" || { as_root apt-get update -qq && apt-get download -qq "$package"; } } && dpkg-deb -x ./*.deb unpacked) 2>/dev/null; then
        mkdir -p build/headers && mv "$folder/unpacked" "build/headers/$package"
    else
        echo "tools/setup.sh: goes on without the headers of $package: what needs them says that it is skipped" >&2
    fi
    rm -rf "$folder"
done
