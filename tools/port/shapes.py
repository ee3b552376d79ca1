#!/usr/bin/env python3
"""Compares lines and points as a driver draws them with those of a profile, every target after every pass.

    shapes.py --build build/release [--quick] [--driver llvmpipe] [--profile NAME] [--sizes 97x73,64x64,131x50]

Twelve scenes, half of them chosen to be hard: ends on pixel borders, centres and between subpixels, lines shorter than a pixel, lines and points that
the view volume cuts. Prints a table of the pixels that differ. Exit status 1 unless all are equal.
On softpipe scenes of d24 are drawn with d32f: the port's front_to_back rounds 24-bit depths as llvmpipe stores them, softpipe cuts them.
"""
import argparse
import json
import pathlib
import random
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
import packs  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "engines"))
import scenes  # noqa: E402

ALGORITHMS = ["front_to_back", "dual", "weighted_average"]
LINES, STRIP, POINTS = 1, 3, 0
CAMERAS = {"front": scenes.CAMERAS["front"], "wide": {"eye": [0.9, 0.6, 1.9], "center": [0, 0, 0], "up": [0, 1, 0], "fovy_degrees": 70, "near": 0.5, "far": 4}}


def shape(builder, points, kind, lot):
    """Lines or points, each vertex with a colour of its own."""
    values = scenes.array.array("f", [x for p in points for x in p])
    box = [[f(values[k::3]) for k in range(3)] for f in (min, max)]
    colors = scenes.array.array("f", [lot.random() for _ in range(4 * len(points))])
    attributes = {"POSITION": builder.accessor(values.tobytes(), 5126, len(points), "VEC3", min=box[0], max=box[1]),
                  "COLOR_0": builder.accessor(colors.tobytes(), 5126, len(points), "VEC4")}
    material = builder.add("materials", {"alphaMode": "BLEND", "doubleSided": True, "extensions": {"KHR_materials_unlit": {}}})
    mesh = builder.add("meshes", {"primitives": [{"attributes": attributes, "mode": kind, "material": material}]})
    builder.document["scenes"][0]["nodes"].append(builder.add("nodes", {"mesh": mesh}))


def anywhere(lot, reach=1.0):
    return [lot.uniform(-reach, reach) for _ in range(3)]


def cloud(kind, count, reach=1.0):
    return lambda b, lot, size: shape(b, [anywhere(lot, reach) for _ in range(count)], kind, lot)


def on_grid(kind, count, part):
    """Ends at multiples of 1/part pixel of the window, which the camera `front` shows."""
    def make(b, lot, size):
        at = lambda side: 2 * (lot.randint(0, part * side) / part) / side - 1
        shape(b, [[at(size[0]), at(size[1]), lot.uniform(-0.9, 0.9)] for _ in range(count)], kind, lot)
    return make


def short(b, lot, size):
    points = []
    for _ in range(400):
        x, y, z = anywhere(lot, 0.95)
        points += [[x, y, z], [x + lot.uniform(-3, 3) / size[0], y + lot.uniform(-3, 3) / size[1], z + lot.uniform(-0.05, 0.05)]]
    shape(b, points, LINES, lot)


def mixed(b, lot, size):
    b.pane(-0.75, -0.75, 0.25, 0.25, 0.3, scenes.RED, 0.5)
    b.pane(-0.5, -0.5, 0.5, 0.5, -0.2, scenes.GREEN, None)
    shape(b, [anywhere(lot) for _ in range(30)], STRIP, lot)
    shape(b, [anywhere(lot) for _ in range(40)], POINTS, lot)
    b.pane(-0.25, -0.25, 0.75, 0.75, 0.1, scenes.BLUE, 0.75)


# Name: what it draws, its camera, and options.
SCENES = {
    "lines": (cloud(LINES, 60), "wide", []),
    "wide lines, d24": (cloud(LINES, 40), "wide", ["--line-width", "2.5", "--depth-format", "d24"]),
    "a strip, rgba16f": (cloud(STRIP, 40), "wide", ["--line-width", "4", "--color-format", "rgba16f"]),
    "ends on halves": (on_grid(LINES, 300, 2), "front", []),
    "ends between subpixels": (on_grid(LINES, 200, 512), "front", ["--line-width", "2"]),
    "short lines": (short, "front", []),
    "lines cut": (cloud(LINES, 60, 3.0), "wide", ["--line-width", "3"]),
    "points": (cloud(POINTS, 300), "wide", []),
    "large points, d24": (cloud(POINTS, 60), "wide", ["--point-size", "6.4", "--depth-format", "d24"]),
    "points on halves": (on_grid(POINTS, 300, 2), "front", ["--point-size", "2"]),
    "points between subpixels": (on_grid(POINTS, 300, 512), "front", ["--point-size", "1.501"]),
    "triangles, lines and points": (mixed, "wide", ["--line-width", "2", "--point-size", "3"]),
}


def write_scene(folder, name, size, driver):
    make, camera, options = SCENES[name]
    if driver == "softpipe":
        options = ["d32f" if word == "d24" else word for word in options]
    builder = scenes.Builder()
    make(builder, random.Random(name), size)
    (folder / "scene.gltf").write_text(builder.text())
    (folder / "camera.json").write_text(json.dumps(CAMERAS[camera]))
    return [folder / "scene.gltf", "--camera", folder / "camera.json", "--background", "0.1,0.2,0.3", *options]


def compared(build, folder, words, profile, driver):
    """The differences of one scene in one size."""
    try:
        pack = packs.Pack(build, folder / "pack", words, profile, ALGORITHMS)
        return packs.agreement(pack, pack.candidate(folder / "candidate", driver))
    finally:
        for made in ("pack", "candidate"):
            shutil.rmtree(folder / made, ignore_errors=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--driver", default="llvmpipe")
    parser.add_argument("--profile", help="default: the driver's")
    parser.add_argument("--sizes", default="97x73,64x64,131x50")
    parser.add_argument("--quick", action="store_true", help="one size")
    options = parser.parse_args()
    keys = ["pixels", "coverage", "depth", "order", "colour", *ALGORITHMS, "targets", "targets that differ"]
    total = dict.fromkeys(keys, 0)
    print("| scene | " + " | ".join(keys) + " |\n|---|" + "---:|" * len(keys))
    for name in SCENES:
        found = dict.fromkeys(keys, 0)
        for text in options.sizes.split(",")[:1 if options.quick else None]:
            with tempfile.TemporaryDirectory() as place:
                folder = pathlib.Path(place)
                words = write_scene(folder, name, [int(n) for n in text.split("x")], options.driver) + ["--size", text]
                for key, value in compared(options.build, folder, words, options.profile or options.driver, options.driver).items():
                    found[key] += value
                    total[key] += value
        print(f"| {name} | " + " | ".join(f"{found[k]:,}" for k in keys) + " |", flush=True)
    print("| all | " + " | ".join(f"{total[k]:,}" for k in keys) + " |")
    return 1 if any(total[k] for k in keys if k not in ("pixels", "targets")) else 0


if __name__ == "__main__":
    sys.exit(main())
