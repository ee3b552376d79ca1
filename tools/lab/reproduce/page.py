#!/usr/bin/env python3
"""Makes index.html and its charts in the folder that `strata reproduce` wrote: page.py FOLDER. Needs matplotlib."""
import html
import json
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import pages  # noqa: E402
import plots  # noqa: E402


def chart_of(chart):
    """A plot over two logarithmic axes, x in powers of 2."""
    figure, (axes,) = plots.axes_of(5, 4, "", chart["x_label"], chart["y_label"])
    plots.draw_series(axes, {curve["name"]: curve["points"] for curve in chart["curves"]})
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    return ("plot", chart["name"], chart["y_label"], plots.svg_of(figure))


def blocks_of(page, folder):
    yield ("title", page["title"])
    yield ("text", page["lead"])
    yield ("text", f"The paper: {page['link']}")
    for section in page["sections"]:
        yield ("heading", section["title"])
        yield ("text", section["text"])
        if section["table"]:
            records = pages.records_in(folder / section["table"])
            yield ("table", list(records[0]), [list(record.values()) for record in records])
            yield ("text", f"As a file: `{section['table']}`")
        yield from map(chart_of, section["charts"])
        for picture in section["pictures"]:
            yield ("picture", folder / picture["file"], picture["caption"])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    page = json.loads((folder / "page.json").read_text(encoding="utf-8"))
    text = pages.html_of(list(blocks_of(page, folder)))
    link = html.escape(page["link"])
    (folder / "index.html").write_text(text.replace(f"The paper: {link}", f'<a href="{link}">The paper</a>'), encoding="utf-8")


if __name__ == "__main__":
    main()
