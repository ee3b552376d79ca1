#!/usr/bin/env python3
"""Writes the whole page of the hard cases: a section for each case, with its exact picture.

usage: whole_page.py FOLDER [--strata build/release/strata] -o PAGE.html

FOLDER is what `strata hard-cases` wrote. Pictures are the A-buffer's on the profile ideal; a case that even this refuses has none.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
from collections import Counter

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import pages  # noqa: E402

VERDICTS = ("stable", "degrades gracefully", "breaks as the hardware did", "failed", "refused")
LARGE = 1 << 20  # pixels; of a larger frame the page has no picture
MOVED = "depth_units"  # runs on every device


def of_case(lines):
    cases = {}
    for line in lines:
        cases.setdefault(line["case"], []).append(line)
    return cases


def counts(lines):
    found = Counter(line["verdict"] for line in lines)
    return [str(found[verdict]) for verdict in VERDICTS]


def examples(lines):
    """The first combination of each kind of fault, with its reasons."""
    for verdict in ("failed", "breaks as the hardware did", "degrades gracefully"):
        first = next((line for line in lines if line["verdict"] == verdict), None)
        if first:
            yield f"{verdict}, for instance `{first['algorithm']}` on {first['profile']} at {first['depth']}: {'; '.join(first['reasons'])}."


def changed(figures):
    return figures["gained"] + figures["lost"] + figures["reordered"]


def amplification(ours, exact):
    return f"{ours / exact:.2f}" if exact else "-" if ours else "1"


def moved_rows(lines):
    """The changes by all moves of one unit in the last place, and the flips along the camera path."""
    for line in lines:
        if line["algorithm"] == MOVED and line["stability"]:
            unit, flicker = line["stability"]["unit"], line["flicker"]
            ours, exact = changed(unit["ours"]), changed(unit["exact"])
            yield [line["profile"], line["depth"], str(ours), str(exact), amplification(ours, exact), f"{unit['amplification']['depth'] or 0:.3g}",
                   *(str(changed(unit[key])) for key in ("within_move", "within_device", "beyond")), str(flicker["order"]), str(flicker["coverage"]),
                   line["stability"]["verdict"]]


MOVED_HEAD = ["profile", "depth", "changes", "exact", "amplification", "of depth", "within the move", "within the device", "beyond", "flips in order",
              "in coverage", "verdict"]


def paths_table(lines):
    """The flips in order by depth path."""
    measured = [line for line in lines if line["flicker"] and line["flicker"]["paths"]]
    if not measured:
        return []
    names = list(measured[0]["flicker"]["paths"])
    rows = [[line["profile"], line["depth"], *("" if flicker is None else str(flicker["order"]) for flicker in line["flicker"]["paths"].values())]
            for line in measured]
    return [("text", "Flips in order by depth path (`front_to_back`):"), ("table", ["profile", "depth", *names], rows, range(2, 2 + len(names)))]


def picture_of(case, strata, folder):
    """The exact picture, or None."""
    (near, far), (width, height) = case["depth_range"], (case["width"], case["height"])
    if near > far or width * height > LARGE:
        return None
    path = pathlib.Path(folder) / f"{case['name']}.png"
    subprocess.run([strata, "render", f"hard:case={case['name']}", "--size", f"{width}x{height}", "--depth-range", f"{near},{far}", "--profile", "ideal",
                    "--algorithm", "a_buffer", "--no-audit", "-q", "-o", str(path)], check=True, stdout=subprocess.DEVNULL)
    return path


def section(case, lines, picture):
    yield ("heading", case["name"])
    if picture:
        yield ("picture", picture, f"The exact picture of {case['name']}")
    yield ("text", f"{case['hard']} Right answer: {case['answer']} Exact geometry has {case['fragments']} visible fragments, {case['deepest']} at the deepest pixel, "
                   f"{case['layers']} layers, and ties at {case['tied_pixels']} pixels of {case['width']} x {case['height']}.")
    rows = [[profile, *counts([line for line in lines if line["profile"] == profile])] for profile in dict.fromkeys(line["profile"] for line in lines)]
    yield ("table", ["profile", *VERDICTS], rows, range(1, 1 + len(VERDICTS)))
    told = list(examples(lines))
    if told:
        yield ("list", told)
    moved = list(moved_rows(lines))
    if moved:
        yield ("text", f"Moved by one unit in the last place, and along the camera path (`{MOVED}`; the verdict is that of both sizes of moves):")
        yield ("table", MOVED_HEAD, moved, range(2, len(MOVED_HEAD) - 1))
    yield from paths_table(lines)


def page_of(lines, cases, picture):
    """`cases`: what is known of each case, by name; `picture` gives the path of a case's picture, or None."""
    yield ("title", "Hard cases")
    of = {key: len({line[key] for line in lines}) for key in ("case", "algorithm", "profile", "depth")}
    yield ("text", "Scenes: {case}; algorithms: {algorithm}; devices: {profile}; depth formats: {depth}.".format(**of))
    yield ("table", list(VERDICTS), [counts(lines)], range(len(VERDICTS)))
    for name, own in of_case(lines).items():
        yield from section(cases[name], own, picture(cases[name]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--strata", default=str(pages.ROOT / "build/release/strata"))
    parser.add_argument("-o", dest="page", required=True)
    options = parser.parse_args()
    listed = subprocess.run([options.strata, "hard-cases", "--list", "--json"], check=True, capture_output=True, text=True).stdout
    cases = {case["name"]: case for case in json.loads(listed)}
    with tempfile.TemporaryDirectory() as folder:
        pages.write(list(page_of(pages.lines_in(options.folder / "results.jsonl"), cases, lambda case: picture_of(case, options.strata, folder))), options.page)


if __name__ == "__main__":
    main()
