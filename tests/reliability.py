#!/usr/bin/env python3
"""Writes tests/RELIABILITY.md: the guarantees, how often each was tested, and what is not guaranteed.

    tools/test.sh --instrumented              # the builds under sanitizers
    tests/reliability.py build/release        # runs the commands that count, some minutes on an idle machine, and writes the page

The page has at most 600 words. BUILD_FOLDER/reliability/TABLE.md has every row with its command and the faults that it found. A figure is what
its command printed; if a command finds a fault, nothing is written. The output of a command is stored in BUILD_FOLDER/reliability, so that
a second run continues where the first ended: `tests/reliability.py build/release limits kills` repeats the rows whose command has one of these
words and takes all others from the page.
"""
import hashlib
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# guarantee, command (BUILD is the build folder), figures in its output, the sentence with them, faults that it found
ROWS = [
    ("wrong input gives one sentence and status 2, and no file",
     "tests/tools/strata/nonsense/nonsense.py BUILD/strata",
     r"(\d+) cases of nonsense, (\d+) places; 0 ", "{0} values in {1} options, scene parameters and fields",
     "flags accepted values; messages contained line ends and invalid UTF-8; a plan's text could be an object; names contained zero bytes"),
    ("memory runs out while a scene is made: the caller gets an error, nothing leaks, and the next call works",
     "BUILD/tests/faults/allocation_faults --load --all",
     r"(\d+) jobs, (\d+) requests failed, 0 bad", "{1} requests of {0} jobs", "nothing"),
    ("the same while a frame is drawn, by every algorithm",
     "BUILD/tests/faults/allocation_faults --render",
     r"(\d+) jobs, (\d+) requests failed, 0 bad", "{1} requests of {0} jobs",
     "a destructor and a search that could not throw allocated memory, which ended the process"),
    ("a system call fails: files are old or new, and a sentence says so",
     "BUILD/tests/tools/tools_test 'if any single system call fails*,a sweep ends with the same bytes after each*'",
     r"(\d+) calls failed", "{0} calls of open, write, fsync, rename and close",
     "outputs without fsync; temporary files that were not removed"),
    ("with few threads or little memory, a picture is whole or one sentence says what is missing",
     "python3 tests/tools/strata/system_faults/limits.py BUILD/strata --all",
     r"(\d+) limits of threads and address space: (\d+) whole pictures, (\d+) sentences, 0 bad",
     "{0} limits: {1} whole pictures, {2} sentences", "hangs and aborts in libraries that start threads or run out of addresses while they are loaded"),
    ("the memory of a picture is predicted within a quarter of the measured peak",
     "BUILD/tests/tools/tools_test 'the predicted memory of a picture*'",
     r"(\d+) pictures: memory told within (\d+) %", "{0} pictures, within {1} %", "nothing"),
    ("fuzzed profiles, cameras, plans, packs, EXR files, call sequences and glTF give a right result or one sentence",
     "ctest --test-dir BUILD -R fuzz-kept-inputs -V",
     r"\w+: (\d+) inputs, 0 bad", "{0} stored inputs of `tools/fuzz.sh`",
     "an EXR file of a kilobyte makes OpenEXR allocate 2 GB, which it never uses"),
    ("a second fuzzing engine finds no fault",
     "for t in calls gltf profile; do tools/fuzz.sh --afl $t 1200; done",
     r"\w+: (\d+) inputs in (\d+) s by AFL\+\+, (\d+) new paths, 0 crashes, 0 hangs",
     "{0} inputs in {1} s by AFL++; {2} reached new paths", "nothing"),
    ("malformed models are refused where the Khronos validator refuses them, or the page of differences explains",
     "python3 tests/scenes/validator/validator.py BUILD/strata",
     r"(\d+) files: (\d+) refused by both \((\d+) with the same code\), (\d+) sound to both, (\d+) differ, 0 end otherwise",
     "{0} files: {1} refused by both, {2} of them with the same code; {3} accepted by both, {4} differ ([why](scenes/validator/README.md))", "nothing that crashed"),
    ("the thread sanitizer reports a race in a parallel loop, and nothing where there is none",
     "BUILD/tests/faults/race own",
     r"(4)", "four threads with separate memory; `race shared` is reported",
     "nothing"),
    ("no two threads of a loop access the same memory without order",
     "build/tsan/tests/golden/core_digests threads=4 tile=8 check=tests/golden/core_digests.txt && "
     "build/tsan/tests/fuzz/differential_seeds --seeds 0..2000 --threads 4",
     r"0 of (\d+) lines differ\n(\d+) frames: every way alike", "{0} lines of golden digests and {1} frames, on four threads",
     "nothing"),
    ("no bit comes from uninitialised memory",
     "for s in tile=64 'execution=literal tile=8 effects=all'; do build/msan/tests/golden/core_digests simd=scalar $s | "
     "diff - tests/golden/core_digests.txt && wc -l <tests/golden/core_digests.txt; done",
     r"\n(\d+)(?=\n)", "{0} lines of golden digests by the scalar references, under the memory sanitizer",
     "nothing"),
    ("equivalent descriptions of a frame give the same picture",
     "BUILD/tests/fuzz/differential_seeds --seeds 0..30000 --relations",
     r"(\d+) frames: (\d+) relations hold", "{1} relations of {0} frames",
     "nothing; meshes in two parts are other objects to object_sorted and batched, as they should be"),
    ("other machines, including big-endian ones, give the same bits",
     "for m in aarch64 s390x riscv64; do tools/cross.sh $m; done",
     r"0 of (\d+) lines differ", "{0} lines of digests on aarch64, s390x and riscv64",
     "a missing header; the build required a library of Highway that such machines do not need"),
]

