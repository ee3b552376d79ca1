#!/usr/bin/env bash
# Installs the packages that only the drivers of engines need: Debian's VTK, Xvfb and Chromium, and the npm packages of packages.txt, each compared
# with its checksum, into build/engines (or FOLDER).
#   tools/port/engines/install.sh [FOLDER]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=${1:-$here/../../../build/engines}
fail() { echo "tools/port/engines/install.sh: $*" >&2; exit 3; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

packages=(python3-vtk9 python3-numpy xvfb chromium)
command -v npm >/dev/null || packages+=(npm)
lacking=()
for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || lacking+=("$package")
done
if [ ${#lacking[@]} -gt 0 ]; then
    as_root apt-get update -qq || fail "apt-get update failed; is there a network?"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq "${lacking[@]}" >/dev/null || fail "apt-get could not install: ${lacking[*]}"
fi

mkdir -p "$folder"
cd "$folder"
while read -r name version sum; do
    case $name in ''|'#'*) continue ;; esac
    [ "$(cat "$name/.installed" 2>/dev/null)" = "$version $sum" ] && continue
    archive=$(npm pack --silent "$name@$version") || fail "npm could not fetch $name@$version"
    found=sha512-$(node -p 'crypto.createHash("sha512").update(fs.readFileSync(process.argv[1])).digest("base64")' "$archive")
    [ "$found" = "$sum" ] || fail "$name@$version: expected checksum $sum, found $found"
    rm -rf "$name"
    mkdir -p "$name"
    tar xzf "$archive" -C "$name" --strip-components 1 --exclude '*.map' --exclude 'package/lib/commonjs'
    rm "$archive"
    echo "$version $sum" >"$name/.installed"
done <"$here/packages.txt"
echo "the engines are in $(pwd)"
