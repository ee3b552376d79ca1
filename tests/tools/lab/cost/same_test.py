#!/usr/bin/env python3
"""Tests tools/lab/cost/same.py, which decides whether two runs of `strata cost` agree, on invented runs with known changes.

usage: same_test.py SAME_PY

Exit status 1 and one line per wrong decision.
"""
import json
import os
import subprocess
import sys
import tempfile

CELLS = 40
faults = []


def time(median, least, greatest):
    return {"median": median, "least": least, "greatest": greatest, "rounds": 5}


def write_run(folder, error=0.5, times=()):
    """A run of CELLS cells, each with the time 2 (1.5 to 2.5) by default and in literal execution, except those in `times`: {cell: time}; chain cells
    have none."""
    os.makedirs(folder)
    cells = [{"cell": i, "scene": "s", "knob": "k", "value": f"v{i}", "rmse": error if i == 7 else 1.0} for i in range(CELLS)]
    with open(os.path.join(folder, "results.jsonl"), "w", encoding="utf-8") as file:
        file.writelines(json.dumps(cell) + "\n" for cell in cells)
    with open(os.path.join(folder, "results.csv"), "w", encoding="utf-8") as file:
        file.writelines(f"{cell['cell']},{cell['rmse']}\n" for cell in cells)
    changed = dict(times)
    with open(os.path.join(folder, "timings.jsonl"), "w", encoding="utf-8") as file:
        for i in range(CELLS):
            usual = time(2, 1.5, 2.5)
            drawn = {"default": changed.get(i, usual), "literal": usual} if i > 0 else {"default": None, "literal": None}
            file.write(json.dumps({"cell": i, "seconds": None, **drawn}) + "\n")


def expect(name, first, second, status, sentence, stream="stdout"):
    with tempfile.TemporaryDirectory() as folder:
        folders = [os.path.join(folder, which) for which in ("one", "two")]
        for path, run in zip(folders, (first, second)):
            if run is not None:
                write_run(path, **run)
        ended = subprocess.run([sys.executable, "-B", sys.argv[1], *folders], capture_output=True, text=True, check=False)
        if ended.returncode != status or sentence not in getattr(ended, stream):
            faults.append(f"{name}: expected status {status} and '{sentence}', found {ended.returncode}:\n{ended.stdout}{ended.stderr}")


def main():
    all_agree = f"default times: {CELLS - 1} of {CELLS - 1} cells agree, 100.0 %"
    expect("a run beside itself is the same", {}, {}, 0, all_agree)
    expect("another error in one cell is found", {}, {"error": 0.25}, 1, "they differ")
    expect("medians as far apart as the wider spread agree", {}, {"times": {3: time(3, 2.9, 3.1)}}, 0, all_agree)
    expect("a median beyond both spreads is told", {}, {"times": {3: time(3.125, 3, 3.25)}}, 0,
           "s: k v3: 2.000 (1.500 to 2.500) and 3.125 (3.000 to 3.250)")
    expect("one of 39 cells apart is few enough", {}, {"times": {3: time(9, 9, 9)}}, 0, "38 of 39 cells agree, 97.4 %")
    expect("two of 39 cells apart are too many", {}, {"times": {3: time(9, 9, 9), 4: time(9, 9, 9)}}, 1,
           "37 of 39 cells agree, 94.9 %")
    expect("runs without a time are not called the same", {"times": {i: None for i in range(CELLS)}},
           {"times": {i: None for i in range(CELLS)}}, 1, "default times: no cell has one in both runs")
    expect("a folder without a run is named", {}, None, 2, "expected a file of a finished run of strata cost, found none", "stderr")
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
