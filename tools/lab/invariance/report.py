#!/usr/bin/env python3
"""Makes plots and a page from the results of `strata invariance`.

    tools/lab/invariance/report.py FOLDER...                     # index.html in the first folder, with everything inside
    tools/lab/invariance/report.py FOLDER... --markdown PAGE.md  # PAGE.md, and its plots as PAGE.NAME.svg in its folder
    tools/lab/invariance/report.py FOLDER... --short PAGE.md     # the same, with at most 600 words and one plot
    tools/lab/invariance/report.py FOLDER... --formats FOLDER    # with the section on depth formats

Needs matplotlib. The page depends on results.jsonl, and on timings.jsonl for ratios of times.
"""
import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import formats  # noqa: E402
import pages  # noqa: E402
import sections  # noqa: E402


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=pathlib.Path, nargs="+", help="what `strata invariance -o` wrote; a page goes to the first")
    parser.add_argument("--formats", type=pathlib.Path, help="the folder of a sweep of formats.json, which becomes a section")
    parser.add_argument("--markdown", type=pathlib.Path, help="a page to keep instead of FOLDER/index.html")
    parser.add_argument("--short", type=pathlib.Path, help="a short page to keep: the answer, its table and its plot")
    parser.add_argument("--title", default="Invariance")
    return parser.parse_args()


def results(folder):
    """The rows with additional values for the page: seconds of the peel, and the path of the cell's pictures."""
    timings = folder / "timings.jsonl"
    seconds = {line["cell"]: line["peel_seconds"] for line in pages.lines_in(timings)} if timings.exists() else {}
    rows = pages.lines_in(folder / "results.jsonl")
    for row in rows:
        row["seconds"] = seconds.get(row["cell"])
        row["pictures"] = folder / "images" / f"{row['cell']:04}"
    return rows


HOW = [("heading", "The whole table"), ("text", "    tools/lab/invariance/make_page.sh FOLDER_OF_DRAGON_GLB"),
       ("text", "In a few minutes the command writes this page and `build/invariance/RESULTS.md` with every cell: the safe bias "
                "of every choice, every remedy, different vertex transforms and splits of surfaces, and the effect of each assumption about the chip. "
                "[audit.md](../../../peeling/reference/audit.md) defines the figures.")]


def main():
    arguments = parse_arguments()
    rows = [row for folder in arguments.folders for row in results(folder)]
    study = results(arguments.formats) if arguments.formats else []
    if arguments.short:
        pages.write([*sections.short_page(arguments.title, rows, formats.short_section(study)), *HOW], arguments.short)
    else:
        pages.write(sections.page(arguments.title, rows, formats.section(study)), arguments.markdown or arguments.folders[0] / "index.html")


if __name__ == "__main__":
    main()
