#!/usr/bin/env python3
"""Makes pages from the folders that `strata cost` wrote: a ranking of each scene, and in how far each choice matters.

    tools/lab/cost/page.py FOLDER... -o PAGE.html                              every row, with plots, as one file
    tools/lab/cost/page.py FOLDER... [--twice FOLDER FOLDER] -o PAGE.md --short   at most 600 words, with a plot of each scene

The two folders of --twice are results of the same command. Needs matplotlib. A page only counts, takes minima and maxima, and divides times.
"""
import argparse
import pathlib

import same
from ranking import ranking_plot
from rows import card_time, pages, ranked, rows_of, standard_of

TITLE = ("title", "What accuracy costs")
QUESTION = """How much does each choice of algorithm, format and execution change the error of the picture, and how much time does it take? `strata cost`
emulates geforce8 on one thread of a CPU, %s."""
METHOD = """Errors are root mean square differences in 1/255. *From sorted*: from the A-buffer on the same device with the same formats, which sorts the
same fragments exactly. *From exact*: from a picture that is computed without snapping, rounding or storing. Times are relative to the default:
`front_to_back` on `geforce8`, RGBA8, D24. Each is the median of at least five rounds, in which both are rendered alternately.
[reports.md](../../../scenes/reference/reports.md) section 10 defines every option and figure."""
KNOBS = {"algorithm": "algorithm, by colour format", "depth": "depth format and path", "subpixel_bits": "subpixel bits: 4, 8, 12",
         "peels": "number of passes, 1 to all", "average_count": "format of `weighted_average`'s count", "execution": "execution: literal, tiled",
         "effects": "all effects simulated", "audit": "audit of every fragment"}


def figure(value):
    return "-" if value is None else f"{value:.4g}"


def spread(time):
    return "-" if time is None else f"{time['median']:.3g} ({time['least']:.3g} to {time['greatest']:.3g})"


