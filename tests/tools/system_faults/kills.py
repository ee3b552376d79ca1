#!/usr/bin/env python3
"""Tests that a sweep that is killed repeatedly, started twice, or whose journal is truncated or changed loses no cell and has none twice.

    tests/tools/system_faults/kills.py build/release/strata            # 200 kills, a minute or two
    tests/tools/system_faults/kills.py build/release/strata 20 --seed 7

The sweep is killed by SIGKILL at times given by the seed. Between kills, sometimes a second sweep is started in the same folder, the journal is
truncated, a byte of it is changed, or a line is removed or duplicated. The final files must equal those of an uninterrupted sweep, and each line that
was in the journal at a kill must remain, once.
"""
import argparse
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

PLAN = {"common": {"scene": "planes:gap=64,count=4", "size": "64x48", "profile": "ideal", "algorithm": "front_to_back",
                   "alpha": 0.5, "pair": "float32:exact"},
        "grids": [{"depth_format": ["d24", "d32f", "d16"], "remedy": ["none", "bias:2", "bias:4096", "epsilon:2ulp"],
                   "near_far": ["orbit", "ratio:1000", "ratio:100000"], "subpixel_bits": [4, 8]}]}
FINISHED = ("results.jsonl", "results.csv")


def words(program):
    return [program, "invariance", "--plan", "plan.json", "-o", "out", "--threads", "1"]


def lines_of(journal):
    """The complete lines by their cell. A repeated cell is a fault."""
    text = journal.read_bytes() if journal.exists() else b""
    found, doubled = {}, 0
    for line in text.split(b"\n")[:-1]:
        try:
            cell = json.loads(line)["cell"]
        except (ValueError, KeyError, TypeError):
            continue
        doubled += cell in found
        found[cell] = line
    return found, doubled


class Trial:
    def __init__(self, program, seed, folder):
        self.program, self.random, self.folder = program, random.Random(seed), folder
        self.counts = dict.fromkeys(("kills", "second runs", "torn journals", "changed journals", "sweeps finished", "cells", "lost", "doubled", "bad"), 0)
        (folder / "plan.json").write_text(json.dumps(PLAN))
        self.journal = folder / "out" / "results.jsonl"
        started = time.monotonic()
        self.whole = self.finish()
        self.seconds = time.monotonic() - started
        self.fresh()

    def fresh(self):
        subprocess.run(["rm", "-rf", str(self.folder / "out")], check=True)
        self.kept = {}

    def start(self):
        return subprocess.Popen(words(self.program), cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def finish(self):
        run = self.start()
        _, told = run.communicate()
        if run.returncode != 0:
            self.bad(f"status {run.returncode}: {told}")
        return {path.relative_to(self.folder).as_posix(): path.read_bytes()
                for path in sorted((self.folder / "out").rglob("*"))
                if path.is_file() and not path.name.startswith("timings")}

    def bad(self, what):
        self.counts["bad"] += 1
        print(what)

    def second(self):
        """Starts a second sweep while the first holds the folder; if the first has not started yet, that one must report the other."""
        self.counts["second runs"] += 1
        run = self.start()
        _, told = run.communicate()
        if run.returncode not in (0, 2) or (run.returncode == 2 and "no other run writes to" not in told):
            self.bad(f"a second run: status {run.returncode}: {told}")
        return run.returncode == 0

    def check_kept(self):
        lines, doubled = lines_of(self.journal)
        self.counts["doubled"] += doubled
        self.counts["lost"] += sum(lines.get(cell) != line for cell, line in self.kept.items())
        self.kept = lines

    def kill(self):
        run = self.start()
        time.sleep(self.random.random() * self.seconds * 0.5)
        if self.random.random() < 0.2:
            self.second()
        if run.poll() is None:
            run.send_signal(signal.SIGKILL)
        run.communicate()
        if run.returncode == -signal.SIGKILL:
            self.counts["kills"] += 1
        self.check_kept()
        return run.returncode

    def spoil(self):
        """Truncates or changes the journal. Incomplete lines must be measured again; all others remain."""
        text = self.journal.read_bytes() if self.journal.exists() else b""
        chance = self.random.random()
        if not text or chance > 0.3:
            return
        place = self.random.randrange(len(text))
        if chance < 0.1:
            self.counts["torn journals"] += 1
            text = text[:place]
        elif chance < 0.2:
            self.counts["changed journals"] += 1
            text = text[:place] + bytes([text[place] ^ (1 << self.random.randrange(8))]) + text[place + 1:]
        else:
            self.counts["changed journals"] += 1
            lines = text.split(b"\n")[:-1] or [b""]
            one = self.random.randrange(len(lines))
            lines[one:one + 1] = self.random.choice(([], [lines[one], lines[one]], [b"\0" * len(lines[one])]))
            text = b"".join(line + b"\n" for line in lines)
        before = self.kept
        self.journal.write_bytes(text)
        left = set(text.split(b"\n")[:-1])
        self.kept = {cell: line for cell, line in before.items() if line in left}

    def compare(self):
        """A finished sweep has exactly the files of the uninterrupted one."""
        found = self.finish()
        self.counts["sweeps finished"] += 1
        lines, doubled = lines_of(self.journal)
        expected = [json.loads(line)["cell"] for line in self.whole["out/results.jsonl"].split(b"\n")[:-1]]
        self.counts["cells"] += len(expected)
        self.counts["lost"] += len(set(expected) - set(lines))
        self.counts["doubled"] += doubled
        if found != self.whole:
            self.bad(f"other files: {sorted(name for name in found.keys() | self.whole if found.get(name) != self.whole.get(name))}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("strata")
    parser.add_argument("kills", type=int, nargs="?", default=200)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        trial = Trial(str(pathlib.Path(asked.strata).resolve()), asked.seed, pathlib.Path(folder))
        since = 0
        while trial.counts["kills"] < asked.kills:
            ended = trial.kill()
            since += 1
            if ended == 0 or since == 15:
                trial.compare()
                trial.fresh()
                since = 0
            elif ended != -signal.SIGKILL and ended != 2:
                trial.bad(f"a run ended with {ended}")
            else:
                trial.spoil()
        trial.compare()
    print(", ".join(f"{count} {name}" for name, count in trial.counts.items()))
    sys.exit(1 if trial.counts["lost"] + trial.counts["doubled"] + trial.counts["bad"] else 0)


if __name__ == "__main__":
    main()
