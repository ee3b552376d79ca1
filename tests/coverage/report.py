#!/usr/bin/env python3
"""Reports which branches the tests take, from the output of `llvm-cov export` for each test program; called by tools/coverage.sh.

    tests/coverage/report.py EXPORT.json...         # shares of each folder, and what is missing, line by line
    tests/coverage/report.py EXPORT.json... --md    # the same into build/coverage/RESULTS.md; what is below the aim into tests/coverage/RESULTS.md

A branch is one outcome of a condition, or a case, at a position of the source. Code that is compiled in several forms (templates, kernels) counts
once, and as taken if any form takes it. Not counted are conditions that the compiler evaluates, comparisons that it generates (`= default`), and the
missing default of a switch over all values of an enum. MC/DC requires for each operand of && and || a test in which that operand alone changes the
decision; it is counted for the fragment stages and the rasterizer's rules. tests/coverage/reviewed.txt lists the remaining branches, reviewed by
hand: file | line of the source | reason.
"""
import bisect
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LIBRARIES = ("rasterizer", "pipeline", "peeling")
DECISIONS = ("pipeline/stages", "rasterizer/rules")
AIM = 0.98  # of the branches of a folder
IN_DECISION = 6  # the kind of a branch that belongs to a decision of more than one condition


def executed_at(segments, starts, place):
    """How often the source at (line, column) was executed."""
    index = bisect.bisect_right(starts, place) - 1
    return segments[index][2] if index >= 0 and segments[index][3] else 0


def is_nobodys(lines, place):
    """True for the default of a switch that lists all values, and for code that the compiler generates for `= default`."""
    line = lines[place[0] - 1]
    return line[:place[1] - 1].rstrip().endswith("switch (") or line.rstrip().endswith("= default;")


class Counts:
    """The counts of one source file, from all programs that contain it."""

    def __init__(self, name):
        self.name, self.lines = name, (ROOT / name).read_text().splitlines()
        self.sums = {}  # by the branch's position: how often taken, how often not
        self.executed, self.decisions = set(), []

    def add(self, file):
        starts = [tuple(s[:2]) for s in file["segments"]]
        for begin_line, begin, end_line, end, yes, no, *_, kind in file["branches"]:
            place = (begin_line, begin, end_line, end, kind)
            sums = self.sums.setdefault(place, [0, 0])
            sums[0] += yes
            sums[1] += no
            if executed_at(file["segments"], starts, place[:2]):
                self.executed.add(place)
        self.decisions += file["mcdc_records"]

    def is_folded(self, place):
        """True if the compiler evaluates the condition in every compiled form."""
        return self.sums[place] == [0, 0] and place in self.executed

    def branches(self):
        return {p: s for p, s in sorted(self.sums.items()) if not self.is_folded(p) and not is_nobodys(self.lines, p)}

    def conditions(self):
        """{position of a condition: whether it alone has changed its decision}."""
        places = sorted(p for p in self.sums if p[4] == IN_DECISION)
        found = {}
        for begin_line, begin, end_line, end, _, _, shown in self.decisions:
            inside = [p for p in places if (begin_line, begin) <= p[:2] and p[2:4] <= (end_line, end)]
            if len(inside) != len(shown):  # a decision inside an operand of another one
                inside = [(begin_line, begin, i, end, IN_DECISION) for i in range(len(shown))]
            for place, is_shown in zip(inside, shown):
                if place not in self.sums or not self.is_folded(place):
                    found[place] = found.get(place, False) or is_shown
        return found


def sources_of(exports):
    found = {}
    for export in exports:
        for file in json.loads(pathlib.Path(export).read_text())["data"][0]["files"]:
            path = pathlib.Path(file["filename"])
            name = str(path.resolve().relative_to(ROOT)) if path.is_absolute() else str(path)
            if name.startswith(LIBRARIES):
                found.setdefault(name, Counts(name)).add(file)
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
    known, folders, missing = reviewed(), {}, []
    unused = set(known)
    for name, source in sorted(sources_of([a for a in sys.argv[1:] if a != "--md"]).items()):
        here = folders.setdefault("/".join(name.split("/")[:-1][:2]), Tally())

        def note(place, what):
            line = source.lines[place[0] - 1].strip()
            unused.discard((name, line))
            reason = known.get((name, line))
            missing.append((name, place[0], f"{line} | {what}", reason or ""))
            return reason is not None

        for place, sums in source.branches().items():
            here.all += 2
            here.taken += sum(c > 0 for c in sums)
            if 0 in sums:
                text = source.lines[place[0] - 1][place[1] - 1:place[3] - 1] if place[0] == place[2] else "a condition of several lines"
                what = "never reached" if sums == [0, 0] else f"always {'false' if sums[0] == 0 else 'true'}"
                here.looked_at += note(place, f"{text}: {what}") * sums.count(0)
        if name.startswith(DECISIONS):
            for place, is_shown in sorted(source.conditions().items()):
                here.conditions += 1
                here.shown += is_shown
                if not is_shown:
                    here.conditions_looked_at += note(place, "alone turns no decision round")
    total = Tally()
    for tally in folders.values():
        total.add(tally)
    table = ["| folder | branches | taken | | with those looked at | conditions of decisions | MC/DC | | with those looked at |", "|---|---|---|---|---|---|---|---|---|"]
    for name, t in [*sorted(folders.items()), ("all", total)]:
        table.append(f"| {name} | {t.all} | {t.taken} | {percent(t.taken, t.all)} | {percent(t.taken + t.looked_at, t.all)} | {t.conditions or ''} | {t.shown if t.conditions else ''} | "
                     f"{percent(t.shown, t.conditions) if t.conditions else ''} | {percent(t.shown + t.conditions_looked_at, t.conditions) if t.conditions else ''} |")
    if "--md" in sys.argv:
        lines = {}
        for name, line, _, reason in missing:
            lines.setdefault((name, reason), {})[line] = None
        rows = [f"| {name} | {', '.join(map(str, sorted(found)))} | {reason} |" for (name, reason), found in sorted(lines.items())]
        whole = ROOT / "build" / "coverage" / "RESULTS.md"
        whole.parent.mkdir(parents=True, exist_ok=True)
        whole.write_text("\n".join([*table, "", "| file | lines with a branch that is not taken | looked at |", "|---|---|---|", *rows]) + "\n")
        page = ROOT / "tests" / "coverage" / "RESULTS.md"
        below = [row for row, (_, t) in zip(table[2:], sorted(folders.items())) if t.taken < AIM * t.all]
        page.write_text(page.read_text().split("| folder |")[0] + "\n".join([*table[:2], *below, table[-1]]) + "\n")
    else:
        print("\n".join([*table, "", "Not taken:", *(f"{name}:{line} | {what} | {reason}".rstrip(" |") for name, line, what, reason in sorted(missing))]))
    for file, source in sorted(unused):
        print(f"report.py: reviewed.txt: {file} | {source}: expected a branch that is not taken", file=sys.stderr)


if __name__ == "__main__":
    main()
