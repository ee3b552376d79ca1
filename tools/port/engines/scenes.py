#!/usr/bin/env python3
"""Writes the scenes of this folder's table as glTF: flat colours, no light, each with a feature in which engines differ.

    scenes.py FOLDER    writes FOLDER/NAME.gltf and the cameras, front.json, torus.json, shells.json

All except `torus` and `shells` are panes in front of the orthographic camera of front.json, which is at z = 1 and shows x, y, z from -1 to 1: z = 1
has window depth 0, z = -1 has 1, and all products and sums are exact. Each pane is a separate object, for engines that sort objects. Colours are
codes of 8 bits, because Mol* stores no others. Colours of glTF are linear, so that they are decoded here, and encoded again by the reader.
"""
import array
import base64
import json
import math
import pathlib
import random
import sys

RED, GREEN, BLUE, YELLOW, WHITE, BLACK = (230, 40, 30), (40, 190, 60), (40, 80, 220), (240, 200, 40), (235, 235, 225), (20, 20, 25)


def decoded(code):
    c = code / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


class Builder:
    """Builds a glTF document surface by surface, each with a node, a mesh and a material."""
    def __init__(self):
        self.document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "extensionsUsed": ["KHR_materials_unlit"],
                         "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "buffers": []}
        self.data = b""

    def add(self, kind, entry):
        self.document[kind].append(entry)
        return len(self.document[kind]) - 1

    def accessor(self, data, component, count, shape, **more):
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return self.add("accessors", {"bufferView": view, "componentType": component, "count": count, "type": shape, **more})

    def surface(self, points, triangles, color, alpha=None, translation=(0, 0, 0)):
        """Alpha None is an opaque surface. `color` is one colour or a list with one per point. `translation` is that of its node."""
        values = array.array("f", [x for p in points for x in p])
        box = [[f(values[k::3]) for k in range(3)] for f in (min, max)]
        positions = self.accessor(values.tobytes(), 5126, len(points), "VEC3", min=box[0], max=box[1])
        indices = self.accessor(array.array("I", [i for t in triangles for i in t]).tobytes(), 5125, 3 * len(triangles), "SCALAR")
        attributes = {"POSITION": positions}
        if isinstance(color, list):
            values = array.array("f", [x for c in color for x in (*map(decoded, c), 1.0)])
            attributes["COLOR_0"] = self.accessor(values.tobytes(), 5126, len(points), "VEC4")
            color = (255, 255, 255)
        material = self.add("materials", {
            "pbrMetallicRoughness": {"baseColorFactor": [*map(decoded, color), 1.0 if alpha is None else alpha]},
            "alphaMode": "OPAQUE" if alpha is None else "BLEND", "doubleSided": True, "extensions": {"KHR_materials_unlit": {}}})
        mesh = self.add("meshes", {"primitives": [{"attributes": attributes, "indices": indices, "material": material}]})
        self.document["scenes"][0]["nodes"].append(self.add("nodes", {"mesh": mesh, "translation": translation}))

    def pane(self, left, bottom, right, top, z, color, alpha=None):
        """A rectangle at one z. Its sides lie between pixel centres if they are multiples of 1/16 (frames of 32 n pixels)."""
        self.surface([(left, bottom, 0), (right, bottom, 0), (right, top, 0), (left, top, 0)], [(0, 1, 2), (0, 2, 3)], color, alpha, (0, 0, z))

    def text(self):
        self.document["buffers"] = [{"byteLength": len(self.data), "uri": "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()}]
        return json.dumps(self.document)


def panes(b):
    b.pane(-0.75, -0.75, 0.25, 0.25, 0.5, RED, 0.5)
    b.pane(-0.5, -0.5, 0.5, 0.5, 0.25, GREEN, 0.25)
    b.pane(-0.25, -0.25, 0.75, 0.75, -0.25, BLUE, 0.75)
    b.pane(-0.875, -0.125, 0.875, 0.125, -0.5, YELLOW, 0.4)


def stack(b):
    for i in [7, 2, 11, 0, 5, 9, 3, 8, 1, 10, 4, 6]:
        size = 0.9375 - 0.0625 * i
        b.pane(-size, -size, size, size, 0.75 - 0.125 * i, [RED, GREEN, BLUE, YELLOW][i % 4], 0.3)


def ties(b):
    """Three panes at one depth: nearest of all, farthest of all, and between others."""
    b.pane(-0.75, -0.5, 0.25, 0.5, 0.0, RED, 0.5)
    b.pane(-0.25, -0.75, 0.75, 0.25, 0.0, GREEN, 0.5)
    b.pane(-0.5, -0.25, 0.5, 0.75, 0.0, BLUE, 0.5)
    b.pane(-0.875, -0.875, 0.875, -0.125, -0.5, YELLOW, 0.5)
    b.pane(0.0, -0.875, 0.875, 0.875, 0.5, WHITE, 0.25)


def hidden(b):
    b.pane(-0.5, -0.5, 0.5, 0.5, 0.0, WHITE)
    b.pane(-0.75, -0.25, 0.25, 0.75, -0.5, RED, 0.5)
    b.pane(-0.25, -0.75, 0.75, 0.25, 0.5, BLUE, 0.5)
    b.pane(-0.875, -0.375, 0.875, 0.0, 0.25, GREEN, 0.25)


def decal(b):
    b.pane(-0.75, -0.75, 0.5, 0.5, 0.0, WHITE)
    b.pane(-0.5, -0.5, 0.75, 0.75, 0.0, RED, 0.5)
    b.pane(-0.25, -0.875, 0.25, 0.875, 0.5, BLUE, 0.25)


def close(b):
    """Pairs whose window depths differ by 2^-24, 2^-23, 2^-22 and 2^-20, the far one last."""
    for k, steps in enumerate([1, 2, 4, 16]):
        left = -0.875 + 0.4375 * k
        b.pane(left, -0.75, left + 0.3125, 0.25, -0.5, RED, 0.5)
        b.pane(left, -0.25, left + 0.3125, 0.75, -0.5 - steps * 2.0 ** -23, BLUE, 0.5)


def floor(b):
    b.pane(-1, -1, 1, 1, -0.75, WHITE)
    b.pane(-0.75, -0.75, 0.25, 0.25, 0.5, RED, 0.5)
    b.pane(-0.5, -0.5, 0.5, 0.5, 0.0, GREEN, 0.5)
    b.pane(-0.25, -0.25, 0.75, 0.75, -0.5, BLUE, 0.5)


def solid(b):
    """Blended surfaces of alpha 1 and of alpha 0 among others."""
    b.pane(-0.75, -0.75, 0.25, 0.25, 0.5, RED, 0.5)
    b.pane(-0.5, -0.5, 0.5, 0.5, 0.0, GREEN, 1.0)
    b.pane(-0.25, -0.25, 0.75, 0.75, -0.5, BLUE, 0.5)
    b.pane(-0.875, 0.375, 0.875, 0.75, 0.75, YELLOW, 0.0)


def grid(b):
    """Nine columns with 1 to 9 layers, drawn from the near end to the far one."""
    for layer in range(9):
        b.pane(-0.9375 + 0.1875 * layer, -0.75, 0.75, 0.75, 0.75 - 0.1875 * layer, [RED, GREEN, BLUE][layer % 3], 0.4)


def gradient(b):
    """Colours that change within a surface, which Mol* does not support."""
    b.pane(-0.75, -0.75, 0.375, 0.375, 0.5, [RED, GREEN, BLUE, YELLOW], 0.5)
    b.pane(-0.375, -0.375, 0.75, 0.75, 0.0, [WHITE, BLACK, WHITE, BLUE], 0.5)
    b.pane(-0.875, -0.25, 0.875, 0.25, -0.5, [YELLOW, BLUE, RED, WHITE], 0.5)


def torus(b, rings=24, sides=12):
    """Two rings through each other, in perspective: `torus.json` is the camera."""
    def point(u, v, turned):
        r = 0.75 + 0.3 * math.cos(v)
        p = (r * math.cos(u), r * math.sin(u), 0.3 * math.sin(v))
        return (p[0] + 0.75, p[2], p[1]) if turned else p
    for turned, color in [(False, RED), (True, BLUE)]:
        points = [point(2 * math.pi * i / rings, 2 * math.pi * j / sides, turned) for i in range(rings) for j in range(sides)]
        at = lambda i, j: i % rings * sides + j % sides
        b.surface(points, [t for i in range(rings) for j in range(sides)
                           for t in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))], color, 0.5)


