#!/usr/bin/env python3
"""Makes two pages from the folders that `strata cost` wrote: a short one, and one with every row and every frontier.

usage: page.py FOLDER... [--twice FOLDER FOLDER] -o RESULTS.md --whole WHOLE.md

RESULTS.md has at most 600 words; the default frontier of each scene is written to its folder as RESULTS.frontier.SCENE.default.svg. All frontiers are
written to the folder of WHOLE.md. Figures are from cost.csv, results.csv and timings.jsonl; a page only counts, takes minima and maxima, and divides
times of a column. The two folders of --twice are results of the same command.
"""
import argparse
import csv
import glob
import os
import re
import shutil

import same

TITLE = "# What accuracy costs\n"
QUESTION = """How much does each choice of algorithm, format and execution change the error of the picture, and how much time does it take? `strata cost`
emulates geforce8 on one thread of a CPU, %s.
"""
METHOD = """The error is the root mean square difference, in 1/255, from a picture that is computed exactly, without snapping, rounding or storing. Times are
processor times of one thread, relative to the default: `front_to_back` on `geforce8`, RGBA8, D24. Each is the median of at least five
rounds, in which both are rendered alternately, while other programs are active.
[reports.md](../../scenes/reference/reports.md) section 10 defines every option and figure.
"""
WHOLE_METHOD = """Errors are root mean square differences from the exact picture, in 1/255. Times are processor times of one thread, relative to the cheapest
cell of their column, with the least and the greatest round. Section 10 of scenes/reference/reports.md defines every figure.
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
    """The names on the frontier of the picture, with the figures of their rows."""
    names = frontier_names(folder, picture)
    of_name = {f"{row['knob']} {row['value']}": row for row in rows}
    return table(["on the frontier", "RMSE", "default", "literal", "card"],
                 [[name, rounded(row["rmse"]), spread(row, "default"), spread(row, "literal"), rounded(row["modelled"])]
                  for name, row in ((name, of_name[name]) for name in names)])


def distinct_points(folder, picture, rows):
    """Points of the frontier whose error or time differs from that of the previous point."""
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


def range_of(values):
    low, high = (f"{value:.3g}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def between(rows, knob):
    """The least and the greatest RMSE of the knob's finished cells."""
    return range_of([float(row["rmse"]) for row in rows if row["knob"] == knob and row["outcome"] == "done"])


def price_of_the_best(rows):
    """The least error of an algorithm, and its time divided by that of the fastest one."""
    drawn = [row for row in rows if row["default"] and row["knob"] == "algorithm"]
    fastest = min(drawn, key=lambda row: float(row["default"]))
    best = min(drawn, key=lambda row: (float(row["rmse"]), float(row["default"])))
    return (f"{float(best['default']) / float(fastest['default']):.2f} times as long as the fastest on {best['scene']} (`{best['value']}`, error "
            f"{float(best['rmse']):.3g}; `{fastest['value']}`, {float(fastest['rmse']):.3g})")


def weight_of_knobs(rows):
    return (f"on {rows[0]['scene']} the error ranges from {between(rows, 'algorithm')} over the algorithms, from {between(rows, 'depth')} over depth "
            f"formats and paths, and from {between(rows, 'subpixel_bits')} over subpixel bits")


def price_of_emulation(rows):
    """The times of literal execution and of the audit, divided by the default's time."""
    of_name = {(row["knob"], row["value"]): row for row in rows}
    base = next(float(row["default"]) for row in rows if row["knob"] == "default")
    literal, audit = (of_name[name] for name in (("execution", "literal"), ("audit", "on")))
    times = f"{float(literal['default']) / base:.1f} and {float(audit['default']) / base:.1f} times on {literal['scene']}"
    return times, max(float(row["from_default"]) for row in (literal, audit))


def three_sentences(folders):
    """The three main results of all scenes."""
    scenes = [rows_of(os.path.join(folder, "cost.csv")) for folder in folders]
    yield f"The most accurate algorithm takes {' and '.join(map(price_of_the_best, scenes))}."
    yield f"The algorithm matters most: {'; '.join(map(weight_of_knobs, scenes))}."
    times, moved = zip(*map(price_of_emulation, scenes))
    yield (f"Emulating every pass literally, and auditing, take {', '.join(times)} as long as the default, and change "
           f"{100 * max(moved):.4g} % of the pixels.")


KNOBS = {"algorithm": "algorithm, by colour format", "depth": "depth format and path", "subpixel_bits": "subpixel bits: 4, 8, 12",
         "peels": "number of passes, 1 to all", "average_count": "format of `weighted_average`'s count", "execution": "execution: literal, tiled",
         "effects": "all effects simulated", "audit": "audit of every fragment"}


