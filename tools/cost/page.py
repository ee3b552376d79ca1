#!/usr/bin/env python3
"""Makes the page of `strata cost` from the folders that it wrote, with the pictures of the frontiers beside it.

usage: page.py FOLDER... [--twice FOLDER FOLDER] -o RESULTS.md

Figures are those of cost.csv, results.csv and timings.jsonl; the page counts and computes nothing else. The two folders of --twice are
runs of one command.
"""
import argparse
import csv
import glob
import os
import re
import shutil

import same

HEAD = """# What accuracy costs

Made by `tools/cost/make_page.sh`; [reports.md](../../scenes/reference/reports.md) 10 says what is measured and how. Errors are those from
the truth of the scene (nothing snapped, nothing stored), in 1/255. Times are of the processor, on one thread, and ratios to the cheapest
cell of their column; beside them stands the spread of the rounds.
"""
COLUMN_NAMES = {"default": "by default", "literal": "literally", "modelled": "on the card"}


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def table(titles, rows):
    yield "| " + " | ".join(titles) + " |"
    yield "|" + "---|" * len(titles)
    for row in rows:
        yield "| " + " | ".join(row) + " |"
    yield ""


def rounded(text):
    return f"{float(text):.4g}" if text else ""


def spread(row, column):
    if not row[column]:
        return ""
    return f"{rounded(row[column])} ({rounded(row[column + '_least'])} to {rounded(row[column + '_greatest'])})"


def chain(rows):
    links = {row["value"]: row["rmse"] for row in rows if row["knob"] == "chain"}
    alone = {row["value"]: row["rmse"] for row in rows if row["knob"] == "alone"}
    return table(["link", "RMSE with the chain exact up to it", "RMSE with it alone exact"],
                 [[name, rounded(error), rounded(alone.get(name, links["machine"]))] for name, error in links.items()])


def frontier_names(folder, picture):
    with open(os.path.join(folder, picture), encoding="utf-8") as file:
        return re.findall(r'text-anchor="start">\d+ ([^<]+)</text>', file.read())


def pictures_of(folder):
    return sorted(os.path.basename(name) for name in glob.glob(os.path.join(folder, "frontier.*.svg")))


def frontier(folder, picture, rows):
    """The names on the picture's frontier, with their rows' figures."""
    names = frontier_names(folder, picture)
    of_name = {f"{row['knob']} {row['value']}": row for row in rows}
    return table(["on the frontier", "RMSE", "default", "literal", "card"],
                 [[name, rounded(row["rmse"]), spread(row, "default"), spread(row, "literal"), rounded(row["modelled"])]
                  for name, row in ((name, of_name[name]) for name in names)])


def distinct_points(folder, picture, rows):
    """Points of the frontier whose error or time is another than that of the point before."""
    column = picture.split(".")[-2]
    of_name = {f"{row['knob']} {row['value']}": row for row in rows}
    return len({(of_name[name]["rmse"], of_name[name][column]) for name in frontier_names(folder, picture)})


def asked_and_found(folders, twice):
    asked = []
    for folder in folders:
        rows = rows_of(os.path.join(folder, "cost.csv"))
        counts = [f"{distinct_points(folder, picture, rows)} {COLUMN_NAMES[picture.split('.')[-2]]}" for picture in pictures_of(folder)]
        asked.append([f"{rows[0]['scene']}: a frontier of at least six distinct points", ", ".join(counts)])
        drawn = [row for row in rows if row["outcome"] == "done" and row["knob"] not in ("chain", "alone")]
        timed = [row for row in drawn if row["default"]]
        asked.append([f"{rows[0]['scene']}: every knob, with its times",
                      f"{len({row['knob'] for row in rows})} knobs in {len(rows)} cells; {len(timed)} of {len(drawn)} are timed"])
        last = next(row["rmse"] for row in rows if row["knob"] == "chain" and row["value"] == "store")
        asked.append([f"{rows[0]['scene']}: the link made exact last leaves 0", f"RMSE {rounded(last)}"])
    asked.append(["every sentence agrees with its row", "`tools_test \"every sentence agrees*\"` parses each and compares it"])
    if twice:
        alike = "the same bytes" if same.is_alike(twice) else "they differ"
        asked.append(["the command twice: errors and counts are the same", alike])
        for column in same.COLUMNS:
            timed, apart = same.compared(twice, column)
            asked.append([f"the command twice: 95 % of the times agree within the larger spread, {COLUMN_NAMES[column]}",
                          f"{len(timed) - len(apart)} of {len(timed)}"])
    return table(["asked", "found"], asked)


def section(folder, page):
    rows = rows_of(os.path.join(folder, "cost.csv"))
    scene = rows[0]["scene"]
    yield f"## {scene}"
    yield ""
    yield f"{len(rows)} cells, {sum(row['outcome'] == 'refused' for row in rows)} refused."
    yield ""
    yield from chain(rows)
    for picture in pictures_of(folder):
        beside = f"RESULTS.{picture}"
        shutil.copy(os.path.join(folder, picture), os.path.join(os.path.dirname(page), beside))
        yield f"![{picture}]({beside})"
        yield ""
        yield from frontier(folder, picture, rows)
    yield "Every row as a sentence:"
    yield ""
    with open(os.path.join(folder, "sentences.txt"), encoding="utf-8") as file:
        yield from ("- " + line.rstrip("\n") for line in file)
    yield ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--twice", nargs=2)
    parser.add_argument("-o", dest="page", required=True)
    words = parser.parse_args()
    lines = [HEAD, *asked_and_found(words.folders, words.twice)]
    for folder in words.folders:
        lines.extend(section(folder, words.page))
    text = "\n".join(lines)
    with open(words.page, "w", encoding="utf-8") as file:
        file.write(text.rstrip("\n") + "\n")


if __name__ == "__main__":
    main()
