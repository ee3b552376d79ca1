#!/usr/bin/env python3
"""Makes tests/RELIABILITY.md: what is promised, how it was tried, how often, what was found, and what is not promised.

    tools/test.sh --instrumented              # the builds under sanitizers
    tests/reliability.py build/release        # runs what counts, some minutes on a free machine, and writes the page

A figure on the page comes from the command beside it; where a command finds a fault, nothing is written. What a command printed is
kept in BUILD_FOLDER/reliability, so that a second call goes on where the first ended: `tests/reliability.py build/release limits kills`
tries the rows anew whose command has one of these words and leaves all others as the page has them.
"""
import hashlib
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
     r"(\d+) jobs, (\d+) requests failed, 0 bad", "{1} requests of {0} jobs", "nothing"),
    ("and where it runs out while a frame is drawn, by every algorithm and execution",
     "BUILD/tests/faults/allocation_faults --render",
     r"(\d+) jobs, (\d+) requests failed, 0 bad", "{1} requests of {0} jobs; `--all` tries each of the first 2,000 of a job",
     "a destructor and a search that could not throw asked for memory, which ended the process"),
    ("whichever call of the system fails, files are old or new, and a sentence tells",
     "BUILD/tests/tools/tools_test 'each single call of the system*,a sweep goes on after each single*'",
     r"(\d+) calls failed", "{0} calls of open, write, fsync, rename and close, every one of nine commands and three sweeps",
     "outputs without fsync; temporary files that stayed"),
    ("however few threads and bytes the kernel grants, a picture is whole or one sentence says what is missing",
     "python3 tests/tools/system_faults/limits.py BUILD/strata --all",
     r"(\d+) limits of threads and address space: (\d+) whole pictures, (\d+) sentences, 0 bad",
     "{0} limits: {1} whole pictures, {2} sentences", "hangs and aborts in libraries that start threads as they are loaded, or run out of addresses there"),
    ("a sweep that is killed, started twice, torn or changed loses no cell and doubles none",
     "python3 tests/tools/system_faults/kills.py BUILD/strata",
     r"(\d+) kills, (\d+) second runs, (\d+) torn journals, (\d+) changed journals, (\d+) sweeps finished, (\d+) cells, 0 lost, 0 doubled, 0 bad",
     "{0} kills, {1} second runs, {2} torn and {3} changed journals: {5} cells of {4} finished sweeps",
     "a journal that a killed run had left out of order, or torn behind its last cell, stayed so"),
    ("what a picture takes is told beforehand, within a quarter of the measured peak",
     "BUILD/tests/tools/tools_test 'what a picture will take*'",
     r"(\d+) pictures: memory told within (\d+) %", "{0} pictures, within {1} %", "nothing"),
    ("what people hand to the program is refused in a sentence or keeps its promise: profiles, cameras, plans, packs, EXR files, sequences of calls, glTF",
     "ctest --test-dir BUILD -R fuzz-kept-inputs -V",
     r"\w+: (\d+) inputs, 0 bad", "{0} kept inputs of what `tools/fuzz.sh` found",
     "an EXR of a kilobyte makes OpenEXR ask for 2 GB, which it never touches"),
    ("a second engine, which chooses its inputs by other means, finds no fault either",
     "for t in calls gltf profile; do tools/fuzz.sh --afl $t 1200; done",
     r"\w+: (\d+) inputs in (\d+) s by AFL\+\+, (\d+) new paths, 0 crashes, 0 hangs",
     "{0} inputs in {1} s by AFL++ on sequences of calls, glTF and profiles; {2} reached something new", "nothing"),
    ("malformed models are refused where the Khronos validator refuses them, or the page of differences says why not",
     "python3 tests/scenes/validator/validator.py BUILD/strata",
     r"(\d+) files: (\d+) refused by both \((\d+) with the same code\), (\d+) sound to both, (\d+) differ, 0 end otherwise",
     "{0} files: {1} refused by both, {2} of them with the same code; {3} sound to both, {4} differ ([why](scenes/validator/README.md))", "nothing that crashed"),
    ("the thread sanitizer's build (preset `tsan`) tells a race in a parallel loop, and nothing where there is none",
     "BUILD/tests/faults/race own",
     r"(4)", "four threads with places of their own; with one place for all `race shared` is told",
     "nothing"),
    ("no two threads of a loop touch the same place without order",
     "build/tsan/tests/golden/core_digests threads=4 tile=8 check=tests/golden/core_digests.txt && "
     "build/tsan/tests/fuzz/differential_seeds --seeds 0..2000 --threads 4",
     r"0 of (\d+) lines differ\n(\d+) frames: every way alike", "{0} lines of golden digests and {1} frames in all their ways, on four threads under the thread sanitizer",
     "nothing"),
    ("no bit comes from memory that nobody wrote",
     "for s in tile=64 'execution=literal tile=8 effects=all'; do build/msan/tests/golden/core_digests simd=scalar $s | "
     "diff - tests/golden/core_digests.txt && wc -l <tests/golden/core_digests.txt; done",
     r"\n(\d+)(?=\n)", "{0} lines of golden digests, half of them drawn in every pass anew, under the memory sanitizer, by the scalar twins",
     "nothing"),
    ("a frame said in another way (meshes in two parts, corners that are not shared, points, things that nobody names, idle state, another place, another order) is the same picture",
     "BUILD/tests/fuzz/differential_seeds --seeds 0..30000 --relations",
     r"(\d+) frames: (\d+) relations hold", "{1} relations of {0} frames",
     "nothing; meshes in two parts are other objects to object_sorted and batched, as they should be"),
    ("other machines, big-endian ones too, give the same bits",
     "for m in aarch64 s390x riscv64; do tools/cross.sh $m; done",
     r"0 of (\d+) lines differ", "{0} lines of digests, a third of them on each of aarch64, s390x and riscv64",
     "a header that was missing; the build asked Highway for a library that such machines have no use for"),
]