NOT_GUARANTEED = [
    "If memory runs out while JSON is read or written, the process ends: the destructors of nlohmann's values allocate memory.",
    "A system that grants more memory than the computer has may end the process.",
    "32-bit processors and compilers without 128-bit integers are not supported.",
    "A sweep that is interrupted leaves no rows: tools/cluster divides it into shards, of which only the unfinished ones are measured again.",
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
    # The sum of a figure that is printed several times.
    return [f"{sum(int(one[i]) for one in found):,}" for i in range(len(found[0]))]


def row_of_all(text):
    """The figures of a table's last row."""
    return [cell.strip() for cell in re.search(r"^\| all \|(.*)\|$", text, re.M)[1].split("|")]


def what_tests_see():
    sections = (ROOT / "tests" / "mutants" / "RESULTS.md").read_text().split("\n## ")
    fresh, tried, unreached = (row_of_all(next(s for s in sections if s.startswith(title)))
                               for title in ("Before tests were written", "The sample", "What no test reaches"))
    branches = row_of_all((ROOT / "tests" / "coverage" / "RESULTS.md").read_text())
    return [f"`tools/mutate.py` makes small changes in the sources. Of the first {tried[0]} that a test reaches, the tests detect {tried[4]} ({tried[1]} of",
            f"{int(tried[1]) + int(tried[3])}; {tried[2]} change nothing); it was {tried[5]} before tests were written for the others. Of {fresh[0]} new ones they detected {fresh[5]}, and",
            f"{fresh[4]} with tests for the others. The aim is 90 %. No test of the core reaches {unreached[1]} of the randomly selected changes:",
            "[mutants/RESULTS.md](mutants/RESULTS.md).",
            "",
            f"Of {int(branches[0]):,} branches of rasterizer, pipeline and peeling their tests take {branches[2]} (aim: 98 %). Of {branches[4]} conditions of the stages'",
            f"decisions, {branches[6]} changed a decision alone (MC/DC; aim: 95 %): [coverage/RESULTS.md](coverage/RESULTS.md)."]


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: tests/reliability.py BUILD_FOLDER [WORD...]")
    page = ROOT / "tests" / "RELIABILITY.md"
    standing = {line.split(" | ")[0]: line for line in page.read_text().splitlines() if line.startswith("| ")}
    words = sys.argv[2:]
    for _, command, *_ in ROWS:
        if any(word in command for word in words):
            kept_output(command, sys.argv[1]).unlink(missing_ok=True)
    rows, table = [], ["# Guarantees, with commands", "", "| guarantee | tried | by | faults found |", "|---|---|---|---|"]
    for guarantee, command, pattern, sentence, found in ROWS:
        if words and f"| {guarantee}" in standing and not any(word in command for word in words):
            tried = standing[f"| {guarantee}"].split(" | ")[1].removesuffix(" |")
        else:
            tried = sentence.format(*figures_of(command, pattern, sys.argv[1]))
        shown = command.replace("BUILD", "build/release").replace("|", "\\|")  # in a table
        rows.append(f"| {guarantee} | {tried} |")
        table.append(f"| {guarantee} | {tried} | `{shown}` | {found} |")
    lines = ["# Guarantees, and how they were tested", "",
             "`tests/reliability.py build/release` makes this page. Every figure is of this program on a CPU, by a command that found no fault. The",
             "commands, and the faults that they found earlier, are written to `build/release/reliability/TABLE.md`.", "",
             "| guarantee | tried |", "|---|---|", *rows, "", "Not guaranteed:", ""] + [f"- {line}" for line in NOT_GUARANTEED]
    lines += ["", *what_tests_see()]
    whole = pathlib.Path(sys.argv[1]) / "reliability" / "TABLE.md"
    whole.parent.mkdir(parents=True, exist_ok=True)
    whole.write_text("\n".join(table) + "\n")
    page.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
