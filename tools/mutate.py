#!/usr/bin/env python3
"""Checks whether the tests detect small changes of the rasterizer, the pipeline and the algorithms.

    tools/mutate.py build                 # a copy of the sources with a random selection of the changes, activated at run time: build/mutants
    tools/mutate.py reach                 # which test cases reach which change
    tools/mutate.py run --sample 400      # the first of the changes that are reached; resumes where it stopped
    tools/mutate.py run --again           # the survivors, after build and reach with new tests
    tools/mutate.py report                # the score of each folder, and the survivors with a line each

A change swaps a comparison with its neighbour or a sum with a difference, makes a constant one larger, an enumerator the next
one, omits an operand of && or ||, negates a condition, or drops a statement. It is killed if a test that reaches it fails, crashes or exceeds its
time; tests of the same file come first, then those of the folder, the short ones first. Constant
expressions are not changed. Survivors that no test can detect are listed in tests/mutants/equivalent.txt, with the reason.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import threading

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "mutants"))
from places import enums_of, places_in, with_changes  # noqa: E402

FOLDER = ROOT / "build" / "mutants"
SOURCE, BUILD = FOLDER / "source", FOLDER / "build"
LIBRARIES = ("rasterizer", "pipeline", "peeling")
MEMORY = 6 << 30  # a change may allocate any amount
LEAST_SECONDS, TIMES_SLOWER = 10, 6  # of processor time, before a change counts as endless
WALL_SECONDS = 3600  # for a change that sleeps


def tracked():
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True, check=True).stdout
    return [f for f in listed.splitlines() if (ROOT / f).is_file()]


def is_changed(file):
    return file.startswith(LIBRARIES) and file.endswith((".h", ".cpp")) and "test" not in file.split("/")[0]


def write_if_other(path, text):
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def load(name, default):
    path = FOLDER / name
    return json.loads(path.read_text()) if path.exists() else default


def drawn(total, seed, sample):
    """{number: its rank} of a random selection of `sample` of the numbers 1 to `total`. A smaller selection is the beginning of a larger one."""
    numbers = list(range(1, total + 1))
    random.Random(seed).shuffle(numbers)
    return {number: rank for rank, number in enumerate(numbers[:sample])}


def write_sources(barred, sample, seed):
    """Writes the copy of the sources with the selected changes. `barred` are [file, line] whose changes do not compile."""
    files = tracked()
    enums = enums_of([(ROOT / f).read_text() for f in files if is_changed(f)])
    places = {f: places_in(f, (ROOT / f).read_text(), enums, f.endswith(("_simd.cpp", "-inl.h"))) for f in files if is_changed(f)}
    total = sum(map(len, places.values()))
    rank = drawn(total, seed, sample or total)
    number, table = 0, []
    lists = {"/".join(("tests", library, "CMakeLists.txt")): f"target_sources({library}_test PRIVATE ${{PROJECT_SOURCE_DIR}}/tests/mutants/listener.cpp)\n"
             "set_source_files_properties(${PROJECT_SOURCE_DIR}/tests/mutants/listener.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)\n" for library in LIBRARIES}
    for file in files:
        if not is_changed(file):
            target = SOURCE / file
            target.parent.mkdir(parents=True, exist_ok=True)
            if file in lists:
                write_if_other(target, (ROOT / file).read_text() + "\n" + lists[file])
            elif not target.exists() or target.read_bytes() != (ROOT / file).read_bytes():
                shutil.copy(ROOT / file, target)
            continue
        text = (ROOT / file).read_text()
        kept = []
        for place in places[file]:
            number += 1
            place.number = number  # an omitted change keeps its number, so that the numbers of others do not change
            if number in rank and [file, place.line] not in barred:
                kept.append(place)
        write_if_other(SOURCE / file, with_changes(text, kept))
        table += [{"number": p.number, "rank": rank[p.number], "kind": p.kind, "file": p.file, "line": p.line,
                   "source": text.splitlines()[p.line - 1].strip(), "change": p.change} for p in kept]
    (FOLDER / "places.json").write_text(json.dumps(table, indent=0))
    print(f"{len(table)} of {total} changes", flush=True)


def lines_of_errors(log):
    """[file, line] of the copy at which the compiler reports errors or their causes."""
    found = set()
    for block in re.split(r"(?=^\S+: In )|(?=^\S+:\d+:\d+: (?:fatal )?error:)|(?=^In file included)", log, flags=re.M):
        if "error:" not in block:
            continue
        for path, line in re.findall(rf"^\s*(?:In file included from |from )?(?:{re.escape(str(SOURCE))}|\.\./source)/(\S+?):(\d+)(?=:\d+: +(?:error|required))", block, re.M):
            if is_changed(path):
                found.add((path, int(line)))
    return [list(f) for f in sorted(found)]


def build(arguments):
    SOURCE.mkdir(parents=True, exist_ok=True)
    barred = load("barred.json", [])
    # An index beyond an array ends the test, as in the sanitized tests.
    flags = f"-w -Wno-narrowing -I{SOURCE}/tests -D_GLIBCXX_ASSERTIONS -fsanitize=bounds -fno-sanitize-recover=bounds"
    for attempt in range(12):
        write_sources(barred, arguments.sample, arguments.seed)
        print(f"build {attempt + 1}", flush=True)
        log = FOLDER / "build.log"
        with open(log, "w") as file:
            configured = subprocess.run(["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DSTRATA_CORE_ONLY=ON", "-DCMAKE_BUILD_TYPE=Release",
                                         "-DSTRATA_WERROR=OFF", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", f"-DCMAKE_CXX_FLAGS={flags}",
                                         "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"], stdout=file, stderr=file)
            targets = arguments.targets or [f"{f}_test" for f in LIBRARIES] + ["core_digests"]
            done = configured.returncode == 0 and subprocess.run(
                ["cmake", "--build", BUILD, "--target", *targets, "--", f"-j{arguments.jobs}", "-k0"], stdout=file, stderr=file).returncode == 0
        if done:
            print("built")
            return
        new = [f for f in lines_of_errors(log.read_text(errors="replace")) if f not in barred]
        if not new:
            sys.exit(f"mutate.py: the build fails beside the changes; see {log}")
        print(f"{len(new)} lines whose changes do not compile are left as they are", flush=True)
        barred += new
        (FOLDER / "barred.json").write_text(json.dumps(barred))
    sys.exit("mutate.py: the build does not come to an end")


def program_of(library):
    return BUILD / "tests" / library / f"{library}_test"


def reached_again(library, target):
    """The contents of `target`, updated for test files whose cases have changed since; none if more than that changed."""
    if not target.exists():
        return None, []
    since = target.stat().st_mtime
    newer = [f for folder in (*LIBRARIES, "tests") for f in (SOURCE / folder).rglob("*") if f.suffix in (".h", ".cpp") and f.stat().st_mtime > since]
    if any(not f.name.endswith("_test.cpp") for f in newer):
        return None, []
    tests = sorted(f.stem for f in newer if (SOURCE / "tests" / library) in f.parents)
    kept = [line for line in target.read_text().splitlines() if pathlib.Path(line.split("\t")[1]).stem not in tests]
    return kept, tests


def reach(arguments):
    del arguments
    cases = []
    for library in filter(lambda f: program_of(f).exists(), LIBRARIES):
        target = FOLDER / f"reached.{library}.txt"
        kept, tests = reached_again(library, target)
        if kept is None or tests:
            part = target.with_suffix(".part")
            part.unlink(missing_ok=True)
            chosen = ",".join(f"[#{test}]~[exhaustive]" for test in tests) or "~[exhaustive]"
            ended = subprocess.run([program_of(library), "-#", chosen], cwd=FOLDER, capture_output=True, text=True, env={**os.environ, "STRATA_REACHED": str(part)})
            if ended.returncode != 0:
                sys.exit(f"mutate.py: {library}_test fails without a change:\n{ended.stdout[-3000:]}")
            target.write_text("".join(line + "\n" for line in kept or []) + part.read_text())
            part.unlink()
        for line in target.read_text().splitlines():
            name, file, seconds, numbers = line.split("\t")
            file = str((BUILD / file).resolve().relative_to(SOURCE))
            cases.append({"library": library, "name": name, "file": file, "seconds": float(seconds), "reached": [int(n) for n in numbers.split()]})
    (FOLDER / "cases.json").write_text(json.dumps(cases))
    all_reached = {n for case in cases for n in case["reached"]}
    print(f"{len(cases)} cases reach {len(all_reached)} of {len(load('places.json', []))} changes")


def order_of(place, case):
    """Sort key: cases of the same file first, then of the same folder and library; short ones first."""
    folder, stem = os.path.split(place["file"])
    own = os.path.basename(case["file"]).removesuffix("_test.cpp")
    near = own == re.sub(r"(_simd)?\.(h|cpp)$|-inl\.h$", "", stem)
    same = os.path.dirname(case["file"]) == "tests/" + folder
    return (not near, not same, case["library"] != folder.split("/")[0], case["seconds"])


def limited(seconds, *command):
    """The command with limits of memory and processor time, which do not depend on the load."""
    return ["prlimit", f"--as={MEMORY}", f"--cpu={int(seconds)}", *command]


def outcome_of(number, cases):
    """'' if all cases pass, else the name of the first that fails."""
    names = FOLDER / f"names.{number}.txt"
    names.write_text("".join(re.sub(r'([\\\\,\\["*])', r"\\\1", case["name"]) + "\n" for case in cases))
    seconds = LEAST_SECONDS + TIMES_SLOWER * sum(case["seconds"] for case in cases)
    try:
        ended = subprocess.run(limited(seconds, program_of(cases[0]["library"]), "-a", "-f", names), cwd=FOLDER, capture_output=True, text=True, errors="replace",
                               timeout=WALL_SECONDS, env={**os.environ, "STRATA_MUTANT": str(number)})
    except subprocess.TimeoutExpired:
        return "out of time"
    finally:
        names.unlink()
    if "No tests ran" in ended.stdout:
        sys.exit(f"mutate.py: the test names none of {[case['name'] for case in cases]}")
    if ended.returncode == 0:
        return ""
    if -ended.returncode in (signal.SIGXCPU, signal.SIGKILL):
        return "out of time"
    told = re.search(r"^-{70,}\n(.*?)\n-{70,}$", ended.stdout, re.S | re.M)
    return " ".join(told[1].split()) if told else f"status {ended.returncode}"


def killer_of(place, cases, most_seconds):
    # Code that is executed once is executed in the first case only, and every case of the folder may test its result.
    here = "tests/" + os.path.dirname(place["file"])
    chosen = [c for c in cases if place["number"] in c["reached"] or os.path.dirname(c["file"]) == here]
    spent, groups = 0.0, []
    for case in sorted(chosen, key=lambda c: (place["number"] not in c["reached"], *order_of(place, c))):
        spent += case["seconds"]
        if spent > most_seconds and groups:
            break
        if groups and groups[-1][0]["library"] == case["library"] and len(groups[-1]) < 25:
            groups[-1].append(case)
        else:
            groups.append([case])
    for group in groups:
        if killer := outcome_of(place["number"], group):
            return killer
    digests = BUILD / "tests" / "golden" / "core_digests"
    if not digests.exists():
        return ""
    golden = subprocess.run(limited(300, digests, f"check={ROOT}/tests/golden/core_digests.txt"), capture_output=True,
                            env={**os.environ, "STRATA_MUTANT": str(place["number"])}, timeout=WALL_SECONDS)
    return "core_digests" if golden.returncode != 0 else ""


def sample_of(places, cases, count):
    """The first `count` changes of the selection that tests reach, in an order to which later tests, which reach more, only append."""
    everywhere = {n for case in cases for n in case["reached"]}
    by_number = {p["number"]: p for p in places}
    order = [n for n in load("sample.json", []) if n in by_number]
    order += [p["number"] for p in sorted(places, key=lambda p: p["rank"]) if p["number"] in everywhere - set(order)]
    (FOLDER / "sample.json").write_text(json.dumps(order))
    return [{**by_number[n], "index": i} for i, n in enumerate(order[:count])]


def results():
    """[(number, [row of each test])], in the order of the sample."""
    path, found = FOLDER / "results.jsonl", {}
    for line in path.read_text().splitlines() if path.exists() else []:
        row = json.loads(line)
        found.setdefault(row["number"], []).append(row)
    index = {number: i for i, number in enumerate(load("sample.json", []))}
    return sorted(((number, [{**row, "index": index[number]} for row in rows]) for number, rows in found.items()), key=lambda entry: index[entry[0]])


def run(arguments):
    places, cases = load("places.json", []), load("cases.json", [])
    for case in cases:
        case["reached"] = set(case["reached"])
    chosen = [p for p in sample_of(places, cases, arguments.sample) if p["file"].startswith(arguments.folder)]
    tried = dict(results())
    known = reasons()
    lock = threading.Lock()

    def is_open(place):
        if arguments.again:
            rows = tried.get(place["number"])
            return rows and not rows[-1]["killer"] and not known.get((place["file"], place["source"], place["change"]))
        return place["number"] not in tried

    def attempt(place):
        killer = killer_of(place, cases, arguments.most_seconds)
        with lock, open(FOLDER / "results.jsonl", "a") as file:
            file.write(json.dumps({**place, "killer": killer}) + "\n")
            print(f"{'killed  ' if killer else 'SURVIVES'} {place['index']} {place['file']}:{place['line']}: {place['kind']} {place['change']}  {killer[:60]}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for ended in concurrent.futures.as_completed([pool.submit(attempt, p) for p in chosen if is_open(p)]):
            ended.result()


def reasons():
    """{(file, line of source without its spaces, change): reason} of tests/mutants/equivalent.txt."""
    path, found = ROOT / "tests" / "mutants" / "equivalent.txt", {}
    for line in path.read_text().splitlines() if path.exists() else []:
        if line and not line.startswith("#"):
            file, source, change, reason = line.split(" | ")
            found[file, source, change] = reason
    return found


LOOKED_AT = 400  # of the sample: tests were written for the survivors of these, and for none after them


def folder_of(row):
    return "/".join(os.path.dirname(row["file"]).split("/")[:2])


def fate(row):
    if row["killer"]:
        return "killed"
    return "equivalent" if reasons().get((row["file"], row["source"], row["change"])) else "survived"


def percent(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else "-"


def scores(rows):
    """The table of one part of the sample: `rows` are (first test, last test)."""
    lines = ["| folder | changes | killed | equivalent | survived | score without equivalents | at the first try |", "|---|---|---|---|---|---|---|"]
    for folder in sorted({folder_of(last) for _, last in rows}) + ["all"]:
        here = [(fate(first), fate(last)) for first, last in rows if folder in ("all", folder_of(last))]
        killed, equivalent, survived = (sum(last == kind for _, last in here) for kind in ("killed", "equivalent", "survived"))
        at_first = sum(first == "killed" for first, _ in here)
        lines.append(f"| {folder} | {len(here)} | {killed} | {equivalent} | {survived} | {percent(killed, killed + survived)} | {percent(at_first, killed + survived)} |")
    return lines


def unreached_lines():
    places, sample = load("places.json", []), set(load("sample.json", []))
    lines = ["| folder | changes of the selection | not reached by any test |", "|---|---|---|"]
    for folder in sorted({folder_of(p) for p in places}) + ["all"]:
        here = [p for p in places if folder in ("all", folder_of(p))]
        unreached = sum(p["number"] not in sample for p in here)
        lines.append(f"| {folder} | {len(here)} | {unreached} ({percent(unreached, len(here))}) |")
    return lines


def survivor_lines(rows):
    known = reasons()
    return sorted(f"{r['file']} | {r['source']} | {r['change']} | {known.get((r['file'], r['source'], r['change']), '?')}" for _, r in rows if not r["killer"])


def report(arguments):
    if arguments.unreached:
        sample = set(load("sample.json", []))
        return print("\n".join(f"{p['file']}:{p['line']} | {p['source']} | {p['kind']} {p['change']}" for p in load("places.json", []) if p["number"] not in sample))
    rows = [(tries[0], tries[-1]) for _, tries in results()]
    if arguments.first:
        rows = [r for r in rows if r[1]["index"] >= arguments.first]
        return print("\n".join(scores(rows) + ["", *("    " + line for line in survivor_lines(rows))]))
    beyond = [r for r in rows if r[1]["index"] >= LOOKED_AT]
    tables = {"The sample": scores([r for r in rows if r[1]["index"] < LOOKED_AT]), **({"Changes beyond the sample": scores(beyond)} if beyond else {}),
              "What no test reaches": unreached_lines()}
    survivors = ["## Survivors", "", "File, line of the source, change, and why no test can see it; `?` where one could.", "", *("    " + line for line in survivor_lines(rows))]
    whole = "\n\n".join(["\n".join([f"## {title}", "", *table]) for title, table in tables.items()] + ["\n".join(survivors)]) + "\n"
    if not arguments.page:
        return print(whole)
    page = ROOT / "tests" / "mutants" / "RESULTS.md"
    shares = "\n\n".join("\n".join([f"## {title}", "", *table[:2], table[-1]]) for title, table in tables.items())  # the row of all folders
    page.write_text(page.read_text().split("## The sample")[0] + shares + "\n")
    (FOLDER / "RESULTS.md").write_text(whole)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(required=True)
    verb = verbs.add_parser("build")
    verb.add_argument("--jobs", type=int, default=os.cpu_count())
    verb.add_argument("--sample", type=int, default=1000, help="a seeded draw of so many changes (default 1000); 0: all of them, which takes half a day")
    verb.add_argument("--seed", type=int, default=1)
    verb.add_argument("targets", nargs="*", help="default: the tests of the three libraries and core_digests")
    verb.set_defaults(do=build)
    verbs.add_parser("reach").set_defaults(do=reach)
    verb = verbs.add_parser("run")
    verb.add_argument("--sample", type=int, default=400)
    verb.add_argument("--again", action="store_true", help="those that survived, on the tests of today")
    verb.add_argument("--jobs", type=int, default=os.cpu_count())
    verb.add_argument("--folder", default="", help="changes of this folder alone")
    verb.add_argument("--most-seconds", type=float, default=40, help="of tests without a change, a change at most (default 40)")
    verb.set_defaults(do=run)
    verb = verbs.add_parser("report")
    verb.add_argument("--md", dest="page", action="store_true", help="into tests/mutants/RESULTS.md, below its head, and by folder with the survivors into build/mutants/RESULTS.md")
    verb.add_argument("--first", type=int, default=0, help="of the sample, and those behind it alone: the table and the survivors of a part that was drawn later")
    verb.add_argument("--unreached", action="store_true", help="the changes of the draw that no test reaches")
    verb.set_defaults(do=report)
    arguments = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    arguments.do(arguments)


if __name__ == "__main__":
    main()
