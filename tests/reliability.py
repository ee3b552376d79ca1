#!/usr/bin/env python3
"""Makes tests/RELIABILITY.md: what is promised, how it was tried, how often, what was found, and what is not promised.

    tests/reliability.py build/release        # runs what counts, some minutes on a free machine, and writes the page

A figure on the page comes from the command beside it; where a command finds a fault, nothing is written.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# promise, command (BUILD is the build folder), figures in its output, the sentence with them, what was found by it
ROWS = [
    ("nonsense is refused by one sentence and status 2, and leaves no file",
     "tests/tools/nonsense/nonsense.py BUILD/strata",
     r"(\d+) cases of nonsense, (\d+) places; 0 ", "{0} values in {1} options, scene parameters and fields",
     "flags took values; sentences held line ends and bytes that are no UTF-8; a plan's text could be an object; names held zero bytes"),
    ("where memory runs out while a scene is made, the caller is told, nothing leaks, and the next call is whole",
     "BUILD/tests/faults/allocation_faults --load --all",
     r"(\d+) jobs, (\d+) requests failed, 0 bad", "{1} requests of {0} jobs",
     "nothing in scenes; in frames, see below"),
    ("whichever call of the system fails, files are old or new, and a sentence tells",
     "BUILD/tests/tools/tools_test 'whichever call of the system*,a sweep whose calls*'",
     r"All tests passed \((\d+) assertions", "every call of open, write, fsync and rename of eight commands, of files also close",
     "outputs without fsync; temporary files that stayed"),
    ("the thread sanitizer's build (preset `tsan`) tells a race in a parallel loop, and nothing where there is none",
     "BUILD/tests/faults/race own",
     r"(4)", "four threads with places of their own; with one place for all `race shared` is told",
     "nothing"),
]

NOT_PROMISED = [
    "Memory that runs out while a frame is drawn: where a region's scratch memory goes back to its pool the process may end.",
    "Memory that runs out while JSON is read or written: at two points the process ended, one in profiles and one in cameras; why is not traced.",
    "A host's allocator that promises memory which the machine has not (Linux by default): the system ends the process.",
    "32-bit processors, and compilers without 128-bit integers.",
    "SIGKILL and a loss of power between two lines of a sweep: the line that was being written is measured again.",
]


def figures_of(command, pattern, build):
    words = command.replace("BUILD", str(build))
    ended = subprocess.run(["bash", "-c", words], cwd=ROOT, capture_output=True, text=True)
    found = re.search(pattern, ended.stdout)
    if ended.returncode != 0 or not found:
        sys.exit(f"reliability.py: {words}: status {ended.returncode}:\n{ended.stdout[-2000:]}{ended.stderr[-500:]}")
    return [f"{int(n):,}" for n in found.groups()]


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: tests/reliability.py BUILD_FOLDER")
    lines = ["# What is promised, and how it was tried", "",
             "Made by `tests/reliability.py build/release`: every figure is what the command beside it printed, with no fault.", "",
             "| promise | tried | by | found on the way |", "|---|---|---|---|"]
    for promise, command, pattern, sentence, found in ROWS:
        figures = figures_of(command, pattern, sys.argv[1])
        lines.append(f"| {promise} | {sentence.format(*figures)} | `{command.replace('BUILD', 'build/release')}` | {found} |")
    lines += ["", "Not promised:", ""] + [f"- {line}" for line in NOT_PROMISED]
    lines += ["", "Whether the tests would see a fault is another question: `tools/mutate.py` puts changes of one step into the sources,",
              "and [README.md](README.md) says how."]
    (ROOT / "tests" / "RELIABILITY.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
