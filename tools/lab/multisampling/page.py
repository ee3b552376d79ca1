#!/usr/bin/env python3
"""Makes tools/lab/multisampling/MULTISAMPLING.md and its pictures: what peels lose at the samples of a pixel.

    tools/lab/multisampling/page.py build/release

The counts are those of `strata multisampling`; the pictures are a part of the teapot's outline, enlarged: two algorithms by way of sampling, and every
exact algorithm at 1, 4 and 8 samples, and lists of 4 nodes. Needs no package.
"""
import json
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, "..", "..", "docs"))
from gallery import png_of, rows_of_png  # noqa: E402

SCALE, LEFT, TOP, WIDTH, HEIGHT, GAP, COLUMNS = 6, 34, 19, 20, 15, 3, 3
VIEW = ["teapot", "--alpha", "0.5", "--size", "64x48", "--profile", "ideal", "--color-format", "rgba8", "--background", "1,1,1", "--no-audit", "-q"]
ALGORITHMS = ["front_to_back", "dual"]
WAYS = [
    ("1 sample", []),
    ("4 samples", ["--samples", "4"]),
    ("8 samples", ["--samples", "8"]),
    ("4 samples, programs once a pixel", ["--samples", "4", "--shading", "pixel"]),
    ("the same, loads of sample 0", ["--samples", "4", "--shading", "pixel", "--load-sample", "0"]),
]


# Lists of 4 nodes: the words of each way, by where a list is.
LISTS = ["--algorithm", "linked_list", "--pixel-nodes", "4"]
OF_PIXELS = ["--shading", "pixel", "--interpolate", "centroid", "--list-granularity", "pixel"]
LIST_WAYS = [("1 sample", []), ("4 samples, lists of pixels", ["--samples", "4", *OF_PIXELS]), ("8 samples, lists of pixels", ["--samples", "8", *OF_PIXELS]),
             ("4 samples, lists of samples", ["--samples", "4"]), ("8 samples, lists of samples", ["--samples", "8"])]
LIST_SCENES = ["planes:count=4,cells=2", "teapot", "random:triangles=200"]


def part_of(path):
    _, rows = rows_of_png(path)
    return [row[3 * LEFT:3 * (LEFT + WIDTH)] for row in rows[TOP:TOP + HEIGHT]]


def enlarged(part, scale=SCALE):
    """Every pixel a square."""
    return [b"".join(row[i:i + 3] * scale for i in range(0, len(row), 3)) for row in part for _ in range(scale)]


