"""Scenes of transparency.py that are written as glTF: hair, foliage with holes, glass before smoke. Random numbers have fixed seeds."""
import base64
import json
import math
import random
import struct

HAIRS, LEAVES, PUFFS = 10_000, 600, 60


class Mesh:
    """Triangles with a colour and an alpha at every corner."""

    def __init__(self):
        self.positions, self.colors = [], []

    def quad(self, corners, colors):
        for i in (0, 1, 2, 0, 2, 3):
            self.positions.append(corners[i])
            self.colors.append(colors[i])


def square(mesh, center, right, up, colors):
    corners = [tuple(c + a * r + b * u for c, r, u in zip(center, right, up)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    mesh.quad(corners, colors)


def gltf(path, meshes):
    """Writes pairs of an alpha mode and a mesh, unlit and double-sided."""
    buffer, views, accessors, primitives, materials = b"", [], [], [], []

    def accessor(values, kind):
        nonlocal buffer
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(values) * len(values[0]) * 4})
        buffer += b"".join(struct.pack(f"<{len(value)}f", *value) for value in values)
        bounds = {"min": [min(v) for v in zip(*values)], "max": [max(v) for v in zip(*values)]} if kind == "VEC3" else {}
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": len(values), "type": kind, **bounds})
        return len(accessors) - 1

    for mode, mesh in meshes:
        single = [tuple(struct.unpack("<3f", struct.pack("<3f", *p))) for p in mesh.positions]
        attributes = {"POSITION": accessor(single, "VEC3"), "COLOR_0": accessor(mesh.colors, "VEC4")}
        primitives.append({"attributes": attributes, "material": len(materials)})
        materials.append({"alphaMode": mode, "doubleSided": True, "extensions": {"KHR_materials_unlit": {}}})
    uri = "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}], "materials": materials, "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(buffer), "uri": uri}]}))


def hair(path):
    """A bundle of thin quads from one side to the other, alpha 0.3 at the root and 0.05 at the tip."""
    numbers, mesh = random.Random(1), Mesh()
    for _ in range(HAIRS):
        root = (numbers.gauss(0, 0.15), -1, numbers.gauss(0, 0.15))
        tip = (root[0] + numbers.gauss(0, 0.2), 1, root[2] + numbers.gauss(0, 0.2))
        width = 0.004
        shade = numbers.uniform(0.2, 0.6)
        color = (shade, shade * 0.7, shade * 0.4)
        mesh.quad([(root[0] - width, root[1], root[2]), (root[0] + width, root[1], root[2]), (tip[0] + width, tip[1], tip[2]),
                   (tip[0] - width, tip[1], tip[2])], [(*color, 0.3), (*color, 0.3), (*color, 0.05), (*color, 0.05)])
    gltf(path, [("BLEND", mesh)])


def foliage(path):
    """Leaves with MASK, whose corners of alpha 0 cut their shape, and panes of glass among them."""
    numbers, leaves, panes = random.Random(2), Mesh(), Mesh()
    for _ in range(LEAVES):
        turn, tilt, size = numbers.uniform(0, math.tau), numbers.uniform(-1, 1), numbers.uniform(0.04, 0.1)
        right = (size * math.cos(turn), size * tilt, size * math.sin(turn))
        up = (0, size, size * numbers.uniform(-1, 1))
        green = (numbers.uniform(0.05, 0.3), numbers.uniform(0.3, 0.8), 0.1)
        square(leaves, [numbers.uniform(-1, 1) for _ in range(3)], right, up, [(*green, 1), (*green, 0.2), (*green, 1), (*green, 0.2)])
    for i in range(12):
        tint = (0.3 + 0.05 * i, 0.6, 0.9 - 0.05 * i, 0.25)
        square(panes, (0, 0, -0.9 + 0.16 * i), (1, 0, 0.2), (0, 1, 0), [tint] * 4)
    gltf(path, [("MASK", leaves), ("BLEND", panes)])


def smoke(path):
    """Three panes of glass, submitted first, in front of soft grey quads."""
    numbers, glass, puffs = random.Random(3), Mesh(), Mesh()
    for i, tint in enumerate(((0.9, 0.3, 0.2, 0.5), (0.2, 0.8, 0.3, 0.5), (0.2, 0.3, 0.9, 0.5))):
        square(glass, (-0.3 + 0.3 * i, 0, 1 + 0.1 * i), (0.5, 0, 0), (0, 0.7, 0), [tint] * 4)
    for _ in range(PUFFS):
        grey, size = numbers.uniform(0.5, 0.9), numbers.uniform(0.2, 0.5)
        corners = [(grey, grey, grey, numbers.uniform(0.02, 0.12)) for _ in range(4)]
        square(puffs, [numbers.uniform(-0.8, 0.8), numbers.uniform(-0.8, 0.8), numbers.uniform(-1, 0.5)], (size, 0, 0), (0, size, 0), corners)
    gltf(path, [("BLEND", glass), ("BLEND", puffs)])


def write_all(folder):
    """The files by the names that the page has for them."""
    folder.mkdir(parents=True, exist_ok=True)
    written = {}
    for name, make in {"hair": hair, "foliage": foliage, "glass before smoke": smoke}.items():
        written[name] = folder / f"{make.__name__}.gltf"
        make(written[name])
    return written
