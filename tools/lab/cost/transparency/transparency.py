#!/usr/bin/env python3
"""Writes TRANSPARENCY.md and its plots: the error, work and memory of the algorithms of few passes, and the whole table to build/transparency.

    tools/lab/cost/transparency/transparency.py [--models ../shared/models] [--strata build/release/strata] [--out build/transparency]

Measures each scene by `strata cost --knob transparency`, unless its folder has the results, and the flicker of some algorithms along a path (flicker.py).
Models that are not there are left out. tests/docs/advice.py holds the advice to the table.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys

import flicker
import transparency_scenes
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from ranking import ranking_plot  # noqa: E402
from rows import card_time, ranked, rows_of, standard_of  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[3]
SIZE = "256x256"
SCENES = {
    "teapot, alpha 0.5": ["teapot", "--alpha", "0.5"],
    "teapot, alpha 0.02": ["teapot", "--alpha", "0.02"],
    "teapot, alpha 0.98": ["teapot", "--alpha", "0.98"],
    "showroom": ["showroom"],
    "random": ["random:seed=7,triangles=400"],
    "64 planes": ["planes:count=64", "--alpha", "0.5"],
    "coplanar": ["hard:case=coincident"],
    "beam": ["volume-beam:slices=64"],
}
MODELS = {"dragon": "dragon.glb", "bunny": "bunny.glb", "sponza": "sponza.glb"}
PLOTTED = ["teapot, alpha 0.5", "dragon"]
SHOWN = ["teapot, alpha 0.5", "showroom", "hair", "dragon", "sponza"]  # columns of the short page
FLICKERING = "hair"
BUFFERED = ("linked_list", "atomic_loop", "hybrid_transparency")
ROWS = ["weighted_blended", "moments", "moments_quantized", "stochastic --stochastic-samples 8", "multi_layer", "adaptive",
        "atomic_loop", "hybrid_transparency", "bucket_peel", "linked_list --pixel-nodes 8", "linked_list", "dual", "front_to_back_ties", "dual_ties"]
FLICKERS = ["weighted_blended", "moments", "stochastic --stochastic-samples 8", "multi_layer", "hybrid_transparency", "linked_list --pixel-nodes 8",
            "linked_list", "dual", "front_to_back_ties"]
EPSILON = "dual --compare-epsilon 1e-4"  # a band of depths that count as equal
# Algorithms that need buffers or ordered views.
UNORDERED = ("linked_list", "linked_list --pixel-nodes 8", "atomic_loop", "hybrid_transparency", "multi_layer", "adaptive", "moments_quantized")
# What a port asks for: the words of the advice, most bytes a pixel, most passes, and what is left out.
DEMANDS = [("one pass and 16 bytes a pixel", 16, 1, ("linked_list",)), ("two passes and 48 bytes a pixel", 48, 2, ("linked_list",)),
           ("two passes and 100 bytes a pixel", 100, 2, ("linked_list",)), ("blending alone", math.inf, math.inf, UNORDERED),
           ("lists of any length", math.inf, math.inf, ())]


def measured(options, name, words):
    folder = options.out / "".join(c if c.isalnum() else "-" for c in name)
    if not (folder / "results.jsonl").exists():
        subprocess.run([str(options.strata), "cost", *map(str, words), "--size", SIZE, "--knob", "transparency", "--repeat", "1", "--clock", "processor",
                        "-o", str(folder)], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "results.csv", newline="") as file:
        return folder, {row["value"]: row for row in csv.DictReader(file) if row["knob"] == "transparency"}


def card_plot(name, folder):
    rows = rows_of(folder)
    standard = standard_of(rows)
    return ranking_plot(ranked(rows), f"{name}: best first", lambda row: card_time(row, standard), "card's time / default")


def figure(text):
    return f"{float(text):.3g}" if text else "-"


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] + ["---:"] * (len(head) - 1), *rows]) + "\n"


def whole_table(found):
    rows = []
    for value in next(iter(found.values())):
        first = next(iter(found.values()))[value]
        cells = [" / ".join(figure(of[value][key]) for key in ("rmse", "max_difference", "ssim")) for of in found.values()]
        rows.append([f"`{value}`", first["geometry_passes"], first["bytes_per_pixel"], *cells])
    return table(["algorithm and options", "passes", "bytes a pixel", *found], rows)


def short_rows(found):
    """The cells of the page's table by algorithm: errors of the shown scenes, bytes a pixel, passes, time."""
    names = [name for name in SHOWN if name in found]
    cost_of = found[names[0]]
    cheapest = min(float(row["modelled_seconds"]) for value, row in cost_of.items() if not value.startswith((*BUFFERED, "a_buffer", "painter")))
    return {value: [*(figure(found[name][value]["rmse"]) for name in names), figure(cost_of[value]["bytes_per_pixel"]), cost_of[value]["geometry_passes"],
                    "-" if value.startswith(BUFFERED) else f"{float(cost_of[value]['modelled_seconds']) / cheapest:.2g}"] for value in ROWS}