def range_of(values):
    low, high = (f"{value:.3g}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def plot_of(rows, kinds=None):
    scene = rows[0]["scene"]
    shown = ranked([row for row in rows if kinds is None or row["knob"] in kinds])
    svg = ranking_plot(shown, f"{scene}: best first", lambda row: row["default"] and row["default"]["median"], "time / default")
    return ("plot", "ranking." + "".join(c if c.isalnum() or c in ".-" else "-" for c in scene),
            f"{scene}: the choices, best first, with their errors and their times", svg)


def price_of_the_best(rows):
    """The least error of an algorithm, and its time divided by that of the fastest one."""
    drawn = [row for row in rows if row["default"] and row["knob"] == "algorithm"]
    if not drawn:
        return None
    fastest = min(drawn, key=lambda row: row["default"]["median"])
    best = min(drawn, key=lambda row: (row["rmse"], row["default"]["median"]))
    return (f"{best['default']['median'] / fastest['default']['median']:.2f} times as long as the fastest on {best['scene']} (`{best['value']}`, error "
            f"{best['rmse']:.3g}; `{fastest['value']}`, {fastest['rmse']:.3g})")


def sentences(scenes):
    prices = list(filter(None, map(price_of_the_best, scenes)))
    if prices:
        yield f"The most accurate algorithm takes {' and '.join(prices)}."
    ranges = [f"on {rows[0]['scene']} {range_of([row['rmse'] for row in rows if row['knob'] == knob and row['outcome'] == 'done'])} by {name}"
              for rows in scenes for knob, name in KNOBS.items() if knob in ("algorithm", "depth", "subpixel_bits") and drawn(rows, knob)]
    if ranges:
        yield f"Errors from the exact picture: {'; '.join(ranges)}."


def drawn(rows, knob):
    return [row for row in rows if row["knob"] == knob and row["default"]]


def knob_rows(scenes):
    """For each kind of choice and scene: the range of its errors, and of its times."""
    for knob, name in KNOBS.items():
        cells = [name]
        for rows in scenes:
            own = drawn(rows, knob)
            cells += [range_of([row[key] for row in own]) for key in ("sorted_rmse", "rmse")] if own else ["", ""]
            cells += [range_of([row["default"]["median"] for row in own])] if own else [""]
        if any(cells[1:]):
            yield cells


def knob_table(scenes):
    header = ["choice", *(title for rows in scenes for title in (f"{rows[0]['scene']}: RMSE from sorted", "from exact", "time"))]
    return ("table", header, list(knob_rows(scenes)))


def chain_blocks(rows):
    """The error with the steps of the emulation made exact: all up to one, and that one alone."""
    links = {row["value"]: row["rmse"] for row in rows if row["knob"] == "chain"}
    alone = {row["value"]: row["rmse"] for row in rows if row["knob"] == "alone"}
    if not links:
        return []
    return [("text", "Where the error from the exact picture comes from: steps of the emulation made exact, in the order of the pipeline."),
            ("table", ["step", "RMSE with all steps up to it exact", "RMSE with it alone exact"],
             [[name, figure(error), figure(alone.get(name))] for name, error in links.items()])]


def chain_sentence(rows):
    left = {row["value"]: row["rmse"] for row in rows if row["knob"] == "chain"}
    return (f"{left['device']:.3g} on {rows[0]['scene']}, {left['snap']:.3g} with exact corners, {left['blend']:.3g} with exact blending as well, "
            f"{left['store']:.3g} stored exactly") if "device" in left else None


def repeats(twice):
    agreed = []
    for column, name in (("default", "by default"), ("literal", "literally")):
        timed, apart = same.compared(twice, column)
        agreed.append(f"{len(timed) - len(apart)} of {len(timed)} times {name}")
    return (f"Two measurements of one scene give {'the same bytes' if same.is_alike(twice) else 'other bytes'} in errors and counts; "
            f"{', '.join(agreed)} agree within the spread of their rounds.")


def short_page(scenes, twice):
    yield TITLE
    yield ("text", QUESTION % processor())
    yield ("text", " ".join(sentences(scenes)))
    yield from (plot_of(rows, ("default", "algorithm")) for rows in scenes)
    yield knob_table(scenes)
    chains = list(filter(None, map(chain_sentence, scenes)))
    if chains:
        yield ("text", f"Where the error of an exact peel (`front_to_back`, RGBA8) comes from: {'; '.join(chains)}.")
    yield ("text", METHOD)
    if twice:
        yield ("text", repeats(twice))
    yield ("heading", "The whole table")
    yield ("text", "    tools/lab/cost/make_page.sh MODELS")
    yield ("text", f"MODELS is a folder with dragon.glb and sponza.glb. The command measures {sum(map(len, scenes))} rows, writes this page and\n"
                   "`build/cost/RESULTS.html` with every row, and `build/cost/SCENE/results.csv`.")


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "an unnamed processor")


def ranking_rows(rows):
    standard = standard_of(rows)
    first = ranked(rows)
    rest = [row for row in rows if row not in first]
    for number, row in enumerate([*first, *rest], 1):
        opened = f" (with {row['opened']})" if row["opened"] else ""
        yield [str(number) if row in first else "-", row["knob"], row["value"] + opened, figure(row["sorted_rmse"]),
               "refused" if row["outcome"] == "refused" else figure(row["rmse"]), spread(row["default"]), spread(row["literal"]),
               figure(card_time(row, standard))]


def whole_page(scenes):
    yield TITLE
    yield ("text", " ".join(sentences(scenes)) or f"{sum(map(len, scenes))} rows.")
    yield ("text", METHOD.replace("\n", " "))
    for rows in scenes:
        yield ("heading", rows[0]["scene"])
        yield plot_of(rows)
        yield ("table", ["rank", "knob", "value", "RMSE from sorted", "from exact", "time / default", "literal / default", "card's time / default"],
               list(ranking_rows(rows)), (0, 3, 4, 5, 6, 7))
        yield from chain_blocks(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--twice", nargs=2, type=pathlib.Path)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("-o", dest="page", required=True)
    options = parser.parse_args()
    scenes = [[row for row in rows if row["scene"] == scene] for rows in map(rows_of, options.folders)
              for scene in dict.fromkeys(row["scene"] for row in rows)]
    pages.write(list(short_page(scenes, options.twice) if options.short else whole_page(scenes)), options.page)


if __name__ == "__main__":
    main()
