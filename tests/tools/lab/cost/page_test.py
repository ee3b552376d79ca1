#!/usr/bin/env python3
"""Tests the pages of tools/lab/cost on rows written by hand. usage: page_test.py REPOSITORY"""
import json
import pathlib
import random
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import page_checks  # noqa: E402

page_checks.subject("cost")
import page  # noqa: E402
import plots  # noqa: E402
import ranking  # noqa: E402
import rows  # noqa: E402

FIGURES = []
draw = plots.svg_of
plots.svg_of = lambda figure: FIGURES.append(figure) or draw(figure)


def write(folder, choices):
    """`choices`: knob, value, sorted error, exact error, median time (None: none)."""
    folder.mkdir()
    lines, timings = [], []
    for cell, (knob, value, from_sorted, exact, time) in enumerate(choices):
        lines.append({"cell": cell, "scene": "made-up", "knob": knob, "value": value, "opened": "", "outcome": "refused" if exact is None else "done",
                      "sorted_rmse": from_sorted, "rmse": exact, "modelled_seconds": None if time is None else 2 * time})
        spread = None if time is None else {"median": time, "least": 0.9 * time, "greatest": 1.1 * time, "rounds": 5}
        timings.append({"cell": cell, "default": spread, "literal": spread})
    for name, content in (("results", lines), ("timings", timings)):
        (folder / f"{name}.jsonl").write_text("".join(json.dumps(line) + "\n" for line in content))
    return folder


CHOICES = [("default", "front_to_back", 0.5, 0.75, 1.0), ("algorithm", "dual rgba8", 0.5, 0.75, 0.5), ("algorithm", "a_buffer rgba8", 0, 0.25, 2.0),
           ("algorithm", "unsorted rgba8", 9, 9.5, 0.25), ("algorithm", "k_buffer rgba8", None, None, None), ("chain", "device", None, 0.75, None),
           ("chain", "snap", None, 0.5, None), ("chain", "blend", None, 0.25, None), ("chain", "store", None, 0.0, None), ("alone", "snap", None, 0.6, None)]


def is_beaten(points, i):
    """By the definition: another point takes no more time, has no more error and is better in one of them, or is equal and earlier."""
    time, error = points[i]
    return any(t <= time and e <= error and (t < time or e < error or k < i) for k, (t, e) in enumerate(points) if k != i)


def check_frontier():
    numbers = random.Random(3)
    wrong = 0
    for _ in range(200):
        points = [(numbers.randint(1, 8), numbers.randint(0, 8)) for _ in range(numbers.randint(1, 20))]
        found = rows.frontier_of(points)
        wrong += found != sorted((i for i in range(len(points)) if not is_beaten(points, i)), key=lambda i: points[i][0])
    yield "the frontier has the points that no other beats, cheapest first", wrong == 0


def check_short(folder):
    measured = rows.rows_of(write(folder / "short", CHOICES))
    text = page.pages.markdown_of(list(page.short_page([measured], None)), folder / "RESULTS.md")
    yield "the best algorithm and its price", ("takes 8.00 times as long as the fastest on made-up (`a_buffer rgba8`, error 0.25; `unsorted rgba8`, 9.5)"
                                               in text)
    yield "the range of errors and times", "| algorithm, by colour format | 0 to 9 | 0.25 to 9.5 | 0.25 to 2 |" in text
    yield "the error by exact steps", "0.75 on made-up, 0.5 with exact corners, 0.25 with exact blending as well, 0 stored exactly" in text
    yield "its plot stands beside it", "](RESULTS.ranking.made-up.svg)" in text and (folder / "RESULTS.ranking.made-up.svg").exists()
    yield "few words", len(text.split()) <= 600


def check_whole(folder):
    measured = rows.rows_of(write(folder / "whole", CHOICES))
    blocks = list(page.whole_page([measured]))
    text = page.pages.markdown_of(blocks, folder / "WHOLE.md")
    table = page_checks.rows_of_table(text, "## made-up")
    yield "the ranking, then the rest", [row[2] for row in table[1:7]] == ["a_buffer rgba8", "dual rgba8", "front_to_back", "unsorted rgba8", "k_buffer rgba8", "device"]
    yield "ranks", [row[0] for row in table[1:7]] == ["1", "2", "3", "4", "-", "-"]
    yield "a row", table[1] == ["1", "algorithm", "a_buffer rgba8", "0", "0.25", "2 (1.8 to 2.2)", "2 (1.8 to 2.2)", "2"]
    yield "a refused row", table[5][3:] == ["-", "refused", "-", "-", "-"]
    chain = page_checks.rows_of_table(text, "Where the error")
    yield "the chain", chain[2] == ["snap", "0.5", "0.6"]
    html = page.pages.html_of(blocks)
    yield "one file, in light and dark, for phones", "prefers-color-scheme: dark" in html and "width=device-width" in html and 'src="' not in html


def check_plot(folder):
    """170 choices: each has its name, and no label overlaps another."""
    many = [("default", "front_to_back", 0.5, 0.75, 1.0)] + [("depth", f"d{i} a_rather_long_name_of_a_path", 0.01 * i, 0.02 * i, 1 + 0.01 * i) for i in range(170)]
    measured = rows.rows_of(write(folder / "plot", many))
    FIGURES.clear()
    svg = ranking.ranking_plot(rows.ranked(measured), "made-up", lambda row: row["default"]["median"], "time / default")
    figure = FIGURES[0]
    errors = figure.axes[0]
    labels = errors.get_yticklabels()
    yield "every choice has its name in the picture", all(f">{rows.name_of(row)}<" in svg for row in measured)
    yield "best at the top", labels[0].get_text() == "depth d0 a_rather_long_name_of_a_path" and errors.yaxis_inverted()
    yield "no name overlaps another", page_checks.overlaps(figure, [*labels, *errors.get_legend().get_texts(), *figure.axes[1].get_legend().get_texts()]) == []
    bold = [label.get_text() for label in labels if label.get_fontweight() == "bold"]
    yield "the names of the frontier are bold", bold == ["depth d0 a_rather_long_name_of_a_path"]
    yield "the same data give the same bytes", svg == ranking.ranking_plot(rows.ranked(measured), "made-up", lambda row: row["default"]["median"], "time / default")


with tempfile.TemporaryDirectory() as path:
    place = pathlib.Path(path)
    page_checks.end([*check_frontier(), *check_short(place), *check_whole(place), *check_plot(place)], 16)