def mean(cells, scenes):
    """The geometric mean of the errors of a row."""
    return math.exp(sum(math.log(float(cell)) for cell in cells[:scenes]) / scenes)


def advice(rows, scenes):
    for words, most_bytes, most_passes, without in DEMANDS:
        able = {value: cells for value, cells in rows.items()
                if float(cells[scenes]) <= most_bytes and int(cells[scenes + 1]) <= most_passes and value not in without}
        best = min(able, key=lambda value: (round(mean(able[value], scenes), 3), float(able[value][scenes])))
        yield f"- With {words}: `{best}`, mean error {mean(able[best], scenes):.3g}."


def page(found, flickering, pictures):
    rows = short_rows(found)
    names = [name for name in SHOWN if name in found]
    body = [[f"`{value}`", *cells, figure(str(flickering[value])) if value in flickering else "-"] for value, cells in rows.items()]
    plots = "\n\n".join(f"![Errors and the card's time: {name}]({file})" for name, file in pictures.items())
    return f"""# What accuracy costs with algorithms of few passes

How far from the exact picture is each algorithm, and what does it take? The emulation (on a CPU, `strata cost --knob transparency`) renders {len(found)}
scenes of {SIZE} pixels as a GeForce 8800 with 8-bit colours would, with the features that an algorithm needs beyond it. Figures are RMSE in
1/255 against a picture in which nothing is rounded or snapped; `linked_list`, which is exact, shows what rounding leaves.

{table(["algorithm", *names, "bytes a pixel", "passes", "card's time", "flicker"], body)}
*Bytes a pixel*, *passes* and *card's time* are of the first scene: targets and buffers; what the card's rates allow, as a multiple of
the cheapest, without traffic in buffers. *Flicker*: the RMS change of the error between {flicker.FRAMES} frames of {FLICKERING},
{flicker.STEP} degrees apart; {flickering[EPSILON]:.2g} for `{EPSILON}`.

## Advice

The least geometric mean of the errors in the table (tests/docs/advice.py checks it):

{chr(10).join(advice(rows, len(names)))}

A list cut at 8 nodes keeps the first 8 submitted, not the nearest.
`dual` loses fragments of equal depths (showroom); `dual_ties` does not.

{plots}

    tools/lab/cost/transparency/transparency.py      # this page; build/transparency/TRANSPARENCY.md: all rows and scenes, RMSE / maximum / SSIM
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=pathlib.Path, default=ROOT / "../shared/models")
    parser.add_argument("--strata", type=pathlib.Path, default=ROOT / "build/release/strata")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/transparency")
    options = parser.parse_args()
    scenes = dict(SCENES)
    for name, file in MODELS.items():
        if (options.models / file).exists():
            scenes[name] = [options.models / file, "--alpha", "0.5", *(["--orbit", "120,20"] if name == "dragon" else [])]
    options.out.mkdir(parents=True, exist_ok=True)
    written = transparency_scenes.write_all(options.out / "scenes")
    scenes.update({name: [path, "--orbit", "20,10"] for name, path in written.items()})
    found, pictures = {}, {}
    for name, words in scenes.items():
        folder, found[name] = measured(options, name, words)
        if name in PLOTTED:
            pictures[name] = f"TRANSPARENCY.{name.split(',')[0]}.svg"
            (HERE / pictures[name]).write_text(card_plot(name, folder), encoding="utf-8")
    flickering = flicker.flickers(options.strata, [written[FLICKERING]], [*FLICKERS, EPSILON])
    (options.out / "TRANSPARENCY.md").write_text(f"# All rows: RMSE in 1/255, maximum in 1/255 and SSIM, {SIZE}\n\n{whole_table(found)}")
    (HERE / "TRANSPARENCY.md").write_text(page(found, flickering, pictures))


if __name__ == "__main__":
    main()
