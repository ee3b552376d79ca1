#!/usr/bin/env python3
"""Compares two results of `strata cost`: errors and counts must have the same bytes, and times must agree within their spread.

usage: same.py FOLDER FOLDER

A time is a cell's median ratio to the default cell, by default and literally, from timings.jsonl. Two times agree if they differ by at most the
larger of the two spreads (greatest minus least round). Exit status 1: bytes differ, or fewer than 95 % agree; 2: a folder has no finished results.
"""
import json
import os
import sys

ENOUGH = 0.95
COLUMNS = ("default", "literal")


def lines_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def bytes_of(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def timings_of(folder):
    """Timings by cell."""
    return {line["cell"]: line for line in lines_of(folder, "timings.jsonl")}


def is_alike(folders):
    return all(len({bytes_of(folder, name) for folder in folders}) == 1 for name in ("results.jsonl", "results.csv"))


def agree(first, second):
    spread = max(time["greatest"] - time["least"] for time in (first, second))
    return abs(first["median"] - second["median"]) <= spread


def compared(folders, column):
    """The cells that both results have timed, and those of them whose times do not agree."""
    first, second = (timings_of(folder) for folder in folders)
    timed = [cell for cell in sorted(first) if cell in second and first[cell][column] and second[cell][column]]
    apart = [cell for cell in timed if not agree(first[cell][column], second[cell][column])]
    return timed, apart


def print_column(folders, column):
    """Prints the agreement of a column; returns whether enough times agree."""
    timed, apart = compared(folders, column)
    if not timed:
        print(f"{column} times: no cell has one in both runs")
        return False
    share = 1 - len(apart) / len(timed)
    print(f"{column} times: {len(timed) - len(apart)} of {len(timed)} cells agree, {100 * share:.1f} %")
    cells = {line["cell"]: line for line in lines_of(folders[0], "results.jsonl")}
    for cell in apart:
        times = [timings_of(folder)[cell][column] for folder in folders]
        told = " and ".join(f"{t['median']:.3f} ({t['least']:.3f} to {t['greatest']:.3f})" for t in times)
        print(f"  {cells[cell]['scene']}: {cells[cell]['knob']} {cells[cell]['value']}: {told}")
    return share >= ENOUGH


def main():
    if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.strip())
    folders = sys.argv[1:]
    for path in (os.path.join(folder, name) for folder in folders for name in ("results.jsonl", "results.csv", "timings.jsonl")):
        if not os.path.exists(path):
            print(f"same.py: {path}: expected a file of a finished run of strata cost, found none", file=sys.stderr)
            sys.exit(2)
    alike = is_alike(folders)
    print("errors and counts: " + ("the same bytes" if alike else "they differ"))
    if not alike:
        sys.exit(1)
    sys.exit(0 if all([print_column(folders, column) for column in COLUMNS]) else 1)


if __name__ == "__main__":
    main()
