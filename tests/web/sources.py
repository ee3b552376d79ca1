#!/usr/bin/env python3
"""Checks, without generating code, that the sources of the browser's build compile with its C++ library.

usage: sources.py REPOSITORY BUILD

The files and flags are from the native build's compile_commands.json. clang++ parses them as Emscripten of Debian 12 would: with libc++ 13, and for a
target with 32-bit addresses (x32, for which the C library's headers are available). Kernels are parsed for one instruction set. Only
tools/web/build.sh tests the linker and the headers of Emscripten's C library.

Exit status 1 and the compiler's messages for sources that do not compile; 77 without clang++ or without libc++ 13.
"""
import concurrent.futures
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

# The folders where tools/setup.sh unpacks them, where a Debian package installs them, and where Emscripten has them.
HEADERS = ["build/headers/libc++-13-dev/usr/lib/llvm-13/include/c++/v1", "/usr/lib/llvm-13/include/c++/v1", "/usr/share/emscripten/cache/sysroot/include/c++/v1"]
TARGETS = {"strata_rasterizer", "strata_pipeline", "strata_peeling", "strata_web_sources"}
KERNELS = ["-DHWY_COMPILE_ONLY_STATIC", "-msse4.2", "-maes", "-mpclmul"]


def skip(why):
    print(f"SKIPPED: {why}")
    sys.exit(77)


def sources_of(build):
    """(source, its -I, -isystem, -include and -D) for every source of TARGETS."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        for entry in json.load(file):
            words = shlex.split(entry["command"])
            target = re.search(r"CMakeFiles/(\w+)\.dir/", words[words.index("-o") + 1])
            if not target or target[1] not in TARGETS or "cmake_pch" in entry["file"]:
                continue
            options = []
            for word, behind in zip(words, words[1:]):
                if word in ("-isystem", "-include"):
                    options += [word, behind]
                elif word.startswith("-I") or (word.startswith("-D") and not re.match("-D(STRATA_HAS_|HWY_)", word)):
                    options.append(word)
            yield entry["file"], options


def main(repository, build):
    compiler = shutil.which("clang++")
    if not compiler:
        skip("the browser's sources are read by clang++ (Debian: clang), which was not found; tools/setup.sh installs it")
    headers = next((found for found in (os.path.join(repository, path) for path in HEADERS) if os.path.exists(os.path.join(found, "span"))), None)
    if not headers:
        skip("the browser's sources are read with libc++ 13, which was not found; tools/setup.sh unpacks it into build/headers")
    sources = sorted(set((source, tuple(options)) for source, options in sources_of(build)))
    assert len(sources) > 30, f"{build}/compile_commands.json: expected the sources of {sorted(TARGETS)}, found {len(sources)}"

    with tempfile.TemporaryDirectory() as stubs:
        # The C library lists its missing functions in a file per target; that of x32 is in no package that this project needs.
        os.mkdir(os.path.join(stubs, "gnu"))
        open(os.path.join(stubs, "gnu/stubs-x32.h"), "w", encoding="utf-8").close()
        common = [compiler, "-fsyntax-only", "-std=c++20", "--target=x86_64-linux-gnux32", "-nostdinc++", "-isystem", headers, "-isystem", stubs,
                  "-isystem", "/usr/include/x86_64-linux-gnu", "-include", os.path.join(repository, "tools/web/missing_library.h"), *KERNELS]

        def messages(job):
            return subprocess.run([*common, *job[1], job[0]], capture_output=True, text=True, errors="replace", check=False)

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            failed = [result.stderr for result in pool.map(messages, sources) if result.returncode]
    print("".join(failed) + f"{len(sources)} sources read, {len(failed)} with errors")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
