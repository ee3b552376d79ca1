#!/usr/bin/env python3
"""Makes plots and a page from the results of `strata invariance`.

    tools/invariance/report.py FOLDER...                     # index.html in the first folder, with everything inside
    tools/invariance/report.py FOLDER... --markdown PAGE.md  # PAGE.md, and its plots as PAGE.NAME.svg in its folder
    tools/invariance/report.py FOLDER... --short PAGE.md     # the same, with at most 600 words and one plot
    tools/invariance/report.py FOLDER... --formats FOLDER    # with the section on depth formats

Needs only the standard library and gnuplot. The page depends on results.jsonl, and on timings.jsonl for ratios of times.
"""
import argparse
import base64
import html
import json
import pathlib
import sys

sys.dont_write_bytecode = True
import formats  # noqa: E402
import sections  # noqa: E402


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=pathlib.Path, nargs="+", help="what `strata invariance -o` wrote; a page goes to the first")
    parser.add_argument("--formats", type=pathlib.Path, help="the folder of a sweep of formats.json, which becomes a section")
    parser.add_argument("--markdown", type=pathlib.Path, help="a page to keep instead of FOLDER/index.html")
    parser.add_argument("--short", type=pathlib.Path, help="a short page to keep: the answer, its table and its plot")
    parser.add_argument("--title", default="Invariance")
    return parser.parse_args()


def load(path):
    if not path.exists():
        sys.exit(f"report.py: {path}: expected results, found no such file")
    return [json.loads(line) for line in path.read_text().splitlines()]


def results(folder):
    """The rows with additional values for the page: seconds of the peel, and the path of the cell's pictures."""
    timings = folder / "timings.jsonl"
    seconds = {line["cell"]: line["peel_seconds"] for line in load(timings)} if timings.exists() else {}
    rows = load(folder / "results.jsonl")
    for row in rows:
        row["seconds"] = seconds.get(row["cell"])
        row["pictures"] = folder / "images" / f"{row['cell']:04}"
    return rows


def markdown_of(blocks, page):
    """A block is (kind, ...): title, heading, text, list, table, plot, picture. Pictures are omitted on pages in the repository."""
    lines = []
    for kind, *content in blocks:
        if kind == "title":
            lines += [f"# {content[0]}", ""]
        elif kind == "heading":
            lines += [f"## {content[0]}", ""]
        elif kind == "text":
            lines += [content[0], ""]
        elif kind == "list":
            lines += [f"- {item}" for item in content[0]] + [""]
        elif kind == "table":
            header, rows = content
            lines += ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
            lines += ["| " + " | ".join(row) + " |" for row in rows] + [""]
        elif kind == "plot":
            name, caption, svg = content
            file = page.with_suffix(f".{name}.svg")
            file.write_text(svg)
            lines += [f"![{caption}]({file.name})", ""]
    return "\n".join(lines).rstrip() + "\n"


PAGE = pathlib.Path(__file__).resolve().parents[1] / "strata" / "report" / "page"  # the style of every page of strata


def inline(text):
    """Converts Markdown's `code` to HTML; the rest is text."""
    parts = html.escape(text).split("`")
    return "".join(f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(parts))


def table_of(header, rows):
    head = "".join(f'<th scope="col">{inline(cell)}</th>' for cell in header)
    body = "\n".join("<tr>" + "".join(f"<td>{inline(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return (f'<div class="scroll" tabindex="0" role="region" aria-label="{html.escape(", ".join(header), quote=True)}"><table class="sorts">'
            f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>")


# gnuplot draws in black and dark colours: on a dark page they are inverted, each with its own hue.
DARK = "@media (prefers-color-scheme: dark) { figure.wide svg { filter: invert(1) hue-rotate(180deg); } }\n"


def element_of(svg):
    """gnuplot's SVG as an element of a page, with a transparent background."""
    return svg[svg.index("<svg"):].replace('fill="#ffffff"', 'fill="none"')


def html_of(blocks):
    title, body, is_first = html.escape(blocks[0][1]), [], True
    for kind, *content in blocks:
        if kind == "heading":
            body.append(f"<h2>{inline(content[0])}</h2>")
        elif kind == "text":
            body.append(f'<p class="lead">{inline(content[0])}</p>' if is_first else f"<p>{inline(content[0])}</p>")
            is_first = False
        elif kind == "list":
            body.append("<ul>" + "".join(f"<li>{inline(item)}</li>" for item in content[0]) + "</ul>")
        elif kind == "table":
            body.append(table_of(*content))
        elif kind == "plot":
            _, caption, svg = content
            body.append(f'<figure class="wide" tabindex="0">{element_of(svg)}<figcaption>{inline(caption)}</figcaption></figure>')
        elif kind == "picture":
            path, caption = content
            data = base64.b64encode(path.read_bytes()).decode()
            words = html.escape(caption, quote=True)
            body.append(f'<figure><img alt="{words}" src="data:image/png;base64,{data}"><figcaption>{inline(caption)}</figcaption></figure>')
    style, script = ((PAGE / name).read_text() for name in ("style.css", "plain.js"))
    return ('<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{title}</title>\n<style>\n{style}{DARK}</style>\n</head>\n<body>\n<header><h1>{title}</h1></header>\n<main>\n" + "\n".join(body)
            + f"\n</main>\n<script>\n{script}</script>\n</body>\n</html>\n")


HOW = [("heading", "The whole table"), ("text", "    tools/invariance/make_page.sh FOLDER_OF_DRAGON_GLB"),
       ("text", "In a few minutes the command writes this page and `build/invariance/RESULTS.md` with every cell: the safe bias "
                "of every choice, every remedy, different vertex transforms and splits of surfaces, and the effect of each assumption about the chip. "
                "[audit.md](../../peeling/reference/audit.md) defines the figures.")]


def main():
    arguments = parse_arguments()
    rows = [row for folder in arguments.folders for row in results(folder)]
    study = results(arguments.formats) if arguments.formats else []
    if arguments.short:
        blocks = sections.short_page(arguments.title, rows, formats.short_section(study))
        arguments.short.write_text(markdown_of([*blocks, *HOW], arguments.short))
        return
    blocks = sections.page(arguments.title, rows, formats.section(study))
    if arguments.markdown:
        arguments.markdown.write_text(markdown_of(blocks, arguments.markdown))
    else:
        (arguments.folders[0] / "index.html").write_text(html_of(blocks))


if __name__ == "__main__":
    main()
