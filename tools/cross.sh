#!/usr/bin/env bash
# Do other processors give the same bits? Builds the core with Debian's cross compilers and executes it under qemu-user.
#   tools/cross.sh aarch64              the digests of tests/golden/core_digests.txt
#   tools/cross.sh s390x FLOOR [TEST]   a library's tests, too: rasterizer, pipeline or peeling; of names like TEST
# Machines: aarch64, s390x (big-endian), riscv64. Packages: g++-aarch64-linux-gnu, g++-s390x-linux-gnu, g++-riscv64-linux-gnu and
# qemu-user-static; exits with 77 where they are missing.
set -euo pipefail
cd "$(dirname "$0")/.."

machine=${1:-}
library=${2:-}
case "$machine" in
    aarch64|s390x|riscv64) ;;
    *) echo "tools/cross.sh: expected aarch64, s390x or riscv64, found '$machine'" >&2; exit 2 ;;
esac
case "$library" in
    ""|rasterizer|pipeline|peeling) ;;
    *) echo "tools/cross.sh: expected rasterizer, pipeline or peeling, found '$library'" >&2; exit 2 ;;
esac
for program in "$machine-linux-gnu-g++" "qemu-$machine-static"; do
    command -v "$program" >/dev/null || { echo "tools/cross.sh: skipped, for $program is missing" >&2; exit 77; }
done

# The core needs only the headers of the libraries; those of this computer's C library must not be included with them.
folder=$PWD/build/cross/$machine
prefix=$folder/prefix
mkdir -p "$prefix/include" "$prefix/pkgconfig"
for name in boost catch2 fmt glm hwy xxhash.h xxh3.h; do
    [ ! -e "/usr/include/$name" ] || ln -sfn "/usr/include/$name" "$prefix/include/$name"
done
pkg() { printf 'Name: %s\nDescription: headers\nVersion: %s\nCflags: -I%s %s\n' "$1" "$(pkg-config --modversion "$1")" "$prefix/include" "$2" >"$prefix/pkgconfig/$1.pc"; }
pkg libhwy ""
pkg libxxhash -DXXH_INLINE_ALL

# CMake's packages of headers, with this prefix for /usr.
for name in glm fmt Catch2; do mkdir -p "$prefix/$name"; done
interface() { printf 'add_library(%s INTERFACE IMPORTED GLOBAL)\nset_target_properties(%s PROPERTIES INTERFACE_INCLUDE_DIRECTORIES %s %s)\n' "$1" "$1" "$prefix/include" "${2:-}"; }
version() { printf 'set(PACKAGE_VERSION 99)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n' >"$prefix/$1/$1ConfigVersion.cmake"; }
interface glm::glm >"$prefix/glm/glmConfig.cmake"
interface fmt::fmt "INTERFACE_COMPILE_DEFINITIONS FMT_HEADER_ONLY" >"$prefix/fmt/fmtConfig.cmake"
{
    interface Catch2::Catch2
    echo 'list(APPEND CMAKE_MODULE_PATH /usr/lib/cmake/Catch2)'
} >"$prefix/Catch2/Catch2Config.cmake"
for name in glm fmt Catch2; do version $name; done

quietly() { "$@" >>"$folder/build.log" 2>&1 || { tail -n 40 "$folder/build.log" >&2; echo "tools/cross.sh: failed: $*" >&2; exit 1; }; }
: >"$folder/build.log"
quietly env PKG_CONFIG_LIBDIR="$prefix/pkgconfig" cmake -S . -B "$folder" -G Ninja -DSTRATA_CORE_ONLY=ON -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE="$PWD/tools/cmake/cross.cmake" -DSTRATA_MACHINE="$machine" -DSTRATA_WERROR=OFF \
    -Dglm_DIR="$prefix/glm" -Dfmt_DIR="$prefix/fmt" -DCatch2_DIR="$prefix/Catch2" -DCMAKE_CXX_FLAGS="-w -Wno-psabi"
quietly cmake --build "$folder" --target core_digests
"qemu-$machine-static" "$folder/tests/golden/core_digests" check=tests/golden/core_digests.txt
echo "$machine: the digests of tests/golden/core_digests.txt"
[ -z "$library" ] && exit 0
quietly cmake --build "$folder" --target "${library}_test"
"qemu-$machine-static" "$folder/tests/$library/${library}_test" "${3:-~[exhaustive]}"
