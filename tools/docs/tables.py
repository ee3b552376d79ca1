#!/usr/bin/env python3
"""Writes the tables of algorithms between the markers of pages, from the output of `strata list algorithms --json`, and the counts that pages copy from
the program or from pages of results.

    tools/docs/tables.py build/release            writes them
    tools/docs/tables.py build/release --check    compares them; exit status 1 and a line for each that differs

The markers of a table are `<!-- table NAME: tools/docs/tables.py -->` and `<!-- end of table -->`. COUNTS lists the counts.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TIES = {"none": "no order", "last": "last", "first": "first", "unique": "first submitted only", "merged": "merged", "first_then_last": "first in front, last behind"}


def row(*cells):
    return "| " + " | ".join(cells) + " |"


def table(head, rows):
    return "\n".join([row(*head), "|---" * len(head) + "|", *(row(*cells) for cells in rows)])


def file_of(name):
    """The source file that has the algorithm's entry."""
    return next(path.name for path in sorted((ROOT / "peeling/algorithms").glob("**/*.cpp")) if f'.name = "{name}"' in path.read_text(encoding="utf-8"))


def section_of(name):
    """The number of its heading in algorithms.md."""
    text = (ROOT / "peeling/reference/algorithms.md").read_text(encoding="utf-8")
    return next(number for number, title in re.findall(r"^## (\d+) (.*)$", text, re.MULTILINE) if f"`{name}`" in title)


def listed(algorithms, _):
    return table(["algorithm", "ties", "geometry passes for N layers", "exact", "file", "section"],
                 [[a["name"], TIES[a["ties"]], a["pass_formula"], "yes" if a["exact"] else "no", f"`{file_of(a['name'])}`", section_of(a["name"])]
                  for a in algorithms])


def devices(algorithms, profiles):
    return table(["algorithm", *(f"`{p}`" for p in profiles)],
                 [[f"`{a['name']}`", *("runs" if p in a["profiles"] else "refused" for p in profiles)] for a in algorithms])


def needs(algorithms, _):
    groups = {}
    for a in algorithms:
        wanted = list(a["needs"])
        wanted += [f"{a['render_targets']} render targets"] if a["render_targets"] > 1 else []
        wanted += [f"{a['samples']} samples"] if a["samples"] > 1 else []
        groups.setdefault("; ".join(wanted) or "nothing", []).append(f"`{a['name']}`")
    return table(["needs", "algorithms"], [[wanted, ", ".join(names)] for wanted, names in groups.items()])


TABLES = {"listed": listed, "devices": devices, "needs": needs}
PAGES = ("peeling/reference/algorithms.md", "pipeline/reference/devices.md", "peeling/reference/keys-and-counts.md")
MARKED = re.compile(r"(<!-- table (\w+): [\w/.]+ -->\n)(.*?)(<!-- end of table -->)", re.DOTALL)


# A page, what it says with {} for each number, the page that a script wrote, and what that says.
COUNTS = [
    ("README.md", "[{} mistakes on {} scenes]", "tools/oracle/suite/MISTAKES.md", "Of {} mistakes * are named first in at least one of {} scenes"),
    ("tools/oracle/SHOWN.md", "| {1} of {0} on {2} scenes, none of {3} diagnoses names a wrong one", "tools/oracle/suite/MISTAKES.md",
     "Of {} mistakes {} are named first in at least one of {} scenes*0 of {} diagnoses name another mistake"),
    ("README.md", "[{} scenes, {} algorithms, {} devices]", "tools/lab/hard_cases/RESULTS.md", "renders {} small scenes*by {} algorithms on {} devices"),
    ("README.md", "[{} captures: {} equal in every bit, {} within the bound of their suite, {} outside, {} not modelled]", "tools/lab/hardware_check/RESULTS.md",
     "Of {} captures {} are equal in every bit, {} are within the bound of their suite, and {} are outside. {} show features"),
]
NUMBER = r"(\d[\d,]*)"


def pattern_of(sentence):
    """Any white space between words; * stands for any text, {} and {2} for a number."""
    parts = [NUMBER if re.fullmatch(r"\{\d*\}", part) else ".*?" if part == "*" else r"\s+".join(map(re.escape, re.split(r"\s+", part)))
             for part in re.split(r"(\{\d*\}|\*)", sentence)]
    return re.compile("".join(parts), re.DOTALL)


def with_counts(page, text, read):
    """The page with the numbers of its sources. Fails if a sentence is missing."""
    for name, sentence, source, original in COUNTS:
        if name != page:
            continue
        found, place = pattern_of(original).search(read(source)), pattern_of(sentence).search(text)
        if not found or not place:
            sys.exit(f"{source if not found else page}: expected the sentence '{original if not found else sentence}', found none")
        numbers = [f"{int(number.replace(',', '')):,}" for number in found.groups()]
        text = text[:place.start()] + sentence.format(*numbers) + text[place.end():]
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()

    def listing(kind):
        run = [options.build / "strata", "list", kind, "--json"]
        return json.loads(subprocess.run(run, check=True, stdout=subprocess.PIPE).stdout)

    algorithms, profiles = listing("algorithms"), [p["name"] for p in listing("profiles")]
    def read(page):
        return (ROOT / page).read_text(encoding="utf-8")

    found, stale = set(), []
    for page in (*PAGES, *dict.fromkeys(page for page, *_ in COUNTS)):
        text = read(page)
        found.update(name for _, name, _, _ in MARKED.findall(text))
        made = with_counts(page, MARKED.sub(lambda m: m[1] + TABLES[m[2]](algorithms, profiles) + "\n" + m[4], text), read)
        if made == text:
            continue
        if options.check:
            stale.append(f"{page}: a table or a count is not what the program or its page of results says; run tools/docs/tables.py {options.build}")
        else:
            (ROOT / page).write_text(made, encoding="utf-8")
    stale += [f"no page has the table {name} between its markers" for name in sorted(set(TABLES) - found)]
    print("\n".join(stale) if stale else f"{len(found)} tables, {len(COUNTS)} sentences with counts")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
