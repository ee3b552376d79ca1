#!/usr/bin/env python3
"""Compares two runs of `strata cost`: errors and counts have to be the same bytes, times the same but for their spread.

usage: same.py FOLDER FOLDER

A time is a cell's median ratio to the default cell, by default and literally, as timings.jsonl has them. Two times agree if they differ
by no more than the larger of the two spreads (greatest less least round). Exit status 1: bytes differ, or fewer than 95 % agree.
"""
import json
import os
import sys


def lines_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def bytes_of(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def timings_of(folder):
    """By cell; of several timings of one the last counts, as in cost.csv."""
    return {line["cell"]: line for line in lines_of(folder, "timings.jsonl")}


def agree(first, second):
    spread = max(time["greatest"] - time["least"] for time in (first, second))
    return abs(first["median"] - second["median"]) <= spread


def main():
    if len(sys.argv) != 3 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.strip())
    folders = sys.argv[1:]
    alike = all(len({bytes_of(folder, name) for folder in folders}) == 1 for name in ("results.jsonl", "results.csv"))
    print("errors and counts: " + ("the same bytes" if alike else "they differ"))
    if not alike:
        sys.exit(1)
    cells = {line["cell"]: line for line in lines_of(folders[0], "results.jsonl")}
    first, second = (timings_of(folder) for folder in folders)
    enough = True
    for column in ("default", "literal"):
        timed = [cell for cell in cells if first[cell][column] and second[cell][column]]
        apart = [cell for cell in timed if not agree(first[cell][column], second[cell][column])]
        share = 1 - len(apart) / len(timed)
        enough = enough and share >= 0.95
        print(f"{column} times: {len(timed) - len(apart)} of {len(timed)} cells agree, {100 * share:.1f} %")
        for cell in apart:
            times = [timings[cell][column] for timings in (first, second)]
            told = " and ".join(f"{t['median']:.3f} ({t['least']:.3f} to {t['greatest']:.3f})" for t in times)
            print(f"  {cells[cell]['scene']}: {cells[cell]['knob']} {cells[cell]['value']}: {told}")
    sys.exit(0 if enough else 1)


if __name__ == "__main__":
    main()
