#!/usr/bin/env python3
"""Checks the structure of the source tree: includes run downwards, folders hold 5 to 25 files, include chains are short.

usage: folders.py REPOSITORY [--longest-chain N]

`LIBRARIES` lists the folders of each library from the lowest to the highest; a file may include files of its own
folder, of lower folders, and of lower libraries. A file directly in a library, in no folder, is above all folders of its library. Exit status 1 and
one line per violation.
"""
import argparse
import os
import re
import sys

import specification

LIBRARIES = {
    "rasterizer": ["base", "rules", "coverage", "set_up", "chip", "values", "walk"],
    "pipeline": ["formats", "device", "lighting", "vertices", "stages", "textures", "geforce3", "frame", "fragments", "region"],
    "peeling": ["programs", "loops", "algorithms", "audit", "", "frame", "truth"],
    "scenes": ["numbers", "", "gltf/document", "exr", "images", "files", "models", "packs", "procedural", "gltf"],
    "tools": ["port", "lab/hardware_check/drawing", "lab/hardware_check/suites", "request", "oracle", "lab/probe/kit", "lab/probe/files", "lab/probe/search", "library",
              "python", "recipes", "strata", "lab", "web"],
}
# The libraries that each library may include. scenes and peeling do not include each other.
BELOW = {
    "rasterizer": [],
    "pipeline": ["rasterizer"],
    "peeling": ["rasterizer", "pipeline"],
    "scenes": ["rasterizer", "pipeline"],
    "tools": ["rasterizer", "pipeline", "peeling", "scenes"],
}
FEWEST, MOST = 5, 25


def sources(root):
    names = specification.Checkout(root).names
    return [f for f in names if f.endswith((".h", ".cpp")) and f.split("/")[0] in LIBRARIES]


def includes(root, files):
    known = set(files)
    found = {}
    for file in files:
        with open(os.path.join(root, file), encoding="utf-8") as text:
            names = re.findall(r'^#include "([^"]+)"', text.read(), re.MULTILINE)
        found[file] = [name for name in names if name in known]
    return found


def folder_of(file):
    library, _, rest = file.partition("/")
    return library, os.path.dirname(rest)


def height(library, folder):
    """The index of a folder in its library, from the lowest; files in no folder are highest unless the library lists them as ""."""
    folders = LIBRARIES[library]
    matches = [r for r in folders if r and (folder == r or folder.startswith(r + "/"))]
    if matches:
        return folders.index(max(matches, key=len))
    if folder == "":
        return folders.index("") if "" in folders else len(folders)
    return None


def arrows_up(found):
    for file, names in found.items():
        library, folder = folder_of(file)
        own = height(library, folder)
        if own is None:
            yield f"{file}: the folder {library}/{folder} is not in the plan (LIBRARIES of tests/lint/folders.py)"
            continue
        for name in names:
            other_library, other_room = folder_of(name)
            if other_library != library:
                if other_library not in BELOW[library]:
                    yield f"{file}: {library} does not stand on {other_library}, but this includes {name}"
            elif (height(library, other_room) or 0) > own:
                yield f"{file}: {name} stands in a higher folder"


def longest_chain(found):
    """The files of the longest chain of includes; a cycle is cut where it closes."""
    best, on_the_way = {}, set()

    def chain(file):
        if file in best:
            return best[file]
        if file in on_the_way:
            return []
        on_the_way.add(file)
        longest = max((chain(name) for name in found[file]), key=len, default=[])
        on_the_way.discard(file)
        best[file] = [file, *longest]
        return best[file]

    return max((chain(file) for file in found), key=len, default=[])


def circles(found):
    """Headers that include each other in a cycle; an `X_draw.h` included at the end of its `X.h` counts as the same header."""
    state = {}

    def visit(file, way):
        state[file] = "open"
        for name in found[file]:
            if state.get(name) == "open":
                yield [*way[way.index(name):], name] if name in way else [file, name]
            elif name not in state:
                yield from visit(name, [*way, name])
        state[file] = "done"

    for file in found:
        if file not in state:
            yield from visit(file, [file])


def crowded(files):
    folders = {}
    for file in files:
        folders.setdefault(os.path.dirname(file), []).append(file)
    for folder, inside in sorted(folders.items()):
        if "/" in folder and not FEWEST <= len(inside) <= MOST and not folder.startswith("tools/"):
            yield f"{folder}: {len(inside)} files; a folder holds {FEWEST} to {MOST}"


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    options.add_argument("repository")
    options.add_argument("--longest-chain", type=int, default=12, help="the most files that one chain of includes may have")
    given = options.parse_args()
    try:
        files = sources(given.repository)
    except specification.NoCheckout:
        print("SKIPPED: the list of files comes from git, and this is no checkout")
        return 77
    found = includes(given.repository, files)
    faults = [*arrows_up(found), *crowded(files)]
    faults += [" -> ".join(circle) + ": includes run in a circle" for circle in circles(found)]
    chain = longest_chain(found)
    if len(chain) > given.longest_chain:
        faults.append(f"{len(chain)} files in the longest chain of includes, at most {given.longest_chain}:\n    " + "\n    ".join(chain))
    for fault in faults:
        print(fault)
    print(f"{len(files)} sources, longest chain of includes {len(chain)}, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
