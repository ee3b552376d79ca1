#!/usr/bin/env python3
"""Checks that the program calls its own pictures right: thirty settings of `render`, each judged by its own options.

    own_pictures.py STRATA [--all] [--jobs N]

Every setting is rendered by five algorithms and written as PNG and EXR, without what the program writes beside the pixels (text chunks, attributes),
and as NPY. `compare` and `diagnose` must say that it is right, with exit status 0. Without --all each setting has one algorithm, in turn. Prints the
pictures that are not called right. Exit status 1 if there are any.
"""
import argparse
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

ALGORITHMS = ["front_to_back", "dual", "a_buffer", "depth_units", "weighted_average"]
SCENES = ["teapot", "showroom", "random:seed=3,triangles=40"]
SIZE = ["--size", "40x30"]
SETTINGS = [
    "", "--alpha 0.5", "--background 0.2,0.3,0.5", "--background none", "--background 1,1,1,0.5", "--color-space linear",
    "--color-space linear --color-format rgba16f", "--color-space linear --background none --color-format rgba32f", "--color-format rgba16f",
    "--color-format rgba32f", "--color-format rgba16f --result-format rgba8", "--color-space linear --color-format srgb8_alpha8",
    "--color-space linear --color-format rgba16f --result-format r11g11b10f",
    "--color-space linear --background none --color-format srgb8_alpha8", "--color-format rgba32f --background none", "--profile llvmpipe",
    "--profile ideal", "--profile swiftshader", "--profile direct3d11", "--profile softpipe", "--origin lower-left", "--samples 4",
    "--samples 2 --shading pixel", "--samples 8 --profile ideal", "--samples 4 --origin lower-left --profile llvmpipe",
    "--samples 4 --color-format rgba16f --background 0.2,0.3,0.5", "--samples 4 --color-space linear", "--depth-format d16",
    "--depth-format d32f --depth-order greater --profile ideal", "--clip-depth zero-to-one", "--no-light --orbit 100,-35", "--polygon-offset 1,1",
    "--scissor 5,5,20,12",
]


def run(words):
    return subprocess.run(words, capture_output=True, text=True)


def without_text(png):
    """A PNG's bytes without its text chunks."""
    kept, at = png[:8], 8
    while at < len(png):
        length = int.from_bytes(png[at:at + 4], "big") + 12
        if png[at + 4:at + 8] not in (b"tEXt", b"zTXt", b"iTXt"):
            kept += png[at:at + length]
        at += length
    return kept


def pictures(strata, folder, scene, options, algorithm):
    """The paths of the picture's files; None if the program refuses the setting."""
    files = [folder / "picture.png", folder / "picture.exr"]
    for file in files:
        said = run([strata, "render", scene, *SIZE, *options, "--algorithm", algorithm, "--no-audit", "-q", "-o", file])
        if said.returncode != 0:
            return None
    files[0].write_bytes(without_text(files[0].read_bytes()))
    # Attributes of another program: names of the same length, so that no offset moves.
    files[1].write_bytes(files[1].read_bytes().replace(b"strata:", b"foreign"))
    pack = folder / "pack"
    if run([strata, "golden", scene, *SIZE, *options, "--algorithm", algorithm, "-q", "-o", pack]).returncode == 0:
        files.append(pack / "expected" / algorithm / "picture.npy")
    return files


def judged(strata, number, algorithm):
    """Of one setting and algorithm: the number of pictures, and what is said of those that are not called right."""
    scene, options = SCENES[number % len(SCENES)], SETTINGS[number].split()
    wrong, count = [], 0
    with tempfile.TemporaryDirectory() as temporary:
        files = pictures(strata, pathlib.Path(temporary), scene, options, algorithm)
        for file in files or []:
            for command in ("compare", "diagnose"):
                said = run([strata, command, scene, file, *options, "--algorithm", algorithm])
                count += 1
                if said.returncode != 0:
                    first = (said.stdout + said.stderr).split("\n")[0]
                    wrong.append(f"{command} {scene} {file.name} {' '.join(options)} --algorithm {algorithm}: {said.returncode}: {first}")
    return count, wrong, [] if files else [f"{' '.join(options)} --algorithm {algorithm}"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("strata")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    tasks = [(number, algorithm) for number in range(len(SETTINGS)) for k, algorithm in enumerate(ALGORITHMS)
             if options.all or k == number % len(ALGORITHMS)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        found = list(pool.map(lambda task: judged(options.strata, *task), tasks))
    wrong = [line for _, lines, _ in found for line in lines]
    refused = [line for _, _, lines in found for line in lines]
    print("\n".join(wrong))
    if refused:
        print("refused by render: " + "; ".join(refused))
    print(f"{len(SETTINGS)} settings: {sum(count for count, _, _ in found)} verdicts, {len(wrong)} of them not right")
    return 1 if wrong or len(refused) > len(tasks) // 10 else 0


if __name__ == "__main__":
    sys.exit(main())
