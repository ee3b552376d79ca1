#!/usr/bin/env python3
"""Prints a table of pictures whose truth is known and of the first lines of `compare` and `diagnose` about them.

    first_lines.py --build build/release [--cases FOLDER] [--every N] [--sample N --seed S] [-o FILE.md]

The pictures: those that the program draws with a mistake of its catalogue, on the first scene of the suite that shows it (--every N takes every Nth
mistake); right pictures of every profile; and, with --cases, those of first_lines.json, whose truth is stated there as texts that the first lines
must or must not contain. A first line is false if it calls a right picture wrong, or a wrong one right although a pixel is off by more than 5 codes, or if
it names another mistake. Exit status 1 if one is false, or if compare and diagnose contradict each other.

--sample N takes N pictures by --seed. With -o rows are appended as they end, and a later call does not judge the pictures again whose rows FILE.md has.
"""
import argparse
import concurrent.futures
import json
import pathlib
import random
import re
import shlex
import subprocess
import sys
import tempfile

# Mistakes that only decide ties of depth or of edges, where right ports differ: a verdict may call them right.
OPEN = {"ties_of_rows", "ties_of_columns", "order_reversed", "last_of_equals", "snapped_otherwise", "snapped_to_256ths", "snapped_to_16ths"}
MOST_CODES = 5  # a picture that is off by no more may be right by rounding
LONG = re.compile(r"^wrong: one of \d+ mistakes")