def shells(b, rings=20, sides=10):
    """Three spheres around each other, in perspective, the outermost first: six layers. `shells.json` is the camera."""
    for radius, color, alpha in [(1.2, YELLOW, 0.25), (0.85, RED, 0.5), (0.5, BLUE, 0.75)]:
        points = [(radius * math.sin(v) * math.cos(u), radius * math.cos(v), radius * math.sin(v) * math.sin(u))
                  for u in (2 * math.pi * (i + radius) / rings for i in range(rings)) for v in (math.pi * j / sides for j in range(sides + 1))]
        at = lambda i, j: i % rings * (sides + 1) + j
        triangles = [t for i in range(rings) for j in range(sides) for t in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))]
        b.surface(points, [t for t in triangles if len({points[k] for k in t}) == 3], color, alpha)


def by_lot(seed):
    """Random panes: 2 to 14, each at a different depth, up to two of them opaque, in any order, with any colour and alpha."""
    def make(b):
        lot = random.Random(seed)
        count, opaque = lot.randint(2, 14), lot.choice([0, 0, 1, 2])
        depths = lot.sample(range(-7, 8), count)
        for number, z in enumerate(depths):
            left, bottom = lot.randint(-15, -1), lot.randint(-15, -1)
            right, top = lot.randint(left + 10, 15), lot.randint(bottom + 10, 15)
            color = tuple(lot.randint(0, 255) for _ in range(3))
            b.pane(left / 16, bottom / 16, right / 16, top / 16, z / 8, color, None if number < opaque else lot.randint(2, 18) / 20)
    return make


SCENES = {"panes": panes, "stack": stack, "ties": ties, "hidden": hidden, "decal": decal, "close": close, "floor": floor, "solid": solid,
          "grid": grid, "gradient": gradient, "torus": torus, "shells": shells}
CAMERAS = {"front": {"view": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1], "projection": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, -1, 1]},
           "torus": {"eye": [1.9, 1.2, 3.4], "center": [0.35, 0, 0], "up": [0, 1, 0], "fovy_degrees": 40, "near": 1, "far": 8},
           "shells": {"eye": [1.1, 2.0, 3.2], "center": [0, 0, 0], "up": [0, 1, 0], "fovy_degrees": 42, "near": 1, "far": 8}}


def camera_of(name):
    """The name of the scene's camera file."""
    return name if name in CAMERAS else "front"


def main(folder, seeds=()):
    """Random scenes are named `lot-SEED`."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in {**SCENES, **{f"lot-{seed}": by_lot(seed) for seed in seeds}}.items():
        builder = Builder()
        make(builder)
        (folder / f"{name}.gltf").write_text(builder.text())
    for name, camera in CAMERAS.items():
        (folder / f"{name}.json").write_text(json.dumps(camera))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("scenes.py: expected a folder")
    main(sys.argv[1])
