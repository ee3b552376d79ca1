#!/usr/bin/env python3
"""Which branches the tests take, from what `llvm-cov export` says: tools/coverage.sh calls it.

    tests/coverage/report.py EXPORT.json            # shares of each folder, and what is missing, line by line
    tests/coverage/report.py EXPORT.json --md       # the same into tests/coverage/RESULTS.md

A branch is one side of a condition or a case. It stands at a place of the source: what is compiled in several forms (templates,
kernels) counts once, and as taken if any form takes it. Left out are conditions that the compiler decides, and the default that a
switch over all values of an enum has not. MC/DC asks of each operand of && and || that it alone has turned a decision round; it
is counted for the decisions of the fragment stages and of the rasterizer's rules. tests/coverage/reviewed.txt has the rest that
somebody looked at: file | line of the source | reason.
"""
import bisect
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FLOORS = ("rasterizer", "pipeline", "peeling")
DECISIONS = ("pipeline/stages", "rasterizer/rules")
IN_DECISION = 6  # the kind of a branch that belongs to a decision of more than one condition


def executed_at(segments, starts, place):
    """How often the source at (line, column) was run."""
    index = bisect.bisect_right(starts, place) - 1
    return segments[index][2] if index >= 0 and segments[index][3] else 0


def is_default_of_switch(lines, place):
    return lines[place[0] - 1][:place[1] - 1].rstrip().endswith("switch (")


def branches_of(file, lines):
    """{place: [taken, not taken]}, and the places that no form of the source decides at run time."""
    starts = [tuple(s[:2]) for s in file["segments"]]
    counts = {}
    for begin_line, begin, end_line, end, yes, no, *_ in file["branches"]:
        sums = counts.setdefault((begin_line, begin, end_line, end), [0, 0])
        sums[0] += yes
        sums[1] += no
    folded = {p for p, sums in counts.items() if sums == [0, 0] and executed_at(file["segments"], starts, p[:2])}
    return {p: s for p, s in counts.items() if p not in folded and not is_default_of_switch(lines, p)}, folded


def conditions_of(file, folded):
    """{place of a condition: whether it alone turned its decision round}."""
    places = sorted({tuple(b[:4]) for b in file["branches"] if b[8] == IN_DECISION})
    found = {}
    for begin_line, begin, end_line, end, _, _, shown in file["mcdc_records"]:
        inside = [p for p in places if (begin_line, begin) <= p[:2] and p[2:] <= (end_line, end)]
        if len(inside) != len(shown):  # a decision within an operand of another
            inside = [(begin_line, begin, i, end) for i in range(len(shown))]
        for place, is_shown in zip(inside, shown):
            if place not in folded:
                found[place] = found.get(place, False) or is_shown
    return found


def reviewed():
    path = ROOT / "tests" / "coverage" / "reviewed.txt"
    rows = (line.split(" | ") for line in path.read_text().splitlines() if line and not line.startswith("#"))
    return {(file, source): reason for file, source, reason in rows}


def percent(part, whole):
    return f"{100 * part / whole:.2f} %" if whole else "-"


class Tally:
    def __init__(self):
        self.taken = self.all = self.looked_at = self.shown = self.conditions = self.conditions_looked_at = 0

    def add(self, other):
        for key, value in vars(other).items():
            setattr(self, key, getattr(self, key) + value)


def main():
    data = json.loads(pathlib.Path(sys.argv[1]).read_text())["data"][0]
    known, folders, missing, unused = reviewed(), {}, [], None
    unused = set(known)
    for file in data["files"]:
        path = pathlib.Path(file["filename"])
        name = str(path.resolve().relative_to(ROOT)) if path.is_absolute() else str(path)
        if not name.startswith(FLOORS):
            continue
        lines = (ROOT / name).read_text().splitlines()
        here = folders.setdefault("/".join(name.split("/")[:2]), Tally())
        counts, folded = branches_of(file, lines)

        def note(line, what):
            source = lines[line - 1].strip()
            unused.discard((name, source))
            reason = known.get((name, source))
            missing.append(f"{name}:{line} | {source} | {what}" + (f" | {reason}" if reason else ""))
            return reason is not None

        for place, sums in sorted(counts.items()):
            here.all += 2
            here.taken += sum(c > 0 for c in sums)
            if 0 in sums:
                text = lines[place[0] - 1][place[1] - 1:place[3] - 1] if place[0] == place[2] else "a condition of several lines"
                what = "never reached" if sums == [0, 0] else f"always {'false' if sums[0] == 0 else 'true'}"
                here.looked_at += note(place[0], f"{text}: {what}") * sums.count(0)
        if name.startswith(DECISIONS):
            for place, is_shown in sorted(conditions_of(file, folded).items()):
                here.conditions += 1
                here.shown += is_shown
                if not is_shown:
                    here.conditions_looked_at += note(place[0], "alone turns no decision round")
    total = Tally()
    for tally in folders.values():
        total.add(tally)
    table = ["| folder | branches | taken | | with those looked at | conditions of decisions | MC/DC | | with those looked at |", "|---|---|---|---|---|---|---|---|---|"]
    for name, t in [*sorted(folders.items()), ("all", total)]:
        table.append(f"| {name} | {t.all} | {t.taken} | {percent(t.taken, t.all)} | {percent(t.taken + t.looked_at, t.all)} | {t.conditions or ''} | {t.shown if t.conditions else ''} | "
                     f"{percent(t.shown, t.conditions) if t.conditions else ''} | {percent(t.shown + t.conditions_looked_at, t.conditions) if t.conditions else ''} |")
    page = "\n".join(table) + "\n\nNot taken:\n\n" + "\n".join("    " + m for m in sorted(missing)) + "\n"
    if "--md" in sys.argv:
        target = ROOT / "tests" / "coverage" / "RESULTS.md"
        target.write_text(target.read_text().split("| folder |")[0] + page)
    else:
        print(page)
    for file, source in sorted(unused):
        print(f"report.py: reviewed.txt: {file} | {source}: expected a branch that is not taken", file=sys.stderr)


if __name__ == "__main__":
    main()