NOT_PROMISED = [
    "Memory that runs out while JSON is read or written: nlohmann's values ask for memory where they are destroyed, and such a request that fails ends the process.",
    "A host's allocator that promises memory which the machine has not (Linux by default): the system ends the process.",
    "32-bit processors, and compilers without 128-bit integers.",
    "SIGKILL and a loss of power between two lines of a sweep: the line that was being written is measured again.",
]


# What others do who are known for it, each by the document that says so.
PRACTICE = [
    "What projects do that are known for it, and what is done here:", "",
    "| practice | whose | here |", "|---|---|---|",
    "| memory and input and output that fail at the n-th call, n = 1, 2, ... | SQLite, *How SQLite Is Tested* | done; of calls that the tests do not count (reading, mapping) it is not |",
    "| every branch and every condition taken (MC/DC) | SQLite, the same | not reached: the shares stand below |",
    "| mutation of branches in compiled code | SQLite, the same | of the sources, by `tools/mutate.py` |",
    "| a power loss simulated by a file system that loses what was not synced | SQLite, the same | kills alone: fsync is asked for in the right order by a test, no disk was cut off |",
    "| a journal whose lines carry a checksum | SQLite, *Write-Ahead Logging* | done: each line of a sweep carries its digest |",
    "| fuzzing day and night on other people's machines | simdjson and OpenEXR, by OSS-Fuzz | minutes a target by libFuzzer, an hour by AFL++ |",
    "| the corpus kept and replayed by the tests | SQLite (*dbsqlfuzz*), simdjson (`fuzz/`) | done: `tests/fuzz/corpus` |",
    "| each instruction set against the plain one, by the same tests | simdjson, *Implementation selection* | done, on the bits |",
    "| big-endian and 32-bit machines | SQLite; simdjson in its continuous integration | big-endian s390x under emulation; 32 bits are refused |",
    "| limits on what a file's header may claim before memory is asked for | OpenEXR, *Security* | done for glTF, PNG and JPEG; an EXR's attributes are left to OpenEXR, which asks for what they claim |",
]