def run(words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def first(text):
    """The first line; of several mistakes that look the same, their names too."""
    lines = text.split("\n")
    if LONG.match(lines[0]):
        return lines[0] + ": " + "; ".join(line.strip() for line in lines[1:] if line.startswith("  ") and line[2] not in " " and not line.startswith("  acc"))[:400]
    return lines[0]


class Row:
    """A picture: the words of its scene, its file, what is true of it, and the further words of each command."""
    def __init__(self, name, scene, picture, truth, words=(), algorithm="dual"):
        self.name, self.scene, self.picture, self.truth, self.words, self.algorithm = name, scene, picture, truth, list(words), algorithm

    def said(self, strata):
        found = {}
        for command in ("compare", "diagnose"):
            status, out, err = run([strata, command, self.scene, self.picture, *self.words, "--algorithm", self.algorithm])
            found[command] = (status, first(out or err), out)
        return found


def is_right_line(line):
    return line.startswith("right") or line == "equal"


def faults(row, said):
    """What is false in the first lines."""
    right = {command: is_right_line(line) for command, (_, line, _) in said.items()}
    truth, wrong = row.truth, []
    for command, (status, line, out) in said.items():
        if status not in (0, 1):
            wrong.append(f"{command}: exit status {status}")
            continue
        if (status == 0) != right[command]:
            wrong.append(f"{command}: exit status {status} with this line")
        if truth["kind"] == "right" and not right[command] and not line.startswith("not decided"):
            wrong.append(f"{command} calls a right picture wrong")
        if truth["kind"] == "wrong" and right[command] and truth.get("codes", 255) > MOST_CODES:
            wrong.append(f"{command} calls a wrong picture right")
        if truth["kind"] == "wrong" and command == "diagnose" and truth.get("name") and line.startswith("wrong: every pixel") and f"({truth['name']})" not in out:
            wrong.append("diagnose names another mistake")
        for text in truth.get(f"{command}_says", []):
            if text not in line:
                wrong.append(f"{command} does not say: {text}")
        for text in truth.get("never", []):
            if text in line:
                wrong.append(f"{command} says: {text}")
    if right["compare"] != right["diagnose"]:
        wrong.append("compare and diagnose contradict each other")
    return wrong


def of_catalogue(strata, folder, every):
    """A row for every Nth mistake, on the first scene of the suite that shows it."""
    _, out, _ = run([strata, "diagnose", "--list", "--json"])
    names = [mistake["name"] for mistake in json.loads(out)][::every]
    _, out, _ = run([strata, "diagnose", "--list", "--suite", "--json"])
    scenes = [shlex.split(scene["command"])[2:] for scene in json.loads(out)]
    rights = {}
    for name in names:
        for number, words in enumerate(scenes):
            right = folder / f"right.{number}.png"
            if number not in rights:
                rights[number] = run([strata, "render", *words, "--no-audit", "-q", "-o", right])[0] == 0
            picture = folder / f"{name}.png"
            if not rights[number] or run([strata, "render", *words, "--no-audit", "-q", "--mistake", name, "-o", picture])[0] != 0:
                continue
            if run([strata, "compare", right, picture, "--tolerance", f"color={MOST_CODES}"])[0] == 0:
                continue
            at = words.index("--algorithm")
            algorithm, rest = words[at + 1], words[1:at] + words[at + 2:]
            while "--size" in rest:
                del rest[rest.index("--size"):rest.index("--size") + 2]
            yield Row(f"catalogue: {name}", words[0], picture, {"kind": "open" if name in OPEN else "wrong", "name": name}, rest, algorithm)
            break


def of_profiles(strata, folder):
    """Right pictures of every profile, judged by every other that has the features."""
    _, out, _ = run([strata, "list", "profiles", "--json"])
    for profile in (found["name"] for found in json.loads(out)):
        for scene in ("teapot", "random:seed=11,triangles=40"):
            picture = folder / f"{profile}.{scene.split(':')[0]}.png"
            if run([strata, "render", scene, "--size", "64x48", "--profile", profile, "--algorithm", "front_to_back", "--no-audit", "-q", "-o", picture])[0] == 0:
                yield Row(f"right: {profile}, {scene}", scene, picture, {"kind": "right"}, ["--profile", profile], "front_to_back")


def of_cases(folder):
    """Rows of first_lines.json, whose files are in the folder."""
    for case in json.loads((pathlib.Path(__file__).parent / "first_lines.json").read_text()):
        place = folder / case["folder"]
        if not place.is_dir():
            continue
        words = [str(place / word[1:]) if word.startswith("@") else word for word in case.get("words", [])]
        scene = str(place / case["scene"][1:]) if case["scene"].startswith("@") else case["scene"]
        yield Row(f"case: {case['folder']}/{case['picture']}", scene, place / case["picture"], case["truth"], words, case.get("algorithm", "dual"))


class Table:
    """Rows of a Markdown table, written at once to the file, or to standard output. Rows that the file has are kept."""
    HEAD = "| picture | truth | compare | diagnose | false |\n|---|---|---|---|---|\n"

    def __init__(self, file):
        self.names, self.wrong, self.file = set(), 0, file
        if file and file.is_file():
            for line in file.read_text().splitlines()[2:]:
                cells = line.strip("| ").split(" | ")
                self.names.add(cells[0])
                self.wrong += not line.endswith("|  |")
        else:
            self.write(self.HEAD)

    def write(self, text):
        if not self.file:
            return print(text, end="", flush=True)
        with self.file.open("a") as out:
            out.write(text)

    def add(self, row, said):
        found = faults(row, said)
        self.names.add(row.name)
        self.wrong += bool(found)
        truth = row.truth.get("is", row.truth.get("name", row.truth["kind"]))
        cells = (row.name, truth, said["compare"][1], said["diagnose"][1], "; ".join(found))
        self.write("| " + " | ".join(cell.replace("|", "/") for cell in cells) + " |\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--cases", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--sample", type=int, metavar="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    options = parser.parse_args()
    strata = (options.build / "strata").resolve()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        rows = [*of_profiles(strata, folder), *of_catalogue(strata, folder, options.every)]
        if options.cases:
            rows += of_cases(options.cases.resolve())
        if options.sample:
            rows = random.Random(options.seed).sample(rows, min(options.sample, len(rows)))
        table = Table(options.output)
        rows = [row for row in rows if row.name not in table.names]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for done in concurrent.futures.as_completed([pool.submit(lambda row=row: (row, row.said(strata))) for row in rows]):
                table.add(*done.result())
    print(f"{len(table.names)} pictures, {table.wrong} with a false first line")
    return 1 if table.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
