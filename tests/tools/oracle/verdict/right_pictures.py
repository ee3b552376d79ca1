#!/usr/bin/env python3
"""Tests that `strata compare SCENE PICTURE` calls right every picture that this program can make with its profiles, formats and orders, given only
the scene.

    right_pictures.py STRATA [--scenes N] [--each N]

Renders each of N scenes under every built-in profile with alternating algorithms and formats, so that each pair of them occurs. Combinations that a
profile refuses do not count. Exit status 1 if a right picture is called wrong.
"""
import argparse
import itertools
import pathlib
import subprocess
import sys
import tempfile

PROFILES = ["geforce3", "geforce8", "geforce8_dx101", "ideal", "llvmpipe", "llvmpipe_sse", "softpipe", "swiftshader", "direct3d11"]
ALGORITHMS = ["dual", "front_to_back", "depth_units", "layer_peel", "dual_independent", "stencil_routed_k_buffer", "coherent_stencil",
              "shadow_map_depth_replace", "a_buffer", "coherent_ideal", "batched"]
FORMATS = [["--color-format", "rgba8"], ["--color-format", "rgba16f"], ["--color-format", "rgba32f"],
           ["--color-format", "rgba8", "--result-format", "rgba32f"], ["--color-format", "rgba16f", "--result-format", "rgba8"]]
DRAWN, REFUSED = 0, 2


def scenes():
    """Thirty scenes: named ones, close and distant planes, volumes, and random triangles, from several sides."""
    yield ["teapot"]
    yield ["showroom"]
    yield ["shadow-demo"]
    for case in ("cyclic-overlap", "woven", "inside-out", "planes-8-close"):
        yield ["hard:case=" + case]
    for count, gap in ((3, 4), (8, 1), (8, 64), (17, 4096)):
        yield [f"planes:count={count},gap={gap}", "--orbit", f"{10 * count},20"]
    for slices, order in ((8, "near"), (24, "far"), (60, "near")):
        yield [f"volume-beam:slices={slices},order={order}"]
    for seed, triangles in ((1, 20), (2, 40), (3, 80), (4, 120), (5, 200), (6, 30), (7, 60), (8, 100)):
        yield [f"random:seed={seed},triangles={triangles}"]
    for orbit, alpha in (("0,0", 0.3), ("75,40", 0.6), ("200,-30", 0.9), ("120,85", 0.5)):
        yield ["teapot:tessellation=6", "--orbit", orbit, "--alpha", str(alpha)]
    for orbit in ("80,10", "160,50", "250,-20", "330,70"):
        yield ["showroom", "--orbit", orbit, "--background", "0.2,0.3,0.5"]


def run(words):
    try:
        return subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(words, -1, "", "no end within 120 s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("strata", type=pathlib.Path)
    parser.add_argument("--scenes", type=int, default=30)
    parser.add_argument("--each", type=int, default=2, metavar="N", help="pictures of a scene and a profile (default 2)")
    options = parser.parse_args()
    kinds = itertools.cycle((a, f) for f, a in zip(itertools.cycle(FORMATS), itertools.islice(itertools.cycle(ALGORITHMS), 55)))
    judged, wrong = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder) / "right.exr"
        for words in itertools.islice(scenes(), options.scenes):
            before = judged, wrong
            for profile in PROFILES:
                for algorithm, formats in itertools.islice(kinds, options.each):
                    how = ["--algorithm", algorithm, "--profile", profile, *formats]
                    drawn = run([options.strata, "render", *words, "--size", "48x36", *how, "-q", "-o", picture])
                    if drawn.returncode not in (DRAWN, REFUSED):
                        sys.exit(f"right_pictures.py: {' '.join(words + how)}: {drawn.stderr.strip()}")
                    if drawn.returncode == REFUSED or not picture.exists():
                        continue
                    found = run([options.strata, "compare", *words, picture])
                    picture.unlink()
                    judged += 1
                    if found.returncode != 0:
                        wrong += 1
                        print(f"{' '.join(words + how)}: {found.stdout.splitlines()[0] if found.stdout else found.stderr.strip()}")
            print(f"{' '.join(words)}: {judged - before[0] - wrong + before[1]} of {judged - before[0]} called right", flush=True)
    print(f"{judged - wrong} of {judged} right pictures are called right")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
