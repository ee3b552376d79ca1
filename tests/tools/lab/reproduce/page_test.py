#!/usr/bin/env python3
"""Tests tools/lab/reproduce/page.py on a document written by hand. usage: page_test.py REPOSITORY"""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import page_checks  # noqa: E402

SCRIPT = page_checks.ROOT / "tools" / "lab" / "reproduce" / "page.py"
PNG = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b550000000a49444154789c6360000000020001e221bc330000000049454e44ae426082")
PAGE = {"title": "Title <1>", "lead": "Shows <all>", "link": "https://paper", "sections": [
    {"title": "A < B & C", "text": "text", "table": "numbers.csv", "pictures": [{"file": "p.png", "caption": "caption & more"}],
     "charts": [{"name": "c", "x_label": "slices", "y_label": "passes", "curves": [{"name": "peel", "points": [[16, 1], [256, 1000]]},
                                                                                   {"name": "other", "points": [[16, 2], [256, 2]]}]}]},
    {"title": "Second", "text": "no table", "table": None, "pictures": [], "charts": []}]}


def checks(folder):
    (folder / "page.json").write_text(json.dumps(PAGE))
    (folder / "numbers.csv").write_text('x,y > 0\n1,a<b\n2,"&, and"\n')
    (folder / "p.png").write_bytes(PNG)
    ended = subprocess.run([sys.executable, str(SCRIPT), str(folder)], capture_output=True, text=True, check=False)
    yield f"it ends well: {ended.stderr}", ended.returncode == 0
    page = (folder / "index.html").read_text()
    yield "the title is text", "<h1>Title &lt;1&gt;</h1>" in page
    yield "the paper is a link", '<a href="https://paper">The paper</a>' in page
    yield "the lead is first", '<p class="lead">Shows &lt;all&gt;</p>' in page and page.index("Shows") < page.index("<h2>A")
    yield "the table has its rows", "<tr><td>1</td><td>a&lt;b</td></tr>\n<tr><td>2</td><td>&amp;, and</td></tr>" in page
    yield "the picture has its caption", "<figcaption>caption &amp; more</figcaption>" in page
    yield "a chart has its axes and its curves", all(f">{word}<" in page for word in ("slices", "passes", "peel", "other"))
    yield "sections are in order", page.index("<h2>A &lt; B &amp; C</h2>") < page.index("<h2>Second</h2>")
    yield "it is one file", 'src="p.png"' not in page and page.count("<table") == 1
    missing = subprocess.run([sys.executable, str(SCRIPT)], capture_output=True, text=True, check=False)
    yield "without a folder it says how it is used", missing.returncode != 0 and "page.py FOLDER" in missing.stderr


with tempfile.TemporaryDirectory() as path:
    page_checks.end(checks(pathlib.Path(path)), 10)
