#!/usr/bin/env python3
"""Writes the page of mistakes from the rows of strata_suite_mistakes: page.py STRATA FOLDER -o MISTAKES.md [--whole WHOLE.md]

FOLDER has results.jsonl, a row per scene of the suite. MISTAKES.md gets the results and a plot; WHOLE.md also the whole table, every scene's command and
every mistake's sentence.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "lab"))
import pages  # noqa: E402
import plots  # noqa: E402

SIGNS = {"named": "1", "alike": "=", "wrong": "!", "hidden": ".", "accused": "?", "impossible": " "}
PIECES = [("named first", "#1b7837", ["named"]), ("the same picture as one that is named", "#a6dba0", ["alike"]),
          ("another mistake is named", "#c51b1b", ["wrong", "accused"]), ("does not show", "#d9d9d9", ["hidden"])]
SHOWN = ("named", "alike", "wrong")


class Table:
    """The answers by scene and mistake, in the order of the rows and of the catalogue."""

    def __init__(self, rows):
        self.rows = rows
        self.names = [mistake["name"] for mistake in rows[0]["mistakes"]]
        self.answers = [[mistake["answer"] for mistake in row["mistakes"]] for row in rows]
        self.pictures = [[mistake["picture"] for mistake in row["mistakes"]] for row in rows]

    def named_in(self, m):
        return [row["scene"] for row, answers in zip(self.rows, self.answers) if answers[m] == "named"]

    def shown_in(self, m):
        return sum(answers[m] in SHOWN for answers in self.answers)

    def equal_to(self, name):
        """An earlier mistake with the same picture of every scene, or None."""
        return next((first for first, second in self.equal_pairs() if second == name), None)

    def equal_pairs(self):
        of_mistake = collections.defaultdict(list)
        for name, *pictures in zip(self.names, *self.pictures):
            of_mistake[tuple(pictures)].append(name)
        return [(a, b) for names in of_mistake.values() for i, a in enumerate(names) for b in names[i + 1:]]


def findings(table):
    """The results in three sentences."""
    unnamed = [name for m, name in enumerate(table.names) if not table.named_in(m)]
    words = ", ".join(name + (f" (its picture always equals {first}'s)" if (first := table.equal_to(name)) else "") for name in unnamed) or "none"
    count = collections.Counter(answer for answers in table.answers for answer in answers)
    wrong = count["wrong"] + count["accused"]
    shown = [sum(answer in SHOWN for answer in answers) for answers in table.answers]
    best = shown.index(max(shown))
    in_one = sum(table.shown_in(m) == 1 for m in range(len(table.names)))
    return (f"Of {len(table.names)} mistakes {len(table.names) - len(unnamed)} are named first in at least one of {len(table.rows)} scenes; "
            f"never named: {words}.\n"
            f"{wrong} of {wrong + count['named'] + count['alike'] + count['hidden']} diagnoses name another mistake. "
            f"Pairs of mistakes with equal pictures of all scenes: {len(table.equal_pairs())}.\n"
            f"The scene {table.rows[best]['scene']} shows most of them, {shown[best]}; {in_one} are visible in one scene only, so that no single scene "
            "tests a port.")


def plot(table):
    figure, (axes,) = plots.axes_of(8, 0.22 * len(table.rows) + 1, "What each scene shows of the mistakes", "mistakes", "")
    places = range(len(table.rows))
    left = [0] * len(table.rows)
    for words, color, kinds in PIECES:
        lengths = [sum(answer in kinds for answer in answers) for answers in table.answers]
        axes.barh(places, lengths, left=left, color=color, label=words)
        left = [a + b for a, b in zip(left, lengths)]
    axes.set_yticks(places, [row["scene"] for row in table.rows])
    axes.invert_yaxis()
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.05), ncols=2, frameon=False)
    return plots.svg_of(figure)


def page_of(table, svg):
    return [("title", "Mistakes, and the scenes that show them"),
            ("text", "If a port makes one of the known mistakes, does `strata diagnose` name it from the picture alone, and which scenes must be rendered "
                     "for that?\nEach mistake of the catalogue is emulated alone, on a CPU, on every scene of the suite (`tools/oracle/suite/make_page.sh`). "
                     "The\npicture is then diagnosed like that of an unknown port."),
            ("text", findings(table)), ("plot", "scenes", "What each scene of the suite shows of the mistakes", svg),
            ("text", "Each bar is a scene: the numbers of mistakes that are named first, that have the picture of another, named mistake, and that are not\n"
                     "visible. The others cannot occur in that scene."),
            ("heading", "The whole table"),
            ("text", "    tools/oracle/suite/make_page.sh          # this page, and the whole table: build/mistakes/MISTAKES.md\n"
                     "    strata diagnose --list                   # every mistake in a sentence\n"
                     "    strata diagnose --list --suite           # every scene with its purpose and its command"),
            ("text", "The whole table has a row per mistake, a column per scene, the command of each scene, and the first scene that names each mistake. Two\n"
                     "mistakes that give the same pictures in every scene are listed, too. `strata render SCENE --mistake NAME` renders a picture with a "
                     "mistake.")]


def whole_of(table, sentences):
    numbers = [str(i + 1) for i in range(len(table.rows))]
    signs = [[name, *(SIGNS[answers[m]] for answers in table.answers)] for m, name in enumerate(table.names)]
    first = [f"{scenes[0]} ({len(scenes)} in all)" if (scenes := table.named_in(m)) else f"named as {equal}, its equal" if (equal := table.equal_to(name))
             else "nowhere" for m, name in enumerate(table.names)]
    return [("title", "Mistakes and the scenes that show them"), ("text", findings(table)),
            ("text", "1 named first; = the picture of a mistake above it, which is named; . not visible, and the right emulation is named; blank: not "
                     "applicable to the scene."),
            ("table", ["mistake", *numbers], signs),
            ("table", ["scene", "", "command"], [[f"{i} {row['scene']}", row["why"], f"`{row['command']}`"] for i, row in zip(numbers, table.rows)]),
            *(("text", f"{a} and {b} have equal pictures of all scenes; `suite.json` of a suite has the reason.") for a, b in table.equal_pairs()),
            ("table", ["mistake", "a picture has this mistake if its pixels are those of", "named first in"],
             [[name, sentences[name], place] for name, place in zip(table.names, first)])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("strata")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--whole", type=pathlib.Path)
    options = parser.parse_args()
    table = Table(pages.lines_in(options.folder / "results.jsonl"))
    listed = json.loads(subprocess.run([options.strata, "diagnose", "--list", "--json"], capture_output=True, text=True, check=True).stdout)
    options.output.write_text(pages.markdown_of(page_of(table, plot(table)), options.output), encoding="utf-8")
    if options.whole:
        sentences = {mistake["name"]: mistake["sentence"] for mistake in listed}
        options.whole.write_text(pages.markdown_of(whole_of(table, sentences), options.whole), encoding="utf-8")


if __name__ == "__main__":
    main()
