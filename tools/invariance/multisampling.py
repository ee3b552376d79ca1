#!/usr/bin/env python3
"""Makes tools/invariance/MULTISAMPLING.md and its picture: what peels lose at the samples of a pixel.

    tools/invariance/multisampling.py build/release

The counts are those of `strata multisampling`; the picture is a part of the teapot's outline, enlarged, by algorithm and way of sampling. Needs no
package.
"""
import json
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, "..", "docs"))
from gallery import png_of, rows_of_png  # noqa: E402

SCALE, LEFT, TOP, WIDTH, HEIGHT, GAP = 6, 34, 19, 20, 15, 3
VIEW = ["teapot", "--alpha", "0.5", "--size", "64x48", "--profile", "ideal", "--color-format", "rgba8", "--background", "1,1,1", "--no-audit", "-q"]
ALGORITHMS = ["front_to_back", "dual"]
WAYS = [
    ("1 sample", []),
    ("4 samples", ["--samples", "4"]),
    ("8 samples", ["--samples", "8"]),
    ("4 samples, programs once a pixel", ["--samples", "4", "--shading", "pixel"]),
    ("the same, loads of sample 0", ["--samples", "4", "--shading", "pixel", "--load-sample", "0"]),
]


def enlarged(path):
    """A part of a picture, every pixel a square."""
    _, rows = rows_of_png(path)
    part = [row[3 * LEFT:3 * (LEFT + WIDTH)] for row in rows[TOP:TOP + HEIGHT]]
    return [b"".join(row[i:i + 3] * SCALE for i in range(0, len(row), 3)) for row in part for _ in range(SCALE)]


def picture(program):
    white, strips = b"\xff\xff\xff", []
    with tempfile.TemporaryDirectory() as folder:
        for algorithm in ALGORITHMS:
            parts = []
            for _, words in WAYS:
                path = os.path.join(folder, "x.png")
                subprocess.run([program, "render", *VIEW, *words, "--algorithm", algorithm, "-o", path], check=True, stdout=subprocess.DEVNULL)
                parts.append(enlarged(path))
            strips += [(white * GAP).join(rows) for rows in zip(*parts)]
            strips += [white * (len(strips[0]) // 3)] * GAP
    return png_of(len(strips[0]) // 3, strips)


def table(program):
    """A row for each algorithm and way: lost, doubled and misplaced layers of each scene, and where the samples are in all scenes."""
    counted = json.loads(subprocess.run([program, "multisampling", "--json"], check=True, capture_output=True, text=True).stdout)
    counted = [row for row in counted if row["refusal"] is None and (row["algorithm"] != "depth_units" or row["load"] == "own")]
    scenes = list(dict.fromkeys(row["scene"] for row in counted))
    text = "| algorithm | programs at | load | " + " | ".join(scenes) + " | silhouette | inner edge | inside |\n|" + "---|" * (6 + len(scenes)) + "\n"
    text += "| layers of all samples | | | " + " | ".join(str(next(row["layers"] for row in counted if row["scene"] == scene)) for scene in scenes) + " | | | |\n"
    for way in dict.fromkeys((row["algorithm"], row["programs_at"], row["load"]) for row in counted):
        rows = [row for row in counted if (row["algorithm"], row["programs_at"], row["load"]) == way]
        cells = [f"{row['lost']} / {row['doubled']} / {row['misplaced']}" + ("" if row["ended"] else ", no end") for row in rows]
        where = [str(sum(row[key] for row in rows)) for key in ("at_silhouettes", "at_inner_edges", "inside")]
        text += "| " + " | ".join([*way, *cells, *where]) + " |\n"
    sampled, shaded = (sum(row["programs"] for row in counted if row["algorithm"] == "front_to_back" and row["load"] == "own" and row["programs_at"] == at)
                       for at in ("sample", "centre"))
    return text + f"\nOver all scenes a program runs {sampled} times a pass at the samples, {shaded} times at the pixels: sample shading costs {sampled / shaded:.2f} times as many.\n"


def main():
    program = os.path.join(sys.argv[1], "strata")
    page = os.path.join(FOLDER, "MULTISAMPLING.md")
    with open(page, encoding="utf-8") as file:
        before, rest = file.read().split("<!-- counts -->\n")[::2]
    with open(page, "w", encoding="utf-8") as file:
        file.write(f"{before}<!-- counts -->\n{table(program)}<!-- counts -->\n{rest}")
    with open(os.path.join(FOLDER, "multisampling.png"), "wb") as file:
        file.write(picture(program))


if __name__ == "__main__":
    main()
