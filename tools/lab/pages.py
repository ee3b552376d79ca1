"""Rows that a command wrote, and pages of them: Markdown for the repository, HTML for a browser.

A page is a list of blocks: ("title", text), ("heading", text), ("text", text), ("list", texts), ("table", header, rows), ("plot", name, caption, svg),
("picture", path, caption). Texts are Markdown with `code`.
"""
import base64
import csv
import html
import json
import math
import pathlib
import re
import struct
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
STYLE = ROOT / "tools" / "strata" / "report" / "page"  # the style of every page of strata


def lines_in(path):
    """The objects of a file of JSON lines."""
    path = pathlib.Path(path)
    if not path.exists():
        sys.exit(f"{path}: expected rows that a command of strata wrote, found no such file")
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def records_in(path):
    """The rows of a CSV file, by the titles of its columns."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def table(header, rows, right=()):
    """A table in Markdown; `right` are the numbers of the columns that are aligned right."""
    rule = "".join("|---:" if i in right else "|---" for i in range(len(header)))
    return "\n".join("| " + " | ".join(row) + " |" if row else rule + "|" for row in [header, None, *rows])


def markdown_of(blocks, page):
    """The text of the page. Plots are written beside it as STEM.NAME.svg; pictures are left out of pages in the repository."""
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
            lines += [table(*content), ""]
        elif kind == "plot":
            name, caption, svg = content
            file = page.with_suffix(f".{name}.svg")
            file.write_text(svg, encoding="utf-8")
            lines += [f"![{caption}]({file.name})", ""]
    return "\n".join(lines).rstrip() + "\n"


def inline(text):
    """Markdown's `code` and *emphasis* as HTML; of a link into the repository, which a page by itself has not, its words."""
    parts = html.escape(text).split("`")
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"\[([^\]]*)\]\((?!http)[^)]*\)", r"\1", parts[i])
        parts[i] = re.sub(r"(?<![\w*])\*([\w][^*]*)\*", r"<em>\1</em>", parts[i])
    return "".join(f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(parts))


def html_table(header, rows, right=()):
    head = "".join(f'<th scope="col">{inline(cell)}</th>' for cell in header)
    body = "\n".join("<tr>" + "".join(f'<td class="number">{inline(cell)}</td>' if i in right else f"<td>{inline(cell)}</td>"
                                       for i, cell in enumerate(row)) + "</tr>" for row in rows)
    return (f'<div class="scroll" tabindex="0" role="region" aria-label="{html.escape(", ".join(header), quote=True)}"><table class="sorts">'
            f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>")


LEAST_WIDTH = 256  # a smaller picture is enlarged, a pixel to a square


def html_picture(path, caption):
    content = pathlib.Path(path).read_bytes()
    width = struct.unpack(">I", content[16:20])[0] if content[:4] == b"\x89PNG" and len(content) > 20 else LEAST_WIDTH
    enlarged = f' style="width:{width * math.ceil(LEAST_WIDTH / width)}px;image-rendering:pixelated"' if 0 < width < LEAST_WIDTH else ""
    data, kind = base64.b64encode(content).decode(), {".svg": "svg+xml"}.get(pathlib.Path(path).suffix, "png")
    return (f'<figure><img alt="{html.escape(caption, quote=True)}" src="data:image/{kind};base64,{data}"{enlarged}>'
            f"<figcaption>{inline(caption)}</figcaption></figure>")


# Plots are black and coloured on white: on a dark page they are inverted, each colour with its own hue.
DARK = "@media (prefers-color-scheme: dark) { figure.wide svg { filter: invert(1) hue-rotate(180deg); } }\n"


def html_of(blocks):
    """The page as one file, with the style and the script of strata's reports."""
    title, body, is_first = html.escape(blocks[0][1]), [], True
    most_of_a_lead = 400  # characters
    for kind, *content in blocks:
        if kind == "heading":
            body.append(f"<h2>{inline(content[0])}</h2>")
        elif kind == "text":
            body.append(f'<p class="lead">{inline(content[0])}</p>' if is_first and len(content[0]) <= most_of_a_lead else f"<p>{inline(content[0])}</p>")
            is_first = False
        elif kind == "list":
            body.append("<ul>" + "".join(f"<li>{inline(item)}</li>" for item in content[0]) + "</ul>")
        elif kind == "table":
            body.append(html_table(*content))
        elif kind == "plot":
            _, caption, svg = content
            body.append(f'<figure class="wide" tabindex="0">{svg[svg.index("<svg"):].replace("fill: #ffffff", "fill: none")}<figcaption>{inline(caption)}</figcaption></figure>')
        elif kind == "picture":
            body.append(html_picture(*content))
    style, script = ((STYLE / name).read_text(encoding="utf-8") for name in ("style.css", "plain.js"))
    return ('<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{title}</title>\n<style>\n{style}{DARK}</style>\n</head>\n<body>\n<header><h1>{title}</h1></header>\n<main>\n" + "\n".join(body)
            + f"\n</main>\n<script>\n{script}</script>\n</body>\n</html>\n")


def write(blocks, path):
    """A page by the ending of its name: .html or .md."""
    path = pathlib.Path(path)
    path.write_text(html_of(blocks) if path.suffix == ".html" else markdown_of(blocks, path), encoding="utf-8")
