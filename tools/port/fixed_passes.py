#!/usr/bin/env python3
"""Compares weighted_blended, moments and linked_list of the port with the profile llvmpipe, and writes tools/port/FIXED_PASSES.md.

    fixed_passes.py [--build build/release] [--quick] [--driver llvmpipe_sse] [-o PAGE]

Ten scenes in three sizes: every target after every pass, and the pictures. Then the same moments with the driver's own log and exp in place
of the port's. Exit status 1 if anything differs except through these two functions.
"""
import argparse
import pathlib
import shutil
import struct
import sys
import tempfile

sys.dont_write_bytecode = True
import packs  # noqa: E402
from sampled import SCENES, SIZES  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ALGORITHMS = ["weighted_blended", "moments", "linked_list"]


def as_float(code):
    return struct.unpack("<f", struct.pack("<I", code))[0]


def by_driver(pack, candidate):
    """The effect of the driver's log and exp: for each target the number of pixels that differ, for `total` the greatest relative difference, for the
    picture the greatest difference in codes."""
    found = {}
    for number, shown in enumerate(pack.results["moments"]["passes"]):
        for target in shown["targets"]:
            file = candidate / "moments_log" / f"pass.{number:03}" / f"{target['name']}.npy"
            if not file.exists():
                continue
            pairs = list(zip(pack.target(target), packs.read(file)))
            found[target["name"]] = sum(ours != theirs for ours, theirs in pairs)
            if target["name"] == "total":
                values = [(as_float(ours[0]), as_float(theirs[0])) for ours, theirs in pairs]
                found["relative"] = max((abs(a - b) / a for a, b in values if a > 0), default=0)
            if target["name"] == "result" and "u1" in str(file.read_bytes()[:packs.HEADER]):
                found["codes"] = max(abs(a - b) for ours, theirs in pairs for a, b in zip(ours, theirs))
    return found


def measure(build, words, profile, driver, totals, own):
    """Adds one scene in one size."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        pack = packs.Pack(build, folder / "pack", words, profile, ALGORITHMS)
        candidate = pack.candidate(folder / "candidate", driver)
        for key, value in packs.agreement(pack, candidate).items():
            totals[key] = totals.get(key, 0) + value
        totals["pixels"] = totals.get("pixels", 0) + len(pack.target(pack.results["moments"]["picture"]))
        shutil.rmtree(candidate)
        log = pack.candidate(folder / "log", driver, algorithms=["moments_log"])
        for key, value in by_driver(pack, log).items():
            own[key] = max(own.get(key, 0), value) if key in ("relative", "codes") else own.get(key, 0) + value


def page(rows, totals, own, renderer, scenes):
    keys = ["pixels", "targets", "targets that differ", *ALGORITHMS]
    table = ["| scene, in three sizes | pixels | targets | targets that differ | " + " | ".join(f"pictures: {name}" for name in ALGORITHMS) + " |",
             "|---|" + "---:|" * len(keys)]
    for name, row in [*rows.items(), ("all", totals)]:
        table.append(f"| {name} | " + " | ".join(f"{row.get(key, 0):,}" for key in keys) + " |")
    return f"""# Weighted sums, moments and lists on llvmpipe

Do the pictures of the OpenGL port with `weighted_blended`, `moments` (four) and `linked_list` equal those of Strata's profile `llvmpipe`? The port
shares no code with Strata; `tools/port/fixed_passes.py` executes it on a CPU with
{renderer}.
All bits of {scenes} scenes in three sizes are compared: all targets after all passes, and the pictures. The last three columns count pixels that
differ.

{chr(10).join(table)}

`weighted_blended` has two targets with different blend functions (OpenGL 4.0). `linked_list` has nodes and heads in shader storage (OpenGL 4.3): one
thread of llvmpipe processes all fragments of a pixel, so that they get their nodes in submission order, like those of Strata. The order may
differ on another driver. `moments` computes its logarithm, exponential and bound in binary64 (OpenGL 4.0) by the formulas of
[algorithms.md](../../peeling/reference/algorithms.md) 22.

Most ports would use GLSL's `log` and `exp`, which each driver approximates differently. With those of this driver, of the same
{totals.get('pixels', 0):,} pixels the sum of absorbances differs at {own.get('total', 0):,} (relatively by at most {own.get('relative', 0):.1e}), the moments at {own.get('moments', 0):,}, the weighted
colours at {own.get('sums', 0):,}, and the picture at {own.get('result', 0):,}, by at most {own.get('codes', 0)}/255 if it has 8 bits.

    tools/port/fixed_passes.py --build build/release      # this page; needs strata_port (-DSTRATA_PORT=ON)
"""


def renderer_of(build, folder, profile, driver):
    pack = packs.Pack(build, folder / "named", [*next(iter(SCENES.values())), "--size", "16x16"], profile, ALGORITHMS)
    candidate = pack.candidate(folder / "name", driver, picture_only=True)
    return packs.json.loads((candidate / "candidate.json").read_text())["made_by"].removeprefix("strata_port, ")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--driver", default="llvmpipe", choices=["llvmpipe", "llvmpipe_sse"])
    parser.add_argument("--quick", action="store_true", help="three scenes in one size, and no page")
    parser.add_argument("-o", "--out", default=HERE / "FIXED_PASSES.md", type=pathlib.Path)
    options = parser.parse_args()
    scenes = dict(list(SCENES.items())[:3]) if options.quick else SCENES
    rows, own = {}, {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        profile = packs.profile_file(folder, options.driver)
        for name, words in scenes.items():
            rows[name] = {}
            for size in SIZES[:1] if options.quick else SIZES:
                measure(options.build, [*words, "--size", size], profile, options.driver, rows[name], own)
            print(name, rows[name], flush=True)
        renderer = renderer_of(options.build, folder, profile, options.driver)
    totals = {}
    for row in rows.values():
        for key, value in row.items():
            totals[key] = totals.get(key, 0) + value
    if not options.quick:
        options.out.write_text(page(rows, totals, own, renderer, len(scenes)))
    return 1 if any(totals[key] for key in ["targets that differ", *ALGORITHMS]) else 0


if __name__ == "__main__":
    sys.exit(main())
