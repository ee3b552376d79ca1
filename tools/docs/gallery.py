#!/usr/bin/env python3
"""Makes tools/docs/gallery.md and its pictures: every built-in scene by every algorithm, with its error.

    tools/docs/gallery.py build/release                 writes them again
    tools/docs/gallery.py build/release --check [SCENE] compares them, or one scene's, with the program's pictures; exit status 1 if they differ

A picture of the gallery is a strip: for each scene the picture of an algorithm, above four times its difference from the exact A-buffer. Algorithms
that draw the same strip share the file of the first of them. Needs no package.
"""
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

FOLDER = os.path.dirname(os.path.abspath(__file__))
PICTURES = os.path.join(FOLDER, "pictures", "gallery")
VIEW = ["--profile", "ideal", "--size", "96x72", "--background", "1,1,1"]
SCENES = [  # name in the page, arguments, description
    ("teapot", ["teapot", "--alpha", "0.75", "--camera", os.path.join(FOLDER, "pictures", "teapot.json")],
     "where the green inside covers the outside, triangles were blended as submitted"),
    ("volume-beam", ["volume-beam:slices=16"], "planes submitted from far to near, and a cone across them"),
    ("random", ["random:triangles=150"], "triangles that cross one another, and exact ties"),
    ("planes", ["planes"], "six parallel planes, submitted from far to near, so that `unsorted` is also right"),
    ("shadow-demo", ["shadow-demo"], "one transparent pane in front of an opaque teapot, lit by a shadow map"),
    ("cyclic-overlap", ["hard:case=cyclic-overlap"], "three triangles, each in front of the next: no order is right"),
]


def rows_of_png(path):
    """Width, and rows of red, green, blue bytes, of an 8-bit PNG without a palette."""
    with open(path, "rb") as file:
        data = file.read()
    place, packed, width, channels = 8, b"", 0, 0
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        if kind == b"IHDR":
            width, _, _, color = struct.unpack(">IIBB", body[:10])
            channels = {2: 3, 6: 4}[color]
        elif kind == b"IDAT":
            packed += body
        place += 12 + length
    raw, step, before, rows = zlib.decompress(packed), width * channels, bytes(width * channels), []
    for start in range(0, len(raw), step + 1):
        row = bytearray(raw[start + 1:start + 1 + step])
        for i in range(step):
            left, up, corner = (row[i - channels], before[i], before[i - channels]) if i >= channels else (0, before[i], 0)
            nearest = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            row[i] = row[i] + (0, left, up, (left + up) // 2, nearest)[raw[start]] & 255
        rows.append(bytes(v for i in range(0, step, channels) for v in row[i:i + 3]))
        before = row
    return width, rows


def png_of(width, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9)) + chunk(b"IEND", b""))


