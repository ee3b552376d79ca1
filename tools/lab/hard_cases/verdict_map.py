#!/usr/bin/env python3
"""Draws a map of the verdicts of all algorithms on all hard cases, from the lines that `strata hard-cases` wrote.

usage: verdict_map.py FOLDER -o MAP.svg

A row is a case, a column an algorithm, and each field has a stripe per device: the worst verdict of its depth formats.
"""
import argparse
import itertools
import json
import os

# From the best to the worst, in colours that are distinguishable with any colour vision.
COLORS = {"refused": "#e8e8e8", "stable": "#56b4e9", "degrades gracefully": "#f0e442", "breaks as the hardware did": "#d55e00",
          "failed": "#000000"}
STRIPE, ROW, GAP, LEFT, TOP = 6, 11, 2, 210, 190  # units of the picture


def unique(lines, key):
    return list(dict.fromkeys(line[key] for line in lines))


def worst_verdicts(lines):
    """The worst verdict of all depth formats by case, algorithm and profile."""
    order, worst = list(COLORS), {}
    for line in lines:
        place = line["case"], line["algorithm"], line["profile"]
        worst[place] = max(worst.get(place, "refused"), line["verdict"], key=order.index)
    return worst


def text(x, y, words, more=""):
    return f'<text x="{x}" y="{y}"{more}>{words}</text>'


def legend(profiles):
    for number, (verdict, color) in enumerate(COLORS.items()):
        yield f'<rect x="8" y="{8 + 16 * number}" width="12" height="12" fill="{color}" stroke="#888"/>'
        yield text(26, 18 + 16 * number, verdict)
    yield text(8, 110, "stripes of a field, from the left:")
    for number, profile in enumerate(profiles):
        yield text(20, 126 + 14 * number, profile)


def fields(worst, row, case, algorithms, profiles):
    """The stripes of a row as verdict and outline; neighbours with one verdict in a field are merged."""
    y = TOP + ROW * row
    for column, algorithm in enumerate(algorithms):
        x = LEFT + (STRIPE * len(profiles) + GAP) * column
        for verdict, same in itertools.groupby(worst[case, algorithm, profile] for profile in profiles):
            width = STRIPE * len(list(same))
            yield verdict, f"M{x} {y}h{width}v{ROW - 1}h-{width}z"
            x += width


def drawn(lines):
    cases, algorithms, profiles = (unique(lines, key) for key in ("case", "algorithm", "profile"))
    worst = worst_verdicts(lines)
    field = STRIPE * len(profiles) + GAP
    width, height = LEFT + field * len(algorithms) + 110, TOP + ROW * len(cases) + 8
    yield (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
           'font-family="sans-serif" font-size="10">')
    yield "<title>The worst verdict of each case by each algorithm on each device</title>"
    yield f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    yield from legend(profiles)
    for column, algorithm in enumerate(algorithms):
        x = LEFT + field * column + field // 2
        yield text(x, TOP - 6, algorithm, f' transform="rotate(-60 {x} {TOP - 6})"')
    outlines = {verdict: [] for verdict in COLORS}
    for row, case in enumerate(cases):
        yield text(LEFT - 6, TOP + ROW * (row + 1) - 2, case, ' text-anchor="end"')
        for verdict, outline in fields(worst, row, case, algorithms, profiles):
            outlines[verdict].append(outline)
    for verdict, some in outlines.items():
        yield f'<path fill="{COLORS[verdict]}" d="{"".join(some)}"/>'
    yield "</svg>"


def write_map(lines, path):
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(drawn(lines)) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("-o", dest="map", required=True)
    words = parser.parse_args()
    with open(os.path.join(words.folder, "results.jsonl"), encoding="utf-8") as file:
        write_map([json.loads(line) for line in file], words.map)


if __name__ == "__main__":
    main()