def picture(program):
    white, strips = b"\xff\xff\xff", []
    with tempfile.TemporaryDirectory() as folder:
        for algorithm in ALGORITHMS:
            parts = []
            for _, words in WAYS:
                path = os.path.join(folder, "x.png")
                subprocess.run([program, "render", *VIEW, *words, "--algorithm", algorithm, "-o", path], check=True, stdout=subprocess.DEVNULL)
                parts.append(enlarged(part_of(path)))
            strips += [(white * GAP).join(rows) for rows in zip(*parts)]
            strips += [white * (len(strips[0]) // 3)] * GAP
    return png_of(len(strips[0]) // 3, strips)


def silhouettes(program):
    """The picture of all exact algorithms, and the text that says what it shows."""
    listed = json.loads(subprocess.run([program, "list", "algorithms", "--json"], check=True, capture_output=True, text=True).stdout)
    names = [entry["name"] for entry in listed if entry["exact"] and "ideal" in entry["profiles"]]
    white, rows, left_out, most = b"\xff\xff\xff", [], [], {}
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            parts = {}
            for label, words in WAYS[:3]:
                path = os.path.join(folder, f"{name}.{len(parts)}.png")
                subprocess.run([program, "render", *VIEW, *words, "--algorithm", name, "-o", path], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                if os.path.exists(path):
                    parts[label] = part_of(path)
            if len(parts) < 3:
                left_out.append(name)
                continue
            rows.append((name, parts))
    for label, _ in WAYS[:3]:
        first = b"".join(rows[0][1][label])
        most[label] = max(abs(a - b) for _, parts in rows for a, b in zip(first, b"".join(parts[label])))
    triples = [[(white * GAP).join(strip) for strip in zip(*(enlarged(part) for part in parts.values()))] for _, parts in rows]
    blank = [white * (len(triples[0][0]) // 3)] * len(triples[0])
    lines = []
    for k in range(0, len(triples), COLUMNS):
        across = triples[k:k + COLUMNS] + [blank] * (COLUMNS - len(triples[k:k + COLUMNS]))
        lines += [(white * 4 * GAP).join(strip) for strip in zip(*across)]
        lines += [white * (len(lines[0]) // 3)] * 2 * GAP
    grid = "; ".join(", ".join(name for name, _ in rows[k:k + COLUMNS]) for k in range(0, len(rows), COLUMNS))
    differences = ", ".join(f"{most[label]} codes with {label}" for label, _ in WAYS[:3])
    text = f"Row by row: {grid}. They differ from {rows[0][0]} by at most {differences}.\n"
    if left_out:
        text += f"Left out, because it stores fragments in samples: {', '.join(left_out)}.\n"
    return png_of(len(lines[0]) // 3, lines), text


def wireframe(program):
    """The picture of lists of 4 nodes, of which the first four ways are shown, and the table of the lists that overflow."""
    white, parts, text = b"\xff\xff\xff", [], "| scene | " + " | ".join(label for label, _ in LIST_WAYS) + " |\n|" + "---|" * (1 + len(LIST_WAYS)) + "\n"
    with tempfile.TemporaryDirectory() as folder:
        path, stats = os.path.join(folder, "x.png"), os.path.join(folder, "x.json")
        for scene in LIST_SCENES:
            cells = []
            for _, words in LIST_WAYS:
                subprocess.run([program, "render", scene, *(word.replace("64x48", "128x96") for word in VIEW[1:]), *words, *LISTS, "-o", path, "--stats", stats], check=True, stdout=subprocess.DEVNULL)
                with open(stats, encoding="utf-8") as file:
                    found = [entry["pixels"] for entry in json.load(file)[0]["diagnostics"] if entry["fault"] == "buffer_overflow"]
                cells.append(str(sum(found)))
                if scene == LIST_SCENES[0] and len(parts) < 4:
                    _, rows = rows_of_png(path)
                    parts.append(enlarged([row[3 * 32:3 * 92] for row in rows[12:84]], 3))
            text += f"| {scene} | " + " | ".join(cells) + " |\n"
    strips = [(white * GAP).join(strip) for strip in zip(*parts)]
    return png_of(len(strips[0]) // 3, strips), text


def table(program):
    """A row for each algorithm and way: lost, doubled and misplaced layers of each scene, and where the samples are in all scenes."""
    counted = json.loads(subprocess.run([program, "multisampling", "--json"], check=True, capture_output=True, text=True).stdout)
    counted = [row for row in counted if row["outcome"] == "done" and (row["algorithm"] != "depth_units" or row["load"] == "own")]
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
        text = file.read()
    outlines, outlines_text = silhouettes(program)
    lists, lists_text = wireframe(program)
    for mark, part in (("counts", table(program)), ("silhouettes", outlines_text), ("lists", lists_text)):
        before, rest = text.split(f"<!-- {mark} -->\n")[::2]
        text = f"{before}<!-- {mark} -->\n{part}<!-- {mark} -->\n{rest}"
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)
    with open(os.path.join(FOLDER, "silhouettes.png"), "wb") as file:
        file.write(outlines)
    with open(os.path.join(FOLDER, "wireframe.png"), "wb") as file:
        file.write(lists)
    with open(os.path.join(FOLDER, "multisampling.png"), "wb") as file:
        file.write(picture(program))


if __name__ == "__main__":
    main()
