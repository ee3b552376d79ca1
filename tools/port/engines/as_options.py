#!/usr/bin/python3
"""Renders each scene as an engine's peel does, with options of `strata render`, counts the pixels of the engine's own picture that are more than
one code off, and writes OPTIONS.md.

    as_options.py [--build build/release] [--only SCENE]... [--keep FOLDER] [-o PAGE]

The engine draws its picture unless --keep has it. Exit status 1 if a picture that OPTIONS.md says to be reproduced is not; 77, and a sentence, if
a program or a package is missing.
"""
import argparse
import json
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
import draw  # noqa: E402
import pack_scene  # noqa: E402
import scenes  # noqa: E402
import table  # noqa: E402
import truth  # noqa: E402
import web  # noqa: E402

ROUNDS = "colours are divided by alpha in 8 bits after each peel: 2 or 3 codes"
SHARE = 0.999  # of a reproduced picture's pixels are within one code
HALVES = ["--profile", "swiftshader", "--color-format", "rgba16f", "--result-format", "rgba8"]
EPSILON = ["--compare-epsilon", "1.2e-7"]  # VTK's 1e-7 is added in binary32: two units of the depths from 0.5 to 1
OPTIONS = {
    ("vtk", "dual"): ["--algorithm", "dual", "--max-passes", "5", "--tail", "blend", *EPSILON, "--profile", "llvmpipe"],
    ("vtk", "peeling"): ["--algorithm", "front_to_back", "--max-passes", "3", "--tail", "blend", *EPSILON, "--profile", "llvmpipe"],
    ("babylon", "oit"): ["--algorithm", "dual", "--max-passes", "6", *HALVES],
    ("molstar", "dpoit"): ["--algorithm", "dual", "--max-passes", "3", *HALVES, "--back-format", "rgba8"],
}
# What the options cannot say of the engine (tools/docs/engines.md 5), by the scenes that show it.
LEQUAL = "fragments at the opaque depth are kept"
UNLIKE = {
    ("vtk", "dual"): {"decal": LEQUAL, "floor": "it ends where no far fragment was written", "gradient": "colours of corners are bytes: 2 codes"},
    ("vtk", "peeling"): {"decal": LEQUAL, "ties": "of equal depths the last submitted stays", "gradient": ROUNDS, "panes": ROUNDS, "stack": ROUNDS,
                         "torus": ROUNDS},
    ("babylon", "oit"): {"decal": LEQUAL},
    ("molstar", "dpoit"): {},
}


def compared(strata, folder, name, engine, way, browser):
    """Of one scene and engine: pixels, those that differ, and those that differ by more than one code."""
    pack = folder / "packs" / name
    if not (pack / "manifest.json").exists():
        background = ",".join(str(c / 255) for c in table.BACKGROUND)
        table.run([strata, "golden", *table.words_of(name, folder / "scenes"), "--background", background, "--algorithm", "dual", "-o", pack, "-q"])
    theirs = table.picture_of(folder, engine, name, way)
    if not theirs.exists():
        draw.write(draw.draw(engine, pack_scene.read_scene(pack), way, browser), theirs, None)
    ours = folder / "ours" / f"{engine}.{way}.{name}.png"
    ours.parent.mkdir(exist_ok=True)
    table.run([strata, "render", pack, *OPTIONS[engine, way], "--no-audit", "-q", "-o", ours])
    said = json.loads(table.run([strata, "compare", ours, theirs, "--channels", "rgb", "--json"], allowed=(0, 1)).stdout)
    distances = dict(said["targets"][0]["distances"])
    return said["width"] * said["height"], said["differing"], said["differing"] - distances.get(1, 0)


def is_reproduced(pixels, beyond):
    return beyond <= (1 - SHARE) * pixels


def page(found):
    """`found`: by engine and way, by scene: (pixels, differing, beyond)."""
    rows, others = [], []
    for (engine, way), of in found.items():
        alike = [name for name, (pixels, _, beyond) in of.items() if is_reproduced(pixels, beyond)]
        equal = sum(differing == 0 for _, differing, _ in of.values())
        options = " ".join(OPTIONS[engine, way])
        rows.append(f"| {engine}, {way} | `{options}` | {len(of)} | {len(alike)} | {equal} |")
        others += [f"| {engine}, {way} | {name} | {100 * beyond / pixels:.1f} % | {UNLIKE[engine, way].get(name, ROUNDS)} |"
                   for name, (pixels, _, beyond) in of.items() if name not in alike]
    newline = "\n"
    return f"""# Engines' peels as options of Strata

Which options render what an engine's peel renders? Each engine (VTK on llvmpipe, the others on SwiftShader, all on a CPU) draws
{len(next(iter(found.values())))} scenes of [RESULTS.md](RESULTS.md), and the emulation renders them with the options below. A picture is *reproduced* if at
least 99.9 % of its pixels are within one code of 255, and *equal* if all are the same.

| engine | `strata render PACK ...` | scenes | reproduced | equal |
|---|---|---:|---:|---:|
{newline.join(rows)}

Passes, formats and the rest of these engines' rules are in [engines.md](../../docs/engines.md#5-what-each-engine-does), with file and line.

| not reproduced | scene | pixels more than a code off | what no option says |
|---|---|---:|---|
{newline.join(others)}

    tools/port/engines/as_options.py      # this page; tools/port/engines/install.sh first
"""


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--build", default=draw.HERE.parents[2] / "build" / "release", type=pathlib.Path)
    parser.add_argument("--only", action="append", choices=[*scenes.SCENES, *table.HARD])
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=draw.HERE / "OPTIONS.md")
    return parser.parse_args()


def main():
    given = parsed()
    lacking = [draw.missing(engine) for engine in ("vtk", "babylon", "molstar") if draw.missing(engine)]
    if lacking:
        print("\n".join(lacking))
        return draw.SKIPPED
    if not os.environ.get("DISPLAY"):
        return draw.with_display()
    found = {key: {} for key in OPTIONS}
    with tempfile.TemporaryDirectory() as temporary:
        folder = (given.keep or pathlib.Path(temporary)).resolve()
        scenes.main(folder / "scenes", ())
        with web.Browser(draw.PACKAGES) as browser:
            for name in given.only or [*scenes.SCENES, *table.HARD]:
                for engine, way in OPTIONS:
                    if (engine, name) not in truth.CANNOT:
                        found[engine, way][name] = compared(given.build / "strata", folder, name, engine, way, browser)
                        print(engine, way, name, *found[engine, way][name], flush=True)
    given.output.write_text(page(found))
    failed = [(key, name) for key, of in found.items() for name, (pixels, _, beyond) in of.items()
              if name not in UNLIKE[key] and not is_reproduced(pixels, beyond)]
    for (engine, way), name in failed:
        print(f"as_options.py: {engine} {way}: {name}: expected the engine's picture within one code")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
