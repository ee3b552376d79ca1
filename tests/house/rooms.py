#!/usr/bin/env python3
"""Checks the plan of the house: includes run downwards, rooms hold 5 to 25 files, include chains are short.

usage: rooms.py REPOSITORY [--longest-chain N]

A room is a folder. `FLOORS` lists the rooms of each floor from the lowest to the highest; a file may include files of its own
room, of lower rooms, and of lower floors. A file that stands at a floor's door (in no room) is above all rooms of its floor.
Exit status 1 and a line for each thing that does not hold.
"""
import argparse
import os
import re
import subprocess
import sys

FLOORS = {
    "rasterizer": ["base", "rules", "coverage", "set_up", "chip", "values", "walk"],
    "pipeline": ["formats", "device", "vertices", "stages", "textures", "geforce3", "frame", "fragments", "region"],
    "peeling": ["programs", "loops", "algorithms", "audit", "", "truth"],
    "scenes": ["numbers", "", "gltf/document", "exr", "images", "files", "models", "packs", "procedural", "gltf"],
    "tools": ["port", "hardware_check", "oracle", "probe", "library", "python", "recipes", "strata", "lab", "bench", "web"],
}
# Which floors a floor stands on. scenes stands beside peeling.
BELOW = {
    "rasterizer": [],
    "pipeline": ["rasterizer"],
    "peeling": ["rasterizer", "pipeline"],
    "scenes": ["rasterizer", "pipeline"],
    "tools": ["rasterizer", "pipeline", "peeling", "scenes"],
}
FEWEST, MOST = 5, 25


def sources(root):
    listed = subprocess.run(["git", "ls-files", *FLOORS], cwd=root, capture_output=True, text=True, check=True)
    return [f for f in listed.stdout.split("\n") if f.endswith((".h", ".cpp")) and os.path.exists(os.path.join(root, f))]


def includes(root, files):
    known = set(files)
    found = {}
    for file in files:
        with open(os.path.join(root, file), encoding="utf-8") as text:
            names = re.findall(r'^#include "([^"]+)"', text.read(), re.MULTILINE)
        found[file] = [name for name in names if name in known]
    return found


def room_of(file):
    floor, _, rest = file.partition("/")
    return floor, os.path.dirname(rest)


def height(floor, room):
    """The number of a room in its floor, from below; the door is the highest unless the floor lists it as ""."""
    rooms = FLOORS[floor]
    matches = [r for r in rooms if r and (room == r or room.startswith(r + "/"))]
    if matches:
        return rooms.index(max(matches, key=len))
    if room == "":
        return rooms.index("") if "" in rooms else len(rooms)
    return None


def arrows_up(found):
    for file, names in found.items():
        floor, room = room_of(file)
        own = height(floor, room)
        if own is None:
            yield f"{file}: the room {floor}/{room} is not in the plan (FLOORS of tests/house/rooms.py)"
            continue
        for name in names:
            other_floor, other_room = room_of(name)
            if other_floor != floor:
                if other_floor not in BELOW[floor]:
                    yield f"{file}: {floor} does not stand on {other_floor}, but this includes {name}"
            elif (height(floor, other_room) or 0) > own:
                yield f"{file}: {name} stands in a higher room"


def longest_chain(found):
    """The files of the longest chain of includes; a circle is cut where it closes."""
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
    """Headers that include each other in a circle; `X_draw.h` at the end of its own `X.h` is one header in two files."""
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
    rooms = {}
    for file in files:
        rooms.setdefault(os.path.dirname(file), []).append(file)
    for room, inside in sorted(rooms.items()):
        if "/" in room and not FEWEST <= len(inside) <= MOST and not room.startswith("tools/"):
            yield f"{room}: {len(inside)} files; a room holds {FEWEST} to {MOST}"


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    options.add_argument("repository")
    options.add_argument("--longest-chain", type=int, default=12, help="the most files that one chain of includes may have")
    given = options.parse_args()
    files = sources(given.repository)
    if not files:
        print("rooms.py: no sources found; is this a git checkout?")
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