def drawn(program, arguments):
    """For each algorithm its picture above its difference, and its entry of the statistics."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        run = [program, "render", *arguments, *VIEW, "--algorithm", "all", "-o", os.path.join(folder, "x.png"), "--stats", "-"]
        entries = json.loads(subprocess.run(run, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
        read = {e["algorithm"]: rows_of_png(os.path.join(folder, f"x.{e['algorithm']}.png")) for e in entries}
    exact = read["a_buffer"][1]
    for entry in entries:
        width, rows = read[entry["algorithm"]]
        errors = [bytes(min(255, 4 * abs(a - b)) for a, b in zip(row, right)) for row, right in zip(rows, exact)]
        found.append((entry, width, rows + errors))
    return found


def caption(entry):
    """The result of the audit."""
    off = entry["max_difference_from_a_buffer"]
    said = [f"{off:.1f}" if off is not None else "-"]
    if entry["order_errors"]:
        said.append(f"{entry['order_errors']} misordered")
    if entry["lost_by_ties"]:
        said.append(f"{entry['lost_by_ties']} lost by ties")
    return ", ".join(said)


def row_of(algorithm, drawn_by, captions):
    captions = captions if len(set(captions)) > 1 else [f"{captions[0]} everywhere"]
    strip = f"![{algorithm}](pictures/gallery/{algorithm}.png)" if drawn_by == algorithm else f"as `{drawn_by}`"
    return f"| `{algorithm}` | {strip} | {'; '.join(captions)} |"


def captions_in(cell):
    """The caption of each scene, from the last cell of a row."""
    return [cell.removesuffix(" everywhere")] * len(SCENES) if cell.endswith(" everywhere") else cell.split("; ")


def page_of(shown):
    lines = ["# Gallery", "",
             "Every built-in scene by every algorithm on the profile `ideal`. A strip shows the scenes side by side: the picture above four times its",
             "difference from the exact A-buffer; \"as NAME\": the same bytes as that algorithm's strip. The figures, in the order of the scenes: the greatest",
             "difference of a channel in 1/255, fragments in a wrong order, fragments lost at equal depths. `tools/docs/gallery.py build/release` writes this page.", ""]
    lines += [f"- **{name}**: `strata render {' '.join(arguments).replace(FOLDER + os.sep, 'tools/docs/')}`: {what}." for name, arguments, what in SCENES]
    lines += ["", "| algorithm | " + ", ".join(name for name, _, _ in SCENES) + " | differences |", "|---|---|---|"]
    shared = first_with_strip(shown)
    for i, (entry, _, _) in enumerate(shown[SCENES[0][0]]):
        lines.append(row_of(entry["algorithm"], shared[entry["algorithm"]], [caption(shown[name][i][0]) for name, _, _ in SCENES]))
    return "\n".join(lines) + "\n"


def picture_path(algorithm):
    return os.path.join(PICTURES, f"{algorithm}.png")


def strips(shown):
    """By algorithm: the rows of its scenes side by side."""
    for i, (entry, width, _) in enumerate(shown[SCENES[0][0]]):
        parts = [shown[name][i][2] for name, _, _ in SCENES]
        yield entry["algorithm"], width * len(SCENES), [b"".join(rows) for rows in zip(*parts)]


def first_with_strip(shown):
    """By algorithm: the first algorithm whose strip has the same bytes."""
    first = {}
    return {algorithm: first.setdefault(b"".join(rows), algorithm) for algorithm, _, rows in strips(shown)}


def check(shown, whole):
    """The parts of the gallery that differ from the program's pictures."""
    wrong = []
    kept, drawn_by = {}, {}
    for algorithm, strip, captions in re.findall(r"^\| `(\w+)` \| (.*) \| (.*) \|$", whole, re.MULTILINE):
        kept[algorithm] = captions
        drawn_by[algorithm] = re.sub(r"^as `(\w+)`$|^!\[(\w+)\].*$", r"\1\2", strip)
    for name, pictures in shown.items():
        place = [scene for scene, _, _ in SCENES].index(name)
        for entry, width, rows in pictures:
            algorithm = entry["algorithm"]
            path = picture_path(drawn_by.get(algorithm, algorithm))
            strip = rows_of_png(path) if os.path.exists(path) else (0, [])
            part = slice(3 * width * place, 3 * width * (place + 1))
            if strip[0] != width * len(SCENES) or [row[part] for row in strip[1]] != rows:
                wrong.append(f"{path}: expected what the program draws of {name}")
            elif captions_in(kept.get(algorithm, ""))[place:place + 1] != [caption(entry)]:
                wrong.append(f"gallery.md: expected {caption(entry)} for {name} by {algorithm}")
    files = os.listdir(PICTURES)
    wrong += [f"{PICTURES}: {file} stands in no row of gallery.md" for file in files if file.removesuffix(".png") not in drawn_by.values()]
    size = sum(os.path.getsize(os.path.join(PICTURES, file)) for file in files)
    return wrong + ([f"{PICTURES}: expected at most 2 MiB, found {size} bytes"] if size > 2 << 20 else [])


def main():
    program, asked = os.path.join(os.path.abspath(sys.argv[1]), "strata"), sys.argv[3:]
    if not os.access(program, os.X_OK):
        print(f"SKIPPED: no program {program}")
        return 77
    shown = {name: drawn(program, arguments) for name, arguments, _ in SCENES if not asked or name in asked}
    if sys.argv[2:3] == ["--check"]:
        with open(os.path.join(FOLDER, "gallery.md"), encoding="utf-8") as file:
            wrong = check(shown, file.read())
        print("\n".join(wrong) if wrong else f"{sum(map(len, shown.values()))} pictures are what the program draws")
        return 1 if wrong or not shown else 0
    shutil.rmtree(PICTURES, ignore_errors=True)
    os.makedirs(PICTURES)
    shared = first_with_strip(shown)
    for algorithm, width, rows in strips(shown):
        if shared[algorithm] != algorithm:
            continue
        with open(picture_path(algorithm), "wb") as file:
            file.write(png_of(width, rows))
    with open(os.path.join(FOLDER, "gallery.md"), "w", encoding="utf-8") as file:
        file.write(page_of(shown))
    return 0


if __name__ == "__main__":
    sys.exit(main())
