#!/usr/bin/env python3
"""Writes TRANSPARENCY.md and its plots: the error, work and memory of the algorithms of few passes, and the whole table to build/transparency.

    tools/cost/transparency.py [--models ../shared/models] [--strata build/release/strata] [--out build/transparency]

Runs `strata cost --knob transparency` on each scene. A run that was stopped goes on. Models that are not there are left out.
"""
import argparse
import csv
import pathlib
import shutil
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
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
SHOWN = ["teapot, alpha 0.5", "showroom", "random", "dragon", "sponza"]  # columns of the short page
NARROW = ["teapot, alpha 0.5", "teapot, alpha 0.98", "random", "beam", "dragon"]  # rows of its second table
BUFFERED = ("linked_list", "atomic_loop", "hybrid_transparency")
ROWS = ["unsorted", "weighted_average", "weighted_blended", "moments", "stochastic --stochastic-samples 8",
        "multi_layer", "adaptive", "atomic_loop", "hybrid_transparency", "bucket_peel", "linked_list --pixel-nodes 8",
        "front_to_back --max-passes 4 --tail average", "linked_list", "dual"]


def measured(options, name, words):
    folder = options.out / "".join(c if c.isalnum() else "-" for c in name)
    subprocess.run([str(options.strata), "cost", *map(str, words), "--size", SIZE, "--knob", "transparency", "--repeat", "1", "--clock", "processor",
                    "-o", str(folder)], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "results.csv", newline="") as file:
        return folder, {row["value"]: row for row in csv.DictReader(file) if row["knob"] == "transparency"}


def figure(text):
    return f"{float(text):.3g}" if text else "-"


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] + ["---:"] * (len(head) - 1), *rows]) + "\n"


def whole_table(found):
    rows = []
    for value in next(iter(found.values())):
        first = next(iter(found.values()))[value]
        rows.append([f"`{value}`", first["geometry_passes"], first["bytes_per_pixel"], *(figure(of[value]["rmse"]) for of in found.values())])
    return table(["algorithm and options", "passes", "bytes a pixel", *found], rows)


def short_table(found):
    names = [name for name in SHOWN if name in found]
    cost_of = found[names[0]]
    cheapest = min(float(row["modelled_seconds"]) for value, row in cost_of.items() if not value.startswith((*BUFFERED, "a_buffer", "painter")))
    rows = []
    for value in ROWS:
        first = cost_of[value]
        rows.append([f"`{value}`", *(figure(found[name][value]["rmse"]) for name in names), figure(first["bytes_per_pixel"]), first["geometry_passes"],
                     "-" if value.startswith(BUFFERED) else f"{float(first['modelled_seconds']) / cheapest:.2g}"])
    return table(["algorithm", *names, "bytes a pixel", "passes", "card's time"], rows)


def least(of, most_bytes, most_passes):
    """The algorithm of a device with the least error within these bounds; what needs lists of any length or a sorted scene is left out."""
    able = [row for row in of.values() if int(row["geometry_passes"]) <= most_passes and float(row["bytes_per_pixel"]) <= most_bytes
            and row["value"] not in ("a_buffer", "painter", "linked_list")]
    return min(able, key=lambda row: (float(row["rmse"]), float(row["bytes_per_pixel"])))


def advice(found):
    for name in NARROW:
        if name not in found:
            continue
        of = found[name]
        blended, best = least(of, 16, 1), least(of, 64, 2)
        yield f"| {name} | `{blended['value']}`: {figure(blended['rmse'])} | `{best['value']}`: {figure(best['rmse'])} |"


def page(found, pictures):
    plots = "\n\n".join(f"![Error over the modelled card's time: {name}]({file})" for name, file in pictures.items())
    return f"""# What accuracy costs with algorithms of few passes

How far from the exact picture is each algorithm, and what does it take? The emulation (on a CPU, `strata cost --knob transparency`) renders {len(found)}
scenes of {SIZE} pixels as a GeForce 8800 with 8-bit colours would, with the features that an algorithm needs beyond it. Figures are RMSE in
1/255 against a picture in which nothing is rounded or snapped; `linked_list`, which is exact, shows what rounding leaves.

{short_table(found)}
*Bytes a pixel*: targets and buffers beside the opaque scene's, on the first scene. *Card's time*: what the card's rates allow there, as a multiple of
the cheapest; traffic in buffers is not counted, so that lists have none.

The least error within one pass and 16 bytes a pixel, and within two passes and 64 bytes:

| scene | 1 pass, 16 bytes | 2 passes, 64 bytes |
|---|---|---|
{chr(10).join(advice(found))}

No weight is best in all scenes: it has to be tuned to the depths. A list cut at 8 nodes keeps the first 8 submitted, not the nearest.
`front_to_back` and `dual` lose fragments of equal depths (showroom, random).

{plots}

    tools/cost/transparency.py      # this page; all rows and scenes: build/transparency/TRANSPARENCY.md
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
    found, pictures = {}, {}
    for name, words in scenes.items():
        folder, found[name] = measured(options, name, words)
        if name in PLOTTED:
            pictures[name] = f"TRANSPARENCY.{name.split(',')[0]}.svg"
            shutil.copy(next(folder.glob("frontier.*.modelled.svg")), HERE / pictures[name])
    (options.out / "TRANSPARENCY.md").write_text(f"# All rows: RMSE in 1/255, {SIZE}\n\n{whole_table(found)}")
    (HERE / "TRANSPARENCY.md").write_text(page(found, pictures))


if __name__ == "__main__":
    main()