def kept_output(command, build):
    return pathlib.Path(build) / "reliability" / (hashlib.sha1(command.encode()).hexdigest()[:12] + ".txt")


def figures_of(command, pattern, build):
    words = command.replace("BUILD", str(build))
    kept = kept_output(command, build)
    if not kept.exists():
        ended = subprocess.run(["bash", "-c", words], cwd=ROOT, capture_output=True, text=True)
        if ended.returncode != 0:
            sys.exit(f"reliability.py: {words}: status {ended.returncode}:\n{ended.stdout[-2000:]}{ended.stderr[-500:]}")
        kept.parent.mkdir(exist_ok=True)
        kept.write_text(words + "\n" + ended.stdout)
    found = [match.groups() for match in re.finditer(pattern, kept.read_text())]
    if not found:
        sys.exit(f"reliability.py: {words}: {kept} has no figure")
    # Of a figure that is printed more than once, the sum.
    return [f"{sum(int(one[i]) for one in found):,}" for i in range(len(found[0]))]


def row_of_all(text):
    """The figures of a table's last row."""
    return [cell.strip() for cell in re.search(r"^\| all \|(.*)\|$", text, re.M)[1].split("|")]


def what_tests_see():
    sections = (ROOT / "tests" / "mutants" / "RESULTS.md").read_text().split("\n## ")
    fresh, tried, unreached = (row_of_all(next(s for s in sections if s.startswith(title)))
                               for title in ("Before tests were written", "The sample", "What no test reaches"))
    branches = row_of_all((ROOT / "tests" / "coverage" / "RESULTS.md").read_text())
    return ["Would the tests see a fault? `tools/mutate.py` puts changes of one step into the sources, a seeded draw of them. Of the first",
            f"{tried[0]} that a test reaches the tests see {tried[4]}, not counting {tried[2]} that change nothing: {tried[1]} of {int(tried[1]) + int(tried[3])}. It was {tried[5]} before tests",
            "were written for what they had not seen.",
            f"Of {fresh[0]} more that nobody had looked at they saw {fresh[5]}, not counting {fresh[2]} that change nothing; with tests for those that they had not",
            f"seen it is {fresh[4]}.",
            "The aim is 90 % of 400 changes.",
            f"No test of the core reaches {unreached[1]} of the draw. More: [mutants/RESULTS.md](mutants/RESULTS.md).",
            "",
            f"Of {int(branches[0]):,} branches of rasterizer, pipeline and peeling their tests take {branches[2]}, and of {branches[4]} conditions of the stages' decisions",
            f"{branches[6]} have turned a decision round alone (MC/DC), counted by `tools/coverage.sh`. The aims are 98 % and 95 %.",
            "More: [coverage/RESULTS.md](coverage/RESULTS.md)."]


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: tests/reliability.py BUILD_FOLDER [WORD...]")
    page = ROOT / "tests" / "RELIABILITY.md"
    standing = {line.split(" | ")[0]: line for line in page.read_text().splitlines() if line.startswith("| ")}
    words = sys.argv[2:]
    for _, command, *_ in ROWS:
        if any(word in command for word in words):
            kept_output(command, sys.argv[1]).unlink(missing_ok=True)
    lines = ["# What is promised, and how it was tried", "",
             "Made by `tests/reliability.py build/release`: every figure is what the command beside it printed, with no fault.", "",
             "| promise | tried | by | found on the way |", "|---|---|---|---|"]
    for promise, command, pattern, sentence, found in ROWS:
        if words and f"| {promise}" in standing and not any(word in command for word in words):
            lines.append(standing[f"| {promise}"])
            continue
        figures = figures_of(command, pattern, sys.argv[1])
        shown = command.replace("BUILD", "build/release").replace("|", "\\|")  # in a table
        lines.append(f"| {promise} | {sentence.format(*figures)} | `{shown}` | {found} |")
    lines += ["", "Not promised:", ""] + [f"- {line}" for line in NOT_PROMISED]
    lines += ["", *PRACTICE, "", *what_tests_see()]
    page.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
