#!/usr/bin/env python3
"""Tests the page that tools/lab/invariance/report.py writes for invented rows of a sweep. usage: page_test.py REPOSITORY

The rows are written by hand, so their safe intervals and counts are known. Plots are not written: the test checks their axes.
"""
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import page_checks  # noqa: E402

page_checks.subject("invariance")
import pages  # noqa: E402
import plots  # noqa: E402
import report  # noqa: E402
import sections  # noqa: E402

FIGURES = []
plots.svg_of = lambda figure: FIGURES.append(figure) or "<svg></svg>"
SAFE = {"safe": True, "lowest": 3, "highest": 30}
NONE = {"safe": False, "lowest": 9, "highest": 4,
        **{key: {"x": 1, "y": 2, "primitive": 3, "stored": "0x1", "reference": "0x2"} for key in ("repeated_below", "lost_above")}}


def row(cell, **changed):
    made = {"cell": cell, "scene": "teapot", "width": 64, "height": 48, "profile": "geforce3", "algorithm": "shadow_map", "orbit": [30.0, 20.0],
            "camera": None, "alpha": 0.5, "write_path": "window_z", "compare_path": "perspective_rq", "depth_format": "d24", "subpixel_bits": 4,
            "near": 1.0, "far": 100.0, "remedy": "none", "bias_constant": 0.0, "vertex_path": "separate", "split": "none", "hypothesis": "profile",
            "max_passes": 0, "outcome": "never_ends", "refusal": "", "fragments": 100, "differing": 50, "unmatched": 0, "ulp_max": 3,
            "ulp_max_at": {"x": 1, "y": 2}, "histogram": [[0, 0, 50], [1, 1, 50]], "passes": 14, "layers_true": 6, "layers": 100, "duplicated": 8,
            "lost": 9, "pixels_touched": 7, "max_difference": 1.0, "rmse": 0.5, "psnr": 40.0, "safe_epsilon_ulps": None, "safe_epsilon": None,
            "safe_bias": SAFE, "seconds": None, "pictures": pathlib.Path("none")}
    return {**made, **changed}


def replaced(cell):
    return row(cell, write_path="depth_replace", differing=0, duplicated=0, lost=0, outcome="done", safe_bias=None)


def text_of(rows):
    return pages.markdown_of(sections.page("A title", rows), pathlib.Path(FOLDER) / "page")


def check_headline():
    """With two depth ranges, one of which has no safe bias, the headline says one of two."""
    page = text_of([row(0), row(1, near=0.1, safe_bias=NONE), replaced(2)])
    yield "the head counts depth ranges", "A constant bias peels 1 of 2 choices of scene, format and depth range without error" in page
    yield "the safe one is named with its range", "teapot on geforce3, `d24`, far/near 100: 3 to 30 codes" in page
    yield "the other is listed", "teapot on geforce3, `d24`, far/near 1000: no constant bias peels without error." in page


def check_rows():
    """In a sweep over each knob no two rows of a table are equal."""
    for name, values in {"size": [{"width": 64}, {"width": 65}], "profile": [{"profile": "a"}, {"profile": "b"}],
                         "bits": [{"subpixel_bits": 4}, {"subpixel_bits": 8}], "near": [{"near": 1.0}, {"near": 2.0}],
                         "alpha": [{"alpha": 0.5}, {"alpha": 0.25}], "camera": [{"camera": "a.json"}, {"camera": "b.json"}],
                         "orbit": [{"orbit": [30.0, 20.0]}, {"orbit": [31.0, 20.0]}], "passes": [{"max_passes": 0}, {"max_passes": 9}]}.items():
        page = text_of([row(i, **value) for i, value in enumerate(values)] + [replaced(2)])
        for heading in ("How often the two depths differ", "Signed: positive"):
            table = [tuple(cells) for cells in page_checks.rows_of_table(page, heading)]
            yield f"rows of a sweep over {name} differ below '{heading}'", heading.startswith("Signed") and name == "near" or len(set(table)) == len(table) == 3
        listed = [line for line in page.splitlines() if line.startswith("- teapot on") or line.startswith("- b on") or line.startswith("- a on")]
        yield f"lines of a sweep over {name} differ", len(set(listed)) == len(listed) == 2


def check_band():
    """The band of the plot ends at the value in the text, beyond the largest tested bias."""
    FIGURES.clear()
    biases = [row(i, remedy="none" if bias == 0 else f"bias:{bias}", bias_constant=float(bias)) for i, bias in enumerate([0, 1, 4, 16])]
    page = text_of(biases)
    axes = next(figure.axes[0] for figure in FIGURES if figure.axes[0].patches)
    band = axes.patches[0].get_xy()
    yield "the band goes from 3 to 30", {x for x, _ in band} == {3, 30}
    yield "the axis goes as far", axes.get_xlim() == (0, 30) and "30" in [label.get_text() for label in axes.get_xticklabels()]
    yield "the caption names it", "green: safe, 3 to 30 codes" in page


def check_short():
    """The short page has the counts of these rows, the remedies tried on a peel that needs one, and few words."""
    biases = [row(i, remedy="none" if bias == 0 else f"bias:{bias}", bias_constant=float(bias), duplicated=0 if bias == 4 else 8, lost=0 if bias == 4 else 9)
              for i, bias in enumerate([0, 1, 4, 16])]
    many = [row(9 + i, near=0.5 / (i + 1), differing=i) for i in range(300)]
    page = pages.markdown_of(sections.short_page("A title", biases + [replaced(4)] + many, []) + report.HOW, pathlib.Path(FOLDER) / "page")
    yield "a bias was tried three times, and once with every layer", "| a constant bias | 3 | 1 |" in page
    yield "without a remedy no layer comes once", "| nothing | 301 | 0 |" in page
    yield "a pair of paths has one row, from its least share to its greatest", "| geforce3 | `window_z` | `perspective_rq` | d24 | 0.0 % to 299.0 % | 3 |" in page
    yield "a row per depth range is left to the whole page", len(page.split()) <= 600
    yield "it names the command of the whole page", "tools/lab/invariance/make_page.sh" in page


def check_html():
    """The page has the style of strata's pages: light and dark, and a layout for phones."""
    page = pages.html_of(sections.page("A <title>", [row(0), replaced(1)]))
    yield "it has a dark mode", "prefers-color-scheme: dark" in page
    yield "it fits a phone", "width=device-width" in page
    yield "its title is text", "<h1>A &lt;title&gt;</h1>" in page
    yield "it begins with a sentence", page.index('class="lead"') < page.index("<figure" if "<figure" in page else "<table")
    yield "plots are elements of the page", "<svg></svg><figcaption>" in pages.html_of(sections.page("t", [row(0), row(1, near=0.1), replaced(2)]))
    yield "plots are turned light on a dark page", "filter: invert(1)" in page
    yield "tables scroll alone", page.count("<table") == page.count('class="scroll"')


with tempfile.TemporaryDirectory() as FOLDER:
    checks = [check for made in (check_headline, check_rows, check_band, check_short, check_html) for check in made()]
page_checks.end(checks, 30)