def knob_rows(folders):
    """For each knob and scene: the range of its errors, and of its times divided by the default's."""
    scenes = [rows_of(os.path.join(folder, "cost.csv")) for folder in folders]
    for knob, name in KNOBS.items():
        cells = [name]
        for rows in scenes:
            base = next(float(row["default"]) for row in rows if row["knob"] == "default")
            drawn = [row for row in rows if row["knob"] == knob and row["default"]]
            cells += [range_of([float(row["rmse"]) for row in drawn]), range_of([float(row["default"]) / base for row in drawn])] if drawn else ["", ""]
        yield cells


def knob_table(folders):
    names = [rows_of(os.path.join(folder, "cost.csv"))[0]["scene"] for folder in folders]
    return table(["choice", *(title for name in names for title in (f"{name}: error", "time"))], knob_rows(folders))


def sentence_on_chain(folder):
    """The remaining error after each step of the emulation is made exact, in the order of the pipeline."""
    rows = rows_of(os.path.join(folder, "cost.csv"))
    left = {row["value"]: float(row["rmse"]) for row in rows if row["knob"] == "chain"}
    return f"{left['machine']:.3g} on {rows[0]['scene']}, {left['snap']:.3g} with exact corners, {left['blend']:.3g} with exact blending as well, {left['store']:.3g} stored exactly"


def sentence_on_repeats(twice):
    counts = {column: same.compared(twice, column) for column in same.COLUMNS}
    figures = ", ".join(f"{len(timed) - len(apart)} of {len(timed)} times {COLUMN_NAMES[column]}" for column, (timed, apart) in counts.items())
    alike = "the same bytes" if same.is_alike(twice) else "DIFFERENT ERRORS"
    return f"Two measurements of the teapot give {alike} in errors and counts; {figures} agree within the spread of their rounds.\n"


def shown_frontier(folder, page):
    """The picture of errors against elapsed times, copied to the folder of the page."""
    picture = next(name for name in pictures_of(folder) if name.endswith(".default.svg"))
    beside = f"{os.path.splitext(os.path.basename(page))[0]}.{picture}"
    shutil.copy(os.path.join(folder, picture), os.path.join(os.path.dirname(page), beside))
    return f"![error against time, by default: {picture}]({beside})\n"


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "an unnamed processor")


def short_page(folders, twice, page):
    yield from [TITLE, QUESTION % processor(), " ".join(three_sentences(folders)), ""]
    yield from (shown_frontier(folder, page) for folder in folders)
    yield from knob_table(folders)
    yield f"Where the error of an exact peel (`depth_units`, RGBA8) comes from: {'; '.join(map(sentence_on_chain, folders))}.\n"
    yield METHOD
    if twice:
        yield sentence_on_repeats(twice)
    cells = sum(len(rows_of(os.path.join(folder, "cost.csv"))) for folder in folders)
    yield from ["## The whole table", "", "    tools/cost/make_page.sh MODELS", "",
                f"MODELS is a folder with dragon.glb and sponza.glb. The command measures {cells} cells in a quarter of an hour. It writes this page,",
                "`build/cost/RESULTS.md` with every cell as a sentence, the frontiers for literal execution and for the modelled card, and the error with",
                "each step of the emulation made exact, and `build/cost/dragon/cost.csv` with a row for each cell."]


def section(folder, page):
    rows = rows_of(os.path.join(folder, "cost.csv"))
    scene = rows[0]["scene"]
    yield f"## {scene}"
    yield ""
    yield f"{len(rows)} cells, {sum(row['outcome'] == 'refused' for row in rows)} refused."
    yield ""
    yield from chain(rows)
    for picture in pictures_of(folder):
        beside = f"{os.path.splitext(os.path.basename(page))[0]}.{picture}"
        shutil.copy(os.path.join(folder, picture), os.path.join(os.path.dirname(page), beside))
        yield f"![{picture}]({beside})"
        yield ""
        yield from frontier(folder, picture, rows)
    yield "Every row as a sentence:"
    yield ""
    with open(os.path.join(folder, "sentences.txt"), encoding="utf-8") as file:
        yield from ("- " + line.rstrip("\n") for line in file)
    yield ""


def whole_page(folders, twice, page):
    yield from [TITLE, WHOLE_METHOD, *asked_and_found(folders, twice)]
    for folder in folders:
        yield from section(folder, page)


def write(page, lines):
    with open(page, "w", encoding="utf-8") as file:
        file.write("\n".join(lines).rstrip("\n") + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--twice", nargs=2)
    parser.add_argument("-o", dest="page", required=True)
    parser.add_argument("--whole", required=True)
    words = parser.parse_args()
    write(words.page, short_page(words.folders, words.twice, words.page))
    write(words.whole, whole_page(words.folders, words.twice, words.whole))


if __name__ == "__main__":
    main()
