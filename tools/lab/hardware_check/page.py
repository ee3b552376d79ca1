#!/usr/bin/env python3
"""Makes the pages of the hardware check from the folder that `strata hardware-check -o` wrote.

    page.py FOLDER -o RESULTS.md                               at most 600 words and a plot
    page.py FOLDER --whole [--hypotheses FILE] -o PAGE.html    every picture that is not equal, with its difference; FILE is what --hypotheses printed

Needs matplotlib.
"""
import argparse
import json
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import pages  # noqa: E402
import plots  # noqa: E402

COLORS = {"equal": "#009e73", "within bound": "#e69f00", "outside": "#d55e00", "not modelled": "#999999"}
HEAD = ["suite", "pictures", *COLORS, "pixels compared", "pixels that differ", "largest difference"]


class Suite:
    """The pictures of a suite: how many have each outcome, and their pixels."""

    def __init__(self, name, pictures):
        self.name = name
        self.counts = [sum(picture["outcome"] == outcome for picture in pictures) for outcome in COLORS]
        self.counts[-1] += sum(picture["outcome"] == "unknown" for picture in pictures)
        self.pixels, self.off = (sum(picture[key] for picture in pictures) for key in ("compared", "differing"))
        self.largest = max((picture["largest"] for picture in pictures), default=0)

    def row(self):
        return [self.name, *(f"{n:,}" for n in (sum(self.counts), *self.counts, self.pixels, self.off, self.largest))]


def suites_of(pictures):
    return [Suite(name, [picture for picture in pictures if picture["suite"] == name]) for name in dict.fromkeys(picture["suite"] for picture in pictures)]


def plot_of(suites):
    figure, (axes,) = plots.axes_of(8, 1 + 0.2 * len(suites), "Pictures of each suite", "pictures", "")
    left = [0] * len(suites)
    for i, (outcome, color) in enumerate(COLORS.items()):
        widths = [suite.counts[i] for suite in suites]
        axes.barh(range(len(suites)), widths, left=left, color=color, label=outcome)
        left = [a + b for a, b in zip(left, widths)]
    axes.set_yticks(range(len(suites)), [suite.name for suite in suites])
    axes.set_ylim(len(suites) - 0.4, -0.6)
    axes.legend(loc="lower right", frameon=False)
    return ("plot", "suites", "Pictures by suite: equal, within their bound, outside, not modelled", plots.svg_of(figure))


def rows_of(suites):
    """A row for each suite with a picture that is not equal, and one for all others."""
    equal = [suite for suite in suites if not any(suite.counts[1:])]
    rest = Suite(f"{len(equal)} other suites", [])
    rest.counts = [sum(column) for column in zip(*(suite.counts for suite in equal))] if equal else rest.counts
    rest.pixels, rest.off = sum(suite.pixels for suite in equal), 0
    return [suite.row() for suite in suites if any(suite.counts[1:])] + ([rest.row()] if equal else [])


def short_page(pictures):
    every = suites_of(pictures)
    suites = [suite for suite in every if any(suite.counts[:3])]
    unknown = [suite for suite in every if suite not in suites]
    equal, within, outside, unmodelled = (sum(column) for column in zip(*(suite.counts for suite in suites)))
    yield ("title", "The profile geforce3 against a real chip")
    yield ("text", """Does the profile `geforce3` give the same bits as a chip of that generation? `strata hardware-check` renders the pictures of a public test suite
from their names alone, and compares every pixel outside the labels with captures of an NV2A, the GeForce3-class GPU of the Xbox
(abaire/nxdk_pgraph_tests_golden_results, CC0 1.0).""")
    yield ("text", f"""Of {equal + within + outside + unmodelled} captures {equal} are equal in every bit, {within} are within the bound of their suite, and {outside} are outside. {unmodelled} show features that are not
modelled. Of {sum(s.pixels for s in suites):,} compared pixels {sum(s.off for s in suites):,} differ. {len(unknown)} further suites, with {sum(sum(s.counts) for s in unknown)} captures, show no modelled feature.""")
    yield plot_of(suites)
    yield ("table", HEAD, rows_of(suites), range(1, len(HEAD)))
    yield ("text", """Differences are in codes of a colour channel or of the stored depth. *Within bound*: few pixels differ, by few codes, and only the last bits
of the cause are unknown; bounds are in [suites](suites), subjects in [SUBJECTS.md](SUBJECTS.md). *Outside*: the w buffer with a slope or float depth.
[open_questions.md](open_questions.md) lists what is unknown, and what was tried.""")
    yield ("text", """The captures are not in this repository; `tests/tools/lab/hardware_check/hardware_digests.txt` has digests of the equal pictures for tests.""")
    yield ("heading", "The whole table")
    yield ("text", "    tools/lab/hardware_check/make_page.sh CAPTURES")
    yield ("text", """CAPTURES has the files SUITE/NAME.png of the archive, or some of them. The command writes this page, and `build/hardware_check/RESULTS.html` with
every picture that is not equal, its difference, and each rule of the profile compared with its alternatives.""")


def whole_page(pictures, folder, hypotheses):
    suites = suites_of(pictures)
    counts = [sum(column) for column in zip(*(suite.counts for suite in suites))]
    yield ("title", "The profile geforce3 against a real chip, picture by picture")
    yield ("text", f"{sum(counts)} pictures: " + ", ".join(f"{n} {outcome}" for n, outcome in zip(counts, COLORS)) + ".")
    yield plot_of(suites)
    yield ("table", HEAD, [suite.row() for suite in suites], range(1, len(HEAD)))
    yield ("heading", "Pictures that differ")
    yield ("text", "Black is equal; red is a colour that differs, or a greater depth of the chip, cyan a smaller one; labels, which are not compared, are white.")
    for picture in sorted((p for p in pictures if p["difference"]), key=lambda p: p["outcome"]):
        yield ("picture", folder / picture["difference"], f"{picture['suite']}/{picture['picture']}: {picture['outcome']}, {picture['differing']} of "
               f"{picture['compared']} pixels differ, by at most {picture['largest']}; {picture['detail']}")
    yield ("heading", "Pictures that are not modelled")
    yield ("list", [f"{p['suite']}/{p['picture']}: {p['detail']}" for p in pictures if p["outcome"] == "not modelled"])
    if hypotheses:
        yield ("heading", "Hypotheses, each scored on the captures that it can change")
        yield ("list", [line for line in hypotheses.read_text(encoding="utf-8").splitlines() if line])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--hypotheses", type=pathlib.Path)
    parser.add_argument("-o", dest="page", type=pathlib.Path, required=True)
    options = parser.parse_args()
    pictures = json.loads((options.folder / "results.json").read_text(encoding="utf-8"))["pictures"]
    pages.write(list(whole_page(pictures, options.folder, options.hypotheses) if options.whole else short_page(pictures)), options.page)


if __name__ == "__main__":
    main()
