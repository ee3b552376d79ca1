#!/usr/bin/env bash
# npm.sh STRATA FOLDER: makes the npm package of the renderer, installs it into a new folder, and calls it from Node.js: npm_test.js. Its types are
# checked if tsc is installed (Debian: node-typescript). Exit status 77 (skipped) without Emscripten, Node.js or npm.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
strata=$(realpath "$1")
for program in emcmake node npm; do
    command -v "$program" >/dev/null || { echo "SKIPPED: the npm package needs $program: apt-get install emscripten nodejs npm"; exit 77; }
done
rm -rf "$2"
mkdir -p "$2/user"
folder=$(realpath "$2")
"$here/../../tools/web/build.sh"
npm pack --silent "$here/../../build/web/npm" --pack-destination "$folder" >/dev/null
packages=("$folder"/*.tgz)
[ ${#packages[@]} = 1 ] && [ -f "${packages[0]}" ] || { echo "npm.sh: expected one package, found ${packages[*]}" >&2; exit 1; }
cp "$here/npm_test.js" "$here/npm_types.ts" "$folder/user"
cd "$folder/user"
npm install --silent --offline --no-audit --no-fund --no-package-lock --prefix . "${packages[0]}"
if command -v tsc >/dev/null; then
    tsc --noEmit --strict --target es2020 --moduleResolution node npm_types.ts
else
    echo "SKIPPED: the types are checked by tsc (Debian: node-typescript), which was not found"
fi
node npm_test.js "$strata"
echo "$(basename "${packages[0]}"): $(($(stat -c %s "${packages[0]}") / 1024)) KiB, installed and called"
