#!/usr/bin/env python3
"""Compares llvmpipe's pictures with 4 samples per pixel with the profile llvmpipe.

    sampled.py --build build/release [--quick] [--driver llvmpipe_sse]

Ten scenes in three sizes: every target after every pass of each sample shaded separately, by front_to_back, dual and weighted_average; packs of all
samples, by `strata compare PACK CANDIDATE`; the resolved pictures; and the resolved pictures of programs that run once a pixel, at its centre or centroid, and load sample 0. Prints a table of
the differences. Exit status 1 if there are any.
"""
import argparse
import json
import pathlib
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
import packs  # noqa: E402

ALGORITHMS = ["front_to_back", "dual", "weighted_average"]
SAMPLES = 4
SIZES = ["97x73", "64x64", "33x121"]
SCENES = {
    "teapot": ["teapot", "--alpha", "0.5"],
    "random": ["random:seed=3,triangles=60"],
    "random, rgba16f": ["random:seed=5,triangles=120", "--color-format", "rgba16f"],
    "random, rgba32f": ["random:seed=9,triangles=80", "--color-format", "rgba32f"],
    "planes": ["planes:count=12"],
    "beam": ["volume-beam:slices=16"],
    "coincident": ["hard:case=coincident"],
    "cyclic overlap": ["hard:case=cyclic-overlap"],
    "opaque": ["hard:case=opaque-crossing"],
    "through near": ["hard:case=through-near"],
}


def end_alike(pack, candidate):
    """A peel of the profile ends with its own sample, one of the driver with the last of all samples. If the driver has more passes, the profile's last
    pass is not compared."""
    for name, result in pack.results.items():
        if len(list((candidate / name).glob("pass.*"))) > len(result["passes"]):
            result["passes"].pop()


SHADINGS = {
    "sample": [],
    "centre": ["--shading", "pixel", "--load-sample", 0, "--max-passes", 200],
    "centroid": ["--shading", "pixel", "--interpolate", "centroid", "--load-sample", 0, "--max-passes", 200],
}


def resolved(build, folder, words, profile, driver, shading):
    """The number of algorithms whose resolved picture differs between the driver and `strata render` with the profile."""
    pack = packs.Pack(build, folder / "first", [*words, "--samples", SAMPLES, "--sample", 0], profile, ALGORITHMS)
    candidate = folder / "resolved"
    packs.run([build / "strata_port", pack.folder, "-o", candidate, "--driver", driver, "--algorithm", ",".join(ALGORITHMS), "--samples", SAMPLES,
               "--interpolate", shading, "--picture-only"])
    wrong = 0
    for name in pack.results:
        picture = folder / f"{name}.exr"
        packs.run([build / "strata", "render", *words, "--samples", SAMPLES, *SHADINGS[shading], "--profile", profile, "--algorithm", name, "--no-audit", "-q", "-o", picture])
        said = packs.run([build / "strata", "compare", picture, candidate / name / "picture.npy"], allowed=(0, 1))
        wrong += not said.startswith("equal")
    return wrong


def all_at_once(build, folder, words, profile, driver, shading):
    """The number of algorithms of a pack of all samples of which a target after a pass, or the picture, differs, or is missing."""
    pack = packs.Pack(build, folder / "all", [*words, "--samples", SAMPLES, *SHADINGS[shading]], profile, ALGORITHMS)
    candidate = folder / "candidate"
    packs.run([build / "strata_port", pack.folder, "-o", candidate, "--driver", driver])
    said = json.loads(packs.run([build / "strata", "compare", pack.folder, candidate, "--exact", "--json"], allowed=(0, 1)))
    shutil.rmtree(pack.folder)
    shutil.rmtree(candidate)
    return sum(not of["equal"] or of["passes_compared"] != len(pack.results[of["algorithm"]]["passes"]) for of in said)


def measure(build, words, profile, driver):
    """For one scene and size: the numbers of targets, of those that differ, and of pictures whose resolve differs."""
    found = {"targets": 0, "targets that differ": 0}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for sample in range(SAMPLES):
            pack = packs.Pack(build, folder / "pack", [*words, "--samples", SAMPLES, "--sample", sample], profile, ALGORITHMS)
            candidate = folder / "candidate"
            packs.run([build / "strata_port", pack.folder, "-o", candidate, "--driver", driver, "--algorithm", ",".join(pack.results),
                       "--samples", SAMPLES, "--sample", sample])
            end_alike(pack, candidate)
            for key, value in packs.agreement(pack, candidate).items():
                found[key] = found.get(key, 0) + value
            shutil.rmtree(candidate)
            shutil.rmtree(pack.folder)
        for shading in SHADINGS:
            found[f"resolved, {shading}"] = resolved(build, folder, words, profile, driver, shading)
            found[f"all samples, {shading}"] = all_at_once(build, folder, words, profile, driver, shading)
            shutil.rmtree(folder / "first")
            shutil.rmtree(folder / "resolved")
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--driver", default="llvmpipe", choices=["llvmpipe", "llvmpipe_sse"])
    parser.add_argument("--quick", action="store_true", help="two scenes in one size")
    options = parser.parse_args()
    scenes = dict(list(SCENES.items())[:2]) if options.quick else SCENES
    keys = ["targets", "targets that differ", "pixels", "coverage", "depth", "order", "colour", *ALGORITHMS, 
            *(f"{what}, {shading}" for what in ("resolved", "all samples") for shading in SHADINGS)]
    print("| scene | " + " | ".join(keys) + " |")
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        profile = packs.profile_file(folder, options.driver)
        for name, words in scenes.items():
            total = {}
            for size in SIZES[:1] if options.quick else SIZES:
                for key, value in measure(options.build, [*words, "--size", size], profile, options.driver).items():
                    total[key] = total.get(key, 0) + value
            print(f"| {name} | " + " | ".join(str(total.get(key, "-")) for key in keys) + " |", flush=True)
            wrong += sum(value for key, value in total.items() if key not in ("targets", "pixels"))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
