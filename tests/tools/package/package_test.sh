#!/usr/bin/env bash
# package_test.sh BUILD FOLDER: makes the Debian package of BUILD, installs it by dpkg into an empty root in FOLDER, and uses it there:
# both programs, the image module, completions, and the library by a program that is compiled with it; after its removal no file is left.
# Exit status 77 (skipped) if a necessary program is missing.
set -euo pipefail
build=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
folder=$(realpath "$2")
for program in cpack dpkg dpkg-deb dpkg-shlibdeps; do
    command -v $program >/dev/null || { echo "SKIPPED: the package is made and installed by $program (Debian: dpkg-dev, cmake), which was not found"; exit 77; }
done
[ "$(id -u)" = 0 ] || command -v fakeroot >/dev/null || { echo "SKIPPED: dpkg installs as root or with fakeroot, which was not found"; exit 77; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else fakeroot "$@"; fi; }
fail() { echo "package_test.sh: $*" >&2; exit 1; }

cpack --config "$build/CPackConfig.cmake" -B "$folder" >"$folder/cpack.log" 2>&1 || { tail -n 20 "$folder/cpack.log" >&2; fail "cpack failed"; }
packages=("$folder"/strata_*.deb)
[ ${#packages[@]} = 1 ] && [ -f "${packages[0]}" ] || fail "expected one package, found ${packages[*]}"
depends=$(dpkg-deb -f "${packages[0]}" Depends)
for library in libc6 libtbb libopenimageio libopenexr; do
    [[ $depends == *$library* ]] || fail "expected that it depends on $library, found $depends"
done

root=$folder/root
mkdir -p "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/updates"
touch "$root/var/lib/dpkg/status" "$root/var/lib/dpkg/available"
# Its dependencies are installed in this system, which the empty root does not know; its scripts are executed outside the root, and call only
# ldconfig.
mkdir "$folder/scripts"
ln -s /bin/true "$folder/scripts/ldconfig"
PATH=$folder/scripts:$PATH:/usr/sbin:/sbin
install=(dpkg --root="$root" --force-not-root --force-depends --force-script-chrootless --log=/dev/null)
as_root "${install[@]}" -i "${packages[0]}" >"$folder/dpkg.log" 2>&1 || { cat "$folder/dpkg.log" >&2; fail "dpkg -i failed"; }
cd "$folder"
strata=$root/usr/bin/strata
"$strata" render teapot --size 16x16 --no-audit -q -o here.png
"$build/strata" render teapot --size 16x16 --no-audit -q -o there.png
cmp here.png there.png
"$strata" hard-cases --list >list
"$build/strata" hard-cases --list | cmp - list
"$strata" info --digests here.png >/dev/null  # which loads the image module
for file in share/bash-completion/completions/strata \
    include/strata/strata.h share/doc/strata/copyright; do
    [ -s "$root/usr/$file" ] || fail "expected /usr/$file in the package, found none"
done
mkdir user
printf '#include <strata/strata.h>\nint main() { return strata::version().empty(); }\n' >user/main.cpp
printf 'cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES CXX)\nfind_package(strata REQUIRED COMPONENTS oracle)\nadd_executable(user main.cpp)\ntarget_link_libraries(user PRIVATE strata::library)\n' >user/CMakeLists.txt
cmake -S user -B user/build -G Ninja -DCMAKE_PREFIX_PATH="$root/usr" >user.log 2>&1 && cmake --build user/build >>user.log 2>&1 || { tail -n 20 user.log >&2; fail "a program was not compiled with the library"; }
user/build/user

as_root "${install[@]}" -P strata >>"$folder/dpkg.log" 2>&1
left=$(find "$root" -path "$root/var" -prune -o ! -type d -print)
[ -z "$left" ] || fail "expected that nothing is left, found $left"
echo "$(basename "${packages[0]}"): $(($(stat -c %s "${packages[0]}") / 1024)) KiB, installed, used and removed"
