#!/usr/bin/env python3
"""Tests tools/oracle/suite/page.py on rows written by hand. usage: suite_page_test.py REPOSITORY"""
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "lab"))
import page_checks  # noqa: E402

page_checks.subject("../oracle/suite")
import page  # noqa: E402

NAMES = ("min_for_max", "add_for_max", "depth_16")


def row(scene, *answers):
    return {"scene": scene, "why": f"why {scene}", "command": f"strata render {scene}",
            "mistakes": [{"name": name, "answer": answer, "picture": picture} for name, (answer, picture) in zip(NAMES, answers)]}


ROWS = [row("a.dual", ("named", 1), ("alike", 1), ("impossible", 0)), row("b.dual", ("hidden", 0), ("hidden", 0), ("named", 1)),
        row("c.dual", ("named", 1), ("alike", 1), ("wrong", 2))]


def checks(folder):
    table = page.Table(ROWS)
    first, second, third = page.findings(table).splitlines()
    yield "the named ones", first == ("Of 3 mistakes 2 are named first in at least one of 3 scenes; never named: add_for_max (its picture always equals "
                                      "min_for_max's).")
    yield "the wrong ones", second == "1 of 8 diagnoses name another mistake. Pairs of mistakes with equal pictures of all scenes: 1."
    yield "the best scene", third.startswith("The scene c.dual shows most of them, 3; 0 are visible in one scene only")
    text = page.pages.markdown_of(page.page_of(table, page.plot(table)), folder / "MISTAKES.md")
    yield "a plot", "](MISTAKES.scenes.svg)" in text and ">b.dual<" in (folder / "MISTAKES.scenes.svg").read_text()
    yield "few words", len(text.split()) <= 600
    whole = page.pages.markdown_of(page.whole_of(table, dict.fromkeys(NAMES, "a sentence")), folder / "WHOLE.md")
    signs = page_checks.rows_of_table(whole)
    yield "the signs", signs == [["mistake", "1", "2", "3"], ["min_for_max", "1", ".", "1"], ["add_for_max", "=", ".", "="], ["depth_16", "", "1", "!"]]
    yield "the scenes", page_checks.rows_of_table(whole, "| scene |")[1] == ["1 a.dual", "why a.dual", "`strata render a.dual`"]
    yield "the equal ones", "min_for_max and add_for_max have equal pictures of all scenes; " in whole
    yield "where each is named", [cells[2] for cells in page_checks.rows_of_table(whole, "| mistake | a picture")[1:]] == [
        "a.dual (2 in all)", "named as min_for_max, its equal", "b.dual (1 in all)"]


with tempfile.TemporaryDirectory() as path:
    page_checks.end(checks(pathlib.Path(path)), 9)
