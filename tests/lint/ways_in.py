#!/usr/bin/env python3
"""Checks the entry points of the project: which packages each script installs, and that bash can parse the scripts.

usage: ways_in.py REPOSITORY

tools/packages.txt is lines `set package # why`. The demo installs only the sets `program` and `program?`, which must be exactly the packages that the
program's CMake files need; its report has a light background, because the built-in scenes are dark on black. Exit status 1 and one line per
violation.
"""
import os
import re
import subprocess
import sys
import tempfile

import specification

SETS = {"program", "program?", "tests", "tests?", "all?", "headers", "python", "python?"}
# Packages that only tests and separately labelled tools need.
NOT_FOR_THE_PROGRAM = {"zsh", "parallel", "python3-matplotlib", "catch2", "libboost-dev", "libgmp-dev", "libmpfr-dev", "clang", "valgrind", "locales",
                       "libegl-dev", "libgl1-mesa-dri"}
# Packages by the names with which the program's CMake files find them.
FOUND_BY = {"TBB": "libtbb-dev", "OpenEXR": "libopenexr-dev", "OpenImageIO": "libopenimageio-dev", "PNG": "libpng-dev", "ZLIB": "zlib1g-dev",
            "fmt": "libfmt-dev", "CLI11": "libcli11-dev", "benchmark": "libbenchmark-dev", "nlohmann_json": "nlohmann-json3-dev", "glm": "libglm-dev",
            "TinyGLTF": "libtinygltf-dev", "assimp": "libassimp-dev", "PkgConfig": "pkg-config"}


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def packages(root):
    """{package: set}, and the faults of the list."""
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


def program_packages(root, files, found):
    program = {package for package, which in found.items() if which in {"program", "program?"}}
    for package in sorted(program & NOT_FOR_THE_PROGRAM):
        yield f"tools/packages.txt: {package} is not for the program"
    for file in files:
        if os.path.basename(file) != "CMakeLists.txt":
            continue
        if file.startswith(("tests/", "tools/port", "tools/web", "tools/python", "tools/library/examples", "tools/recipes")):
            continue
        for name in re.findall(r"find_package\((\w+)", read(root, file)):
            if FOUND_BY.get(name) not in program:
                yield f"{file}: finds {name}, which no package of the set `program` brings (tools/packages.txt; FOUND_BY of this test)"


def scripts(root, files):
    for file in files:
        if not file.endswith(".sh") and file != ".ci/run":
            continue
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
    if ended.returncode != 2 or "program, tests, all or python" not in ended.stderr:
        yield "tools/setup.sh: takes a set that it does not know"


APT_GET = """#!/bin/sh
# Says how far it is on the descriptor that it was told, and other things elsewhere.
case "$*" in *APT::Status-Fd=3*) ;; *) exit 0 ;; esac
[ "$(readlink /proc/$$/fd/1)" != "$(readlink /proc/$$/fd/3)" ] || echo "the status shares its descriptor" >&2
echo "Setting up something" ; echo "a note of a package" >&2
echo "pmstatus:something:50.0000:Installing something" >&3
exit {status}
"""


def installation(root):
    """Runs tools/setup.sh with a fake apt-get on a machine without any package: only the progress is printed, or the whole output if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        def run(status):
            for name, text in {"apt-get": APT_GET.replace("{status}", str(status)), "dpkg-query": "#!/bin/sh\nexit 1\n", "sudo": '#!/bin/sh\nexec "$@"\n'}.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
                os.chmod(file.name, 0o755)
            environment = {**os.environ, "PATH": folder + os.pathsep + os.environ["PATH"]}
            return subprocess.run(["tools/setup.sh", "program"], cwd=root, env=environment, capture_output=True, text=True, check=False)
        good, bad = run(0), run(100)
    if good.returncode or "installing: 50 %" not in good.stdout or good.stderr or "Setting up" in good.stdout:
        yield f"tools/setup.sh: does not show progress alone: {good.stdout[-200:]}{good.stderr}"
    if bad.returncode == 0 or "a note of a package" not in bad.stderr or "shares its descriptor" in bad.stderr or "could not install" not in bad.stderr:
        yield f"tools/setup.sh: does not say why an installation fails: {bad.stdout[-200:]}{bad.stderr}"


def main(root):
    found, wrong = packages(root)
    try:
        files = specification.Checkout(root).names
    except specification.NoCheckout:
        print("SKIPPED: the list of files comes from git, and this is no checkout")
        return 77
    wrong += [*program_packages(root, files, found), *scripts(root, files), *installation(root)]
    print("\n".join([*wrong, f"{len(found)} packages, {len(wrong)} faults"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
