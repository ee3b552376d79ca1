#!/usr/bin/env python3
"""Tests tools/lab/hardware_check/page.py on rows written by hand. usage: page_test.py REPOSITORY"""
import json
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import page_checks  # noqa: E402

page_checks.subject("hardware_check")
import page  # noqa: E402


def picture(suite, name, outcome, differing=0, largest=0, detail=""):
    return {"suite": suite, "picture": name, "outcome": outcome, "detail": detail, "difference": f"{name}.png" if differing else None,
            "compared": 0 if outcome == "not modelled" else 1000, "differing": differing, "largest": largest}


PICTURES = [picture("Clear", "a", "equal"), picture("Clear", "b", "equal"), picture("Depth", "c", "outside", 7, 3, "first at 1,2"),
            picture("Depth", "d", "within bound", 2, 1), picture("Fog", "e", "not modelled", detail="fog"), picture("Fog", "f", "unknown")]


def checks(folder):
    (folder / "results.json").write_text(json.dumps({"profile": "geforce3", "pictures": PICTURES}))
    short = page.pages.markdown_of(list(page.short_page(PICTURES)), folder / "RESULTS.md")
    yield "the counts", "Of 4 captures 2 are equal in every bit, 1 are within the bound of their suite, and 1 are outside. 0 show features" in short
    yield "the pixels", "Of 4,000 compared pixels 9 differ. 1 further suites, with 2 captures, show no modelled feature." in short
    table = page_checks.rows_of_table(short)
    yield "a suite that differs has a row", table[1] == ["Depth", "2", "0", "1", "1", "0", "2,000", "9", "3"]
    yield "all others have one", table[2] == ["1 other suites", "2", "2", "0", "0", "0", "2,000", "0", "0"]
    yield "a plot", "](RESULTS.suites.svg)" in short and ">Depth<" in (folder / "RESULTS.suites.svg").read_text()
    yield "few words", len(short.split()) <= 600
    for name in "cd":
        (folder / f"{name}.png").write_bytes(b"\x89PNG")
    html = page.pages.html_of(list(page.whole_page(PICTURES, folder, None)))
    yield "every difference has its picture", html.count("<img") == 2
    yield "with its reason", "Depth/c: outside, 7 of 1000 pixels differ, by at most 3; first at 1,2" in html
    yield "what is not modelled is listed", "<li>Fog/e: fog</li>" in html


with tempfile.TemporaryDirectory() as path:
    page_checks.end(checks(pathlib.Path(path)), 9)
