#!/usr/bin/env python3
"""Tests whether a device's answers with several samples per pixel follow the rules of one sample.

    samples.py KIT ANSWERS    KIT is from `strata probe -o KIT`, ANSWERS from `strata_port_probe KIT -o ANSWERS --samples 2,4,8`

Prints for each number of samples: the positions of the samples, in sixteenths of a pixel from the pixel's first row and column in memory; the number
of samples whose coverage differs from that of exact edges at those points (corners snapped to 1/256 pixel, ties to even, and the tie rule top-left);
and the number of samples whose colour differs from that of the same pixel rendered with one sample, where the same triangle covers the sample and the
centre (and has no edge there, where tie rules decide). Exit status 1 if coverage differs.
"""
import json
import pathlib
import struct
import sys

sys.dont_write_bytecode = True
import packs  # noqa: E402

SCENES = ["coverage.snap", "coverage.snap-again", "coverage.ties", "coverage.large", "coverage.small", "color.even-weights"]
UNITS = 256  # per pixel, of a snapped corner
CENTRE = (8, 8)


def corners_of(item, orientation):
    """Triangles of snapped corners (column, row) in units, row 0 of memory first. Every w is a power of two, so that the quotient is exact."""
    width, height = item["size"]
    words = bytes.fromhex(item["draws"][0]["corners"])
    floats = struct.unpack(f">{len(words) // 4}f", words)
    points = []
    for i in range(0, len(floats), 8):
        x, y, _, w = floats[i:i + 4]
        row = 1 - y / w if orientation == "up" else 1 + y / w
        points.append((round((x / w + 1) / 2 * width * UNITS), round(row / 2 * height * UNITS)))
    return [points[i:i + 3] for i in range(0, len(points), 3)]


def area(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def covers(edges, point):
    for a, b in edges:
        side = area(a, b, point)
        owns = b[1] < a[1] or (b[1] == a[1] and b[0] > a[0])
        if side < 0 or (side == 0 and not owns):
            return False
    return True


def touches(triangle, point):
    return any(area(a, b, point) == 0 for a, b in zip(triangle, triangle[1:] + triangle[:1]))


def last_triangles(triangles, size, offset):
    """For every pixel the last triangle that covers the point `offset` sixteenths into it, or None."""
    width, height = size
    last = [None] * (width * height)
    for number, (a, b, c) in enumerate(triangles):
        if area(a, b, c) == 0:
            continue
        if area(a, b, c) < 0:
            b, c = c, b
        edges = [(a, b), (b, c), (c, a)]
        columns, rows = ([p[k] for p in (a, b, c)] for k in (0, 1))
        for row in range(max(0, min(rows) // UNITS), min(height, max(rows) // UNITS + 1)):
            for column in range(max(0, min(columns) // UNITS), min(width, max(columns) // UNITS + 1)):
                if covers(edges, (column * UNITS + offset[0] * 16, row * UNITS + offset[1] * 16)):
                    last[row * width + column] = number
    return last


def without_ties(triangles, last, width):
    """The same, but None if the triangle has an edge through the pixel's centre."""
    points = ((i % width * UNITS + UNITS // 2, i // width * UNITS + UNITS // 2) for i in range(len(last)))
    return [None if number is None or touches(triangles[number], point) else number for number, point in zip(last, points)]


def compare(item, orientation, answers, folder, positions):
    """Numbers of samples, and of those whose coverage differs; of samples whose pixel has one triangle at the sample and the centre, and of those
    whose colour differs."""
    triangles, single = corners_of(item, orientation), packs.read(answers / "probe" / orientation / item["name"] / "color.npy")
    at_centre = without_ties(triangles, last_triangles(triangles, item["size"], CENTRE), item["size"][0])
    found = [0, 0, 0, 0]
    for number, position in enumerate(positions):
        colors = packs.read(folder / orientation / item["name"] / f"sample.{number}.color.npy")
        for color, alone, here, centre in zip(colors, single, last_triangles(triangles, item["size"], position), at_centre):
            found[0] += 1
            found[1] += any(color) != (here is not None)
            if here is not None and here == centre:
                found[2] += 1
                found[3] += color != alone
    return found


def main(kit, answers):
    items = {item["name"]: item for item in json.loads((pathlib.Path(kit) / "kit.json").read_text())["items"]}
    answers, differs = pathlib.Path(answers), False
    asked = json.loads((answers / "samples" / "samples.json").read_text())
    for folder, answer in zip(sorted((p for p in (answers / "samples").iterdir() if p.is_dir()), key=lambda p: int(p.name)), asked):
        positions = [tuple(round(16 * x) for x in position) for position in answer["positions"]]
        total = [0, 0, 0, 0]
        for orientation in ("up", "down"):
            for name in SCENES:
                total = [a + b for a, b in zip(total, compare(items[name], orientation, answers, folder, positions))]
        print(f"{answer['samples']} samples at {' '.join(f'{x},{y}' for x, y in positions)}: of {total[0]:,} the coverage of {total[1]:,} differs from exact edges; "
              f"of {total[2]:,} the colour of {total[3]:,} differs from the centre's")
        differs |= total[1] > 0
    return 1 if differs else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]) if len(sys.argv) == 3 else __doc__)
