#!/usr/bin/env python3
"""Compares right pictures of several samples per pixel, which OpenGL draws with its origin at either corner, with their scenes.

    origins.py --build build/release [--quick] [--driver llvmpipe]

A port without glClipControl draws with the origin at the lower left, as a browser does, and its rows are turned before they are written. Sample
positions are then mirrored in the picture. `compare` and `diagnose` are given the scene and the number of samples, and no --origin. Programs run once a
sample: a peel whose programs run once a pixel is not right at edges. Prints a table of the pictures that are right. Exit status 1 unless all are.
"""
import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import packs  # noqa: E402

ALGORITHMS = ["front_to_back", "dual"]
SIZE = ["--size", "64x49"]
SCENES = [["teapot", "--alpha", "0.5"], ["random:seed=3,triangles=60"], ["planes:count=12"], ["hard:case=opaque-crossing"]]
SAMPLES = 4  # llvmpipe has no other number


def turned(path):
    """Turns the rows of an NPY file with rows, columns and channels of bytes."""
    data = path.read_bytes()
    header, rows = data[:packs.HEADER], data[packs.HEADER:]
    columns, channels = (int(n) for n in header.decode("latin-1").split("'shape': (")[1].split(")")[0].split(",")[1:3])
    row = columns * channels
    path.write_bytes(header + b"".join(rows[i:i + row] for i in range(len(rows) - row, -1, -row)))


def said_of(build, folder, scene, driver, origin):
    """The first lines of compare and diagnose for each algorithm, and their exit statuses."""
    pack = packs.Pack(build, folder / "pack", [*scene, *SIZE, "--samples", SAMPLES, "--sample", 0], driver, ALGORITHMS)
    candidate = folder / "candidate"
    packs.run([build / "strata_port", pack.folder, "-o", candidate, "--driver", driver, "--algorithm", ",".join(ALGORITHMS), "--samples", SAMPLES,
               "--origin", origin, "--picture-only"])
    found = []
    for algorithm in ALGORITHMS:
        picture = candidate / algorithm / "picture.npy"
        if origin == "lower-left":
            turned(picture)
        words = [*scene, picture, "--profile", driver, "--samples", SAMPLES]
        for command in ("compare", "diagnose"):
            more = [] if command == "compare" else ["--algorithm", algorithm]
            text = packs.run([build / "strata", command, words[0], picture, *words[1:len(scene)], "--profile", driver, "--samples", SAMPLES, *more],
                             allowed=(0, 1))
            found.append((command, algorithm, text.split("\n")[0], text.startswith("right")))
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--driver", default="llvmpipe", choices=["llvmpipe", "llvmpipe_sse"])
    parser.add_argument("--quick", action="store_true", help="two scenes")
    options = parser.parse_args()
    wrong = 0
    print("| scene | origin | right by compare | by diagnose |\n|---|---|---|---|")
    for scene in SCENES[:2] if options.quick else SCENES:
        for origin in ("upper-left", "lower-left"):
            with tempfile.TemporaryDirectory() as folder:
                found = said_of(options.build, pathlib.Path(folder), scene, options.driver, origin)
            count = [f"{sum(right for of, _, _, right in found if of == command)} of {sum(of == command for of, *_ in found)}"
                     for command in ("compare", "diagnose")]
            print(f"| {' '.join(scene)} | {origin} | {count[0]} | {count[1]} |", flush=True)
            for command, algorithm, line, right in found:
                if not right:
                    wrong += 1
                    print(f"{command} {algorithm}: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
