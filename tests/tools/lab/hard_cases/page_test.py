#!/usr/bin/env python3
"""Tests the pages of tools/lab/hard_cases on rows written by hand; the figures are counted by hand. usage: page_test.py REPOSITORY"""
import json
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import page_checks  # noqa: E402

page_checks.subject("hard_cases")
import page  # noqa: E402
import whole_page  # noqa: E402

CASE = {"name": "planes", "hard": "Planes are near.", "answer": "All are separate.", "fragments": 3072, "deepest": 3, "layers": 1, "tied_pixels": 1024,
        "width": 32, "height": 16, "depth_range": [0, 1]}


def changes(gained=0, lost=0, reordered=0):
    return {"gained": gained, "lost": lost, "reordered": reordered}


def line(profile, algorithm, verdict, reasons=(), moved=None, **more):
    stability = flicker = None
    if moved:
        device, depth, order = moved
        unit = {"exact": changes(4, 4), "ours": changes(3, device, 2), "within_move": changes(3), "within_device": changes(0, device), "beyond": changes(0, 0, 2),
                "amplification": {"depth": depth}}
        stability = {"verdict": "stable", "unit": unit}
        flicker = {"order": order, "coverage": 5, "paths": {"window_z": {"order": 7}, "exact": None}}
    return {"case": "planes", "profile": profile, "depth": "d24", "algorithm": algorithm, "outcome": "refused" if verdict == "refused" else "done",
            "verdict": verdict, "reasons": list(reasons), "stability": stability, "flicker": flicker, "nan_values": 0, "difference": 0,
            "difference_at_ties": 0, "bound": 1, "unlike": [], "fragments": {"wrong_pixels": 0}, **more}


LINES = [line("geforce3", "depth_units", "stable", moved=(77, 12, 40)),
         line("geforce3", "dual", "breaks as the hardware did", ["2048 fragments lost", "at 1024 pixels"]),
         line("geforce3", "k_buffer", "refused"), line("ideal", "dual", "degrades gracefully", ["rounding"], difference=3)]


def check_whole():
    blocks = list(whole_page.page_of(LINES, {"planes": CASE}, lambda case: None))
    text = whole_page.pages.markdown_of(blocks, pathlib.Path("page"))
    yield "all verdicts", page_checks.rows_of_table(text)[1] == ["1", "1", "1", "0", "1"]
    by_device = page_checks.rows_of_table(text, "## planes")
    yield "by device", by_device[1:] == [["geforce3", "1", "0", "1", "0", "1"], ["ideal", "0", "1", "0", "0", "0"]]
    yield "an example of each fault", "- breaks as the hardware did, for instance `dual` on geforce3 at d24: 2048 fragments lost; at 1024 pixels." in text
    yield "the right answer", "Exact geometry has 3072 visible fragments, 3 at the deepest pixel, 1 layers, and ties at 1024 pixels of 32 x 16." in text
    # 3 + 77 + 2 changes against 8 of the exact answer
    moved = page_checks.rows_of_table(text, "Moved by one unit")
    yield "moved geometry", moved[1] == ["geforce3", "d24", "82", "8", "10.25", "12", "3", "77", "2", "40", "5", "stable"]
    yield "flips by depth path", page_checks.rows_of_table(text, "Flips in order by depth path")[1] == ["geforce3", "d24", "7", ""]
    still = whole_page.pages.markdown_of(list(whole_page.page_of(LINES[1:], {"planes": CASE}, lambda case: None)), pathlib.Path("page"))
    yield "cases that are not moved have no such table", "Moved" not in still
    yield "no picture of a reversed range", whole_page.picture_of({**CASE, "depth_range": [1, 0]}, "no program", "") is None
    yield "none of a large frame", whole_page.picture_of({**CASE, "width": 8192, "height": 8192}, "no program", "") is None


def check_short(folder):
    (folder / "timings.jsonl").write_text("".join(json.dumps({"cell": i, "seconds": 90}) + "\n" for i in range(4)))
    text = page.page_of(folder, LINES, "map.svg")
    yield "cells and refusals", "3 cells; 1 further cells are refused" in text
    yield "minutes", "The command takes 6 minutes on one processor" in text
    yield "the algorithms that break", "never break: `depth_units`. Those that break most often: `dual` (50 % of its cells)" in text
    yield "errors beyond the bound", "1 of 3 cells exceed it: 0 break with a diagnostic, 1 degrade" in text
    yield "few words", len(text.split()) <= 600


with tempfile.TemporaryDirectory() as path:
    page_checks.end([*check_whole(), *check_short(pathlib.Path(path))], 14)
