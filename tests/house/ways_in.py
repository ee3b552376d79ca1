#!/usr/bin/env python3
"""Checks the ways into the project: what is installed for whom, and that the scripts can be read by bash.

usage: ways_in.py REPOSITORY

tools/packages.txt is lines `set package # why`. The demo installs the set `program` alone, which the libraries that the program's CMake files ask for
come from and nothing else; its report has a light background, for the built-in scenes are dark on black.
Exit status 1 and a line for each thing that does not hold.
"""
import os
import re
import subprocess
import sys

SETS = {"program", "tests", "tests?", "all?", "headers"}
# What only tests and tools of their own labels use.
NOT_FOR_THE_PROGRAM = {"zsh", "fish", "parallel", "gnuplot-nox", "catch2", "libboost-dev", "libgmp-dev", "libmpfr-dev", "clang", "valgrind", "locales",
                       "libegl-dev", "libgl1-mesa-dri"}
# Packages by the name that a CMake file of the program finds them with.
FOUND_BY = {"TBB": "libtbb-dev", "OpenEXR": "libopenexr-dev", "OpenImageIO": "libopenimageio-dev", "PNG": "libpng-dev", "ZLIB": "zlib1g-dev",
            "fmt": "libfmt-dev", "CLI11": "libcli11-dev", "benchmark": "libbenchmark-dev", "nlohmann_json": "nlohmann-json3-dev", "glm": "libglm-dev",
            "TinyGLTF": "libtinygltf-dev", "PkgConfig": "pkg-config"}


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def packages(root):
    """{package: set}, and what is wrong with the list."""
    found, wrong = {}, []
    for number, line in enumerate(read(root, "tools/packages.txt").splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        match = re.fullmatch(r"(\S+) +(\S+) +# (.+)", line)
        if not match or match[1] not in SETS:
            wrong.append(f"tools/packages.txt:{number}: not `set package # why` of a set that is known: {line}")
        elif match[2] in found:
            wrong.append(f"tools/packages.txt:{number}: {match[2]} stands there twice")
        else:
            found[match[2]] = match[1]
    return found, wrong


def program_packages(root, found):
    program = {package for package, which in found.items() if which == "program"}
    for package in sorted(program & NOT_FOR_THE_PROGRAM):
        yield f"tools/packages.txt: {package} is not for the program"
    files = subprocess.run(["git", "ls-files", "CMakeLists.txt", "*/CMakeLists.txt"], cwd=root, capture_output=True, text=True, check=True).stdout.split()
    for file in files:
        if file.startswith(("tests/", "tools/port", "tools/web", "tools/python", "tools/library/examples", "tools/recipes")):
            continue
        for name in re.findall(r"find_package\((\w+)", read(root, file)):
            if FOUND_BY.get(name) not in program:
                yield f"{file}: finds {name}, which no package of the set `program` brings (tools/packages.txt; FOUND_BY of this test)"


def scripts(root):
    for file in subprocess.run(["git", "ls-files", "*.sh", ".ci/run"], cwd=root, capture_output=True, text=True, check=True).stdout.split():
        ended = subprocess.run(["bash", "-n", file], cwd=root, capture_output=True, text=True, check=False)
        if ended.returncode:
            yield f"{file}: {ended.stderr.strip()}"
    demo = read(root, "tools/demo.sh")
    if re.findall(r"^tools/setup.sh(.*)$", demo, re.MULTILINE) != [" program"]:
        yield "tools/demo.sh: installs more than the set `program`"
    look = re.search(r"^look=\((.*)\)$", demo, re.MULTILINE)
    for line in demo.splitlines():
        if "build/release/strata report" in line and not ("--background" in line or (look and "--background" in look[1] and '"${look[@]}"' in line)):
            yield "tools/demo.sh: the report has no light background"
    ended = subprocess.run(["tools/setup.sh", "nonsense"], cwd=root, capture_output=True, text=True, check=False)
    if ended.returncode != 2 or "program, tests or all" not in ended.stderr:
        yield "tools/setup.sh: takes a set that it does not know"


def main(root):
    found, wrong = packages(root)
    wrong += [*program_packages(root, found), *scripts(root)]
    print("\n".join([*wrong, f"{len(found)} packages, {len(wrong)} faults"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
