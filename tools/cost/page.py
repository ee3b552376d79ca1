#!/usr/bin/env python3
"""Makes the page of `strata cost` from the folders that it wrote, with the pictures of the frontiers beside it.

usage: page.py FOLDER... [--twice FOLDER FOLDER] -o RESULTS.md

Figures are those of cost.csv, results.csv and timings.jsonl; the page counts, takes least and greatest, and divides two times of one
column. The two folders of --twice are runs of one command.
"""
import argparse
import csv
import glob
import os
import re
import shutil

import same

TITLE = "# What accuracy costs\n"
METHOD = """Made by `tools/cost/make_page.sh`; [reports.md](../../scenes/reference/reports.md) 10 says what is measured and how. Errors are those from
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


def between(rows, knob):
    """The least and the greatest RMSE among the knob's cells that ran."""
    errors = [float(row["rmse"]) for row in rows if row["knob"] == knob and row["outcome"] == "done"]
    return f"{min(errors):.3g} to {max(errors):.3g}"


def price_of_the_best(rows):
    """The least error of an algorithm in times of the fastest one's time."""
    drawn = [row for row in rows if row["default"] and row["knob"] == "algorithm"]
    fastest = min(drawn, key=lambda row: float(row["default"]))
    best = min(drawn, key=lambda row: (float(row["rmse"]), float(row["default"])))
    return (f"{float(best['default']) / float(fastest['default']):.2f} times on {best['scene']} (`{best['value']}`, RMSE "
            f"{float(best['rmse']):.3g}/255, beside `{fastest['value']}`, {float(fastest['rmse']):.3g}/255)")


def weight_of_knobs(rows):
    return (f"on {rows[0]['scene']} the algorithm moves the RMSE from {between(rows, 'algorithm')}, depth format and path from "
            f"{between(rows, 'depth')}, subpixel bits from {between(rows, 'subpixel_bits')}")


def price_of_emulation(rows):
    """Literal execution and the audit in times of the default's time."""
    of_name = {(row["knob"], row["value"]): row for row in rows}
    base = next(float(row["default"]) for row in rows if row["knob"] == "default")
    literal, audit = (of_name[name] for name in (("execution", "literal"), ("audit", "on")))
    times = f"{float(literal['default']) / base:.1f} and {float(audit['default']) / base:.1f} times on {literal['scene']}"
    return times, max(float(row["from_default"]) for row in (literal, audit))


def three_sentences(folders):
    """What was found, of all scenes, from their figures."""
    scenes = [rows_of(os.path.join(folder, "cost.csv")) for folder in folders]
    yield f"The least error of any algorithm takes the fastest one's time {' and '.join(map(price_of_the_best, scenes))}."
    yield f"What to choose first: {'; '.join(map(weight_of_knobs, scenes))}."
    times, moved = zip(*map(price_of_emulation, scenes))
    yield (f"Running every pass literally, and auditing, take the default's time {', '.join(times)}, and change "
           f"{100 * max(moved):.4g} % of the pixels.")


def shown_frontier(folder, page):
    """The picture of the error against what one waits, copied beside the page."""
    picture = next(name for name in pictures_of(folder) if name.endswith(".default.svg"))
    shutil.copy(os.path.join(folder, picture), os.path.join(os.path.dirname(page), f"RESULTS.{picture}"))
    return f"![error against time, by default: {picture}](RESULTS.{picture})\n"


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
        if picture.endswith(".default.svg"):
            yield "The frontier by default, drawn at the head of the page:"
        else:
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
    lines = [TITLE, " ".join(three_sentences(words.folders)), ""]
    lines.extend(shown_frontier(folder, words.page) for folder in words.folders)
    lines.extend([METHOD, *asked_and_found(words.folders, words.twice)])
    for folder in words.folders:
        lines.extend(section(folder, words.page))
    text = "\n".join(lines)
    with open(words.page, "w", encoding="utf-8") as file:
        file.write(text.rstrip("\n") + "\n")


if __name__ == "__main__":
    main()
