#!/usr/bin/env python3
"""Writes the tables of algorithms between the markers of pages, from the output of `strata list algorithms --json`.

    tools/docs/tables.py build/release            writes them
    tools/docs/tables.py build/release --check    compares them; exit status 1 and a line for each that differs

The markers of a table are `<!-- table NAME: tools/docs/tables.py -->` and `<!-- end of table -->`.
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()

    def listing(kind):
        run = [options.build / "strata", "list", kind, "--json"]
        return json.loads(subprocess.run(run, check=True, stdout=subprocess.PIPE).stdout)

    algorithms, profiles = listing("algorithms"), [p["name"] for p in listing("profiles")]
    found, stale = set(), []
    for page in PAGES:
        text = (ROOT / page).read_text(encoding="utf-8")
        found.update(name for _, name, _, _ in MARKED.findall(text))
        made = MARKED.sub(lambda m: m[1] + TABLES[m[2]](algorithms, profiles) + "\n" + m[4], text)
        if made == text:
            continue
        if options.check:
            stale.append(f"{page}: a table is not what the registry says; run tools/docs/tables.py {options.build}")
        else:
            (ROOT / page).write_text(made, encoding="utf-8")
    stale += [f"no page has the table {name} between its markers" for name in sorted(set(TABLES) - found)]
    print("\n".join(stale) if stale else f"{len(found)} tables")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
