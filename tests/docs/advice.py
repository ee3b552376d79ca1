"""Holds the advice of tools/lab/cost/transparency/TRANSPARENCY.md to the table above it, and renders a picture by each algorithm that it names.

    tests/docs/advice.py build/release

Each line says "With LIMITS: `ALGORITHM AND OPTIONS`, mean error E." The algorithm must have a row within the limits, no other row within them may have
a lower geometric mean, and E must be that mean. Exit status 1 and a line for each fault.
"""
import math
import os
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent.parent / "tools/lab/cost/transparency/TRANSPARENCY.md"
NUMBERS = {"one": 1, "two": 2}
UNORDERED = {"linked_list", "linked_list --pixel-nodes 8", "atomic_loop", "hybrid_transparency", "multi_layer", "adaptive", "moments_quantized"}


def rows_of(text):
    """By algorithm: the errors of the scenes, bytes a pixel, passes."""
    lines = [[cell.strip() for cell in line.strip("|\n ").split("|")] for line in text.splitlines() if line.startswith("| ")]
    head, body = lines[0], lines[2:]
    scenes = head.index("bytes a pixel") - 1
    return {cells[0].strip("`"): ([float(c) for c in cells[1:1 + scenes]], float(cells[1 + scenes]), int(cells[2 + scenes])) for cells in body}


def limits_of(words):
    """Most bytes, most passes, and what the words exclude."""
    if words == "lists of any length":
        return math.inf, math.inf, ()
    if words == "blending alone":
        return math.inf, math.inf, UNORDERED
    passes, size = re.fullmatch(r"(\w+) pass(?:es)? and (\d+) bytes a pixel", words).groups()
    return int(size), NUMBERS[passes], ("linked_list",)


def mean(errors):
    return math.exp(sum(map(math.log, errors)) / len(errors))


def main():
    program = os.path.join(os.path.abspath(sys.argv[1]), "strata")
    if not os.access(program, os.X_OK):
        print(f"SKIPPED: no program {program}")
        return 77
    text, wrong = PAGE.read_text(encoding="utf-8"), []
    rows = rows_of(text)
    lines = re.findall(r"^- With (.+): `(.+)`, mean error ([\d.]+)\.$", text, re.MULTILINE)
    if len(lines) < 4:
        wrong.append(f"{PAGE}: expected at least 4 lines of advice, found {len(lines)}")
    for words, algorithm, printed in lines:
        most_bytes, most_passes, without = limits_of(words)
        able = {name: mean(errors) for name, (errors, size, passes) in rows.items()
                if size <= most_bytes and passes <= most_passes and name not in without}
        if algorithm not in able:
            wrong.append(f"{words}: `{algorithm}` is not within the limits, or has no row")
        elif able[algorithm] > min(able.values()) + 0.001:
            wrong.append(f"{words}: expected {min(able, key=able.get)} with {min(able.values()):.3g}, found {algorithm} with {able[algorithm]:.3g}")
        elif f"{able[algorithm]:.3g}" != printed:
            wrong.append(f"{words}: expected mean error {able[algorithm]:.3g}, found {printed}")
        done = subprocess.run([program, "render", "planes", "--size", "16x16", "--profile", "ideal", "-q", "--algorithm", *algorithm.split()],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            wrong.append(f"{words}: --algorithm {algorithm}: exit status {done.returncode}: {done.stderr.strip()}")
    print("\n".join(wrong) if wrong else f"{len(lines)} lines of advice hold")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
