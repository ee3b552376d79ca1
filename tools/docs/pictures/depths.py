#!/usr/bin/env python3
"""Makes depths.png (how-to.md) and prints how many pixels each picture loses.

    tools/docs/pictures/depths.py build/release/strata

Upper row: a decal in the plane of its wall without an offset, with one of everything, and with one of the decal. Lower row: a road half a metre above the ground, seen from 200 m
up to 50 km away, by linear, reversed and logarithmic depth. What is right is not taken from a depth buffer: the decal and the road are drawn alone and laid over the rest.
"""
import base64
import json
import os
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, ".."))
from gallery import png_of, rows_of_png  # noqa: E402

WIDTH, HEIGHT, GAP = 200, 150, 4
SKY = (0.75, 0.85, 0.95)
WALL = [(-3, -2, -8), (3, -2, -4), (3, 2.5, -4.7), (-3, 2.5, -8.7)]
FAR = 100000
DECAL = [(0.27, 0.31), (0.83, 0.22), (0.78, 0.81), (0.21, 0.69)]  # places on the wall, from 0 to 1
CAMERAS = {"decal": {"eye": [0, 0, 0], "center": [0, 0, -1], "up": [0, 1, 0], "fovy_degrees": 50, "near": 0.1, "far": 100},
           "road": {"eye": [0, 200, 0], "center": [0, 199.7, -1], "up": [0, 1, 0], "fovy_degrees": 60, "near": 0.01, "far": FAR}}
END = -50000
ROAD = {"ground": [(-FAR, 0, 5), (FAR, 0, 5), (FAR, 0, END), (-FAR, 0, END)], "road": [(-60, 0.5, 5), (60, 0.5, 5), (400, 0.5, END), (-400, 0.5, END)]}
COLORS = {"wall": [0.45, 0.4, 0.3, 1], "decal": [0.6, 0.05, 0.05, 1], "ground": [0.1, 0.3, 0.08, 1], "road": [0.6, 0.05, 0.05, 1]}


def on_wall(u, v):
    """A place of the wall, which is a parallelogram."""
    a, b, _, d = WALL
    return tuple(a[i] + u * (b[i] - a[i]) + v * (d[i] - a[i]) for i in range(3))


SQUARES = {"decal": {"wall": WALL, "decal": [on_wall(*at) for at in DECAL]}, "road": ROAD}
UPPER = [("without an offset", []), ("--polygon-offset=-1,-1", ["--polygon-offset=-1,-1"]),
         ("--polygon-offset=-1,-1 --only decal", ["--polygon-offset=-1,-1", "--only", "decal"])]
LOWER = [("d24", ["--algorithm", "unsorted", "--depth-format", "d24"]), ("d32f reversed", ["--algorithm", "unsorted", "--depth-format", "d32f", "--depth-order", "greater", "--clip-depth", "zero-to-one"]),
         ("d24 logarithmic", ["--algorithm", "unsorted", "--depth-format", "d24", "--depth-path", "logarithmic"])]


def write_model(path, squares):
    """A glTF file with an opaque quadrilateral for each name."""
    data = b"".join(struct.pack("<18f", *(c for i in (0, 1, 2, 0, 2, 3) for c in corners[i])) for corners in squares.values())
    accessors = [{"bufferView": 0, "byteOffset": 72 * i, "componentType": 5126, "count": 6, "type": "VEC3",
                  "min": [min(p[k] for p in corners) for k in range(3)], "max": [max(p[k] for p in corners) for k in range(3)]}
                 for i, corners in enumerate(squares.values())]
    model = {"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"], "scenes": [{"nodes": list(range(len(squares)))}], "scene": 0,
             "nodes": [{"mesh": i} for i in range(len(squares))], "accessors": accessors,
             "meshes": [{"name": name, "primitives": [{"attributes": {"POSITION": i}, "material": i}]} for i, name in enumerate(squares)],
             "materials": [{"name": name, "doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": COLORS[name]}, "extensions": {"KHR_materials_unlit": {}}}
                           for name in squares],
             "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
             "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(model, file)


def drawn(program, folder, scene, names, words):
    """The rows of the picture of some of a scene's squares."""
    model, camera, picture = (os.path.join(folder, name) for name in ("model.gltf", "camera.json", "picture.png"))
    write_model(model, {name: SQUARES[scene][name] for name in names})
    with open(camera, "w", encoding="utf-8") as file:
        json.dump(CAMERAS[scene], file)
    subprocess.run([program, "render", model, "--camera", camera, "--size", f"{WIDTH}x{HEIGHT}", "--background", ",".join(map(str, SKY)), "-q", "--no-audit", *words,
                    "-o", picture], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return rows_of_png(picture)[1]


def pixels(row):
    return [row[i:i + 3] for i in range(0, len(row), 3)]


def right(program, folder, scene):
    """The second square over the first, pixel by pixel: it is nowhere behind it."""
    lower, upper = SQUARES[scene]
    under, over = (drawn(program, folder, scene, [name], []) for name in (lower, upper))
    sky = drawn(program, folder, scene, [lower], [])[0][:3]
    return [b"".join(b if b != sky else a for a, b in zip(pixels(u), pixels(o))) for u, o in zip(under, over)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    white, strips = b"\xff\xff\xff", []
    with tempfile.TemporaryDirectory() as folder:
        for scene, ways in (("decal", UPPER), ("road", LOWER)):
            whole, parts = right(sys.argv[1], folder, scene), []
            for label, words in ways:
                parts.append(drawn(sys.argv[1], folder, scene, list(SQUARES[scene]), words))
                lost = sum(a != b for found, wanted in zip(parts[-1], whole) for a, b in zip(pixels(found), pixels(wanted)))
                print(f"{scene}: {label}: {lost} of {WIDTH * HEIGHT} pixels lost")
            strips += [(white * GAP).join(strip) for strip in zip(*parts)]
            strips += [white * (len(strips[0]) // 3)] * (GAP if scene == "decal" else 0)
    with open(os.path.join(FOLDER, "depths.png"), "wb") as file:
        file.write(png_of(len(strips[0]) // 3, strips))


main()
