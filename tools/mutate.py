#!/usr/bin/env python3
"""Do the tests see a change of one step in the pixel path or in an algorithm?

    tools/mutate.py build                 # a copy of the sources with every change in it, chosen at run time: build/mutants
    tools/mutate.py reach                 # which case of which test reaches which change
    tools/mutate.py run --sample 400      # a seeded sample of the changes that are reached; goes on where it stopped
    tools/mutate.py report                # the score of each folder, and the survivors with a line each

A change swaps a comparison with its neighbour or a sum with a difference, makes a constant one larger, an enumerator the next
one, leaves out an operand of && or ||, negates a condition, or drops a statement. It is killed when a test that reaches it
fails, crashes or runs out of time; tests of the same file come first, then those of the folder, the short ones first. Constant
expressions are not changed. Survivors that no test can see stand in tests/mutants/equivalent.txt, with the reason.
"""
import argparse
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "mutants"))
from places import enums_of, places_in, with_changes  # noqa: E402

FOLDER = ROOT / "build" / "mutants"
SOURCE, BUILD = FOLDER / "source", FOLDER / "build"
FLOORS = ("rasterizer", "pipeline", "peeling")
MEMORY = 6 << 30  # a change may ask for any amount
LEAST_SECONDS, TIMES_SLOWER = 30, 20  # before a run counts as endless


def tracked():
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True, check=True).stdout
    return [f for f in listed.splitlines() if (ROOT / f).is_file()]


def is_changed(file):
    return file.startswith(FLOORS) and file.endswith((".h", ".cpp")) and "test" not in file.split("/")[0]


def write_if_other(path, text):
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def load(name, default):
    path = FOLDER / name
    return json.loads(path.read_text()) if path.exists() else default


def write_sources(barred):
    """The copy. `barred` are [file, line, kind] whose change does not compile."""
    files = tracked()
    enums = enums_of([(ROOT / f).read_text() for f in files if is_changed(f)])
    number, table = 0, []
    for file in files:
        if not is_changed(file):
            target = SOURCE / file
            target.parent.mkdir(parents=True, exist_ok=True)
            if not target.exists() or target.read_bytes() != (ROOT / file).read_bytes():
                shutil.copy(ROOT / file, target)
            continue
        text = (ROOT / file).read_text()
        is_kernel = file.endswith(("_simd.cpp", "-inl.h"))
        kept = []
        for place in places_in(file, text, enums, is_kernel):
            number += 1
            place.number = number  # a barred one keeps its number, so that others do
            if [file, place.line] not in barred:
                kept.append(place)
        write_if_other(SOURCE / file, with_changes(text, kept))
        table += [{"number": p.number, "kind": p.kind, "file": p.file, "line": p.line, "change": p.change} for p in kept]
    for floor in FLOORS:
        lists = SOURCE / "tests" / floor / "CMakeLists.txt"
        lists.write_text(lists.read_text() + f"\ntarget_sources({floor}_test PRIVATE ${{PROJECT_SOURCE_DIR}}/tests/mutants/listener.cpp)\n"
                         f"set_source_files_properties(${{PROJECT_SOURCE_DIR}}/tests/mutants/listener.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)\n")
    (FOLDER / "places.json").write_text(json.dumps(table, indent=0))
    return table


def lines_of_errors(log):
    """[file, line] of the copy at which an error, or what led to it, stands."""
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
    flags = f"-w -Wno-narrowing -I{SOURCE}/tests"
    for attempt in range(12):
        table = write_sources(barred)
        print(f"{len(table)} changes; build {attempt + 1}", flush=True)
        log = FOLDER / "build.log"
        with open(log, "w") as file:
            configured = subprocess.run(["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DSTRATA_CORE_ONLY=ON", "-DCMAKE_BUILD_TYPE=Release",
                                         "-DSTRATA_WERROR=OFF", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", f"-DCMAKE_CXX_FLAGS={flags}",
                                         "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"], stdout=file, stderr=file)
            targets = arguments.targets or [f"{f}_test" for f in FLOORS] + ["core_digests"]
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


def program_of(floor):
    return BUILD / "tests" / floor / f"{floor}_test"


def reach(arguments):
    del arguments
    cases = []
    for floor in filter(lambda f: program_of(f).exists(), FLOORS):
        target = FOLDER / f"reached.{floor}.txt"
        if not target.exists() or target.stat().st_mtime < program_of(floor).stat().st_mtime:
            target.unlink(missing_ok=True)
            ended = subprocess.run([program_of(floor), "~[exhaustive]"], cwd=FOLDER, capture_output=True, text=True,
                                   env={**os.environ, "STRATA_REACHED": str(target)})
            if ended.returncode != 0:
                target.unlink()
                sys.exit(f"mutate.py: {floor}_test fails without a change:\n{ended.stdout[-3000:]}")
        for line in target.read_text().splitlines():
            name, file, seconds, numbers = line.split("\t")
            file = str((BUILD / file).resolve().relative_to(SOURCE))
            cases.append({"floor": floor, "name": name, "file": file, "seconds": float(seconds), "reached": [int(n) for n in numbers.split()]})
    (FOLDER / "cases.json").write_text(json.dumps(cases))
    all_reached = {n for case in cases for n in case["reached"]}
    print(f"{len(cases)} cases reach {len(all_reached)} of {len(load('places.json', []))} changes")


def order_of(place, case):
    """Cases of the same file first, then of the same folder and floor; the short ones first."""
    folder, stem = os.path.split(place["file"])
    own = os.path.basename(case["file"]).removesuffix("_test.cpp")
    near = own == re.sub(r"(_simd)?\.(h|cpp)$|-inl\.h$", "", stem)
    same = os.path.dirname(case["file"]) == "tests/" + folder
    return (not near, not same, case["floor"] != folder.split("/")[0], case["seconds"])


def limits():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    os.nice(10)


def outcome_of(number, cases):
    """'' if all cases pass, else the name of the first that does not."""
    names = FOLDER / f"names.{os.getpid()}.txt"
    names.write_text("".join(re.sub(r'([\\\\,\\["*])', r"\\\1", case["name"]) + "\n" for case in cases))
    seconds = LEAST_SECONDS + TIMES_SLOWER * sum(case["seconds"] for case in cases)
    try:
        ended = subprocess.run([program_of(cases[0]["floor"]), "-a", "-f", names], cwd=FOLDER, capture_output=True, text=True, errors="replace",
                               timeout=seconds, env={**os.environ, "STRATA_MUTANT": str(number)}, preexec_fn=limits)
    except subprocess.TimeoutExpired:
        return "out of time"
    finally:
        names.unlink()
    if "No tests ran" in ended.stdout:
        sys.exit(f"mutate.py: the test names none of {[case['name'] for case in cases]}")
    if ended.returncode == 0:
        return ""
    told = re.search(r"^-{70,}\n(.*?)\n-{70,}$", ended.stdout, re.S | re.M)
    return " ".join(told[1].split()) if told else f"status {ended.returncode}"


def killer_of(place, cases, most_seconds):
    reaching = sorted((c for c in cases if place["number"] in c["reached"]), key=lambda c: order_of(place, c))
    spent, groups = 0.0, []
    for case in reaching:
        spent += case["seconds"]
        if spent > most_seconds and groups:
            break
        if groups and groups[-1][0]["floor"] == case["floor"] and len(groups[-1]) < 25:
            groups[-1].append(case)
        else:
            groups.append([case])
    for group in groups:
        if killer := outcome_of(place["number"], group):
            return killer
    digests = BUILD / "tests" / "golden" / "core_digests"
    if not digests.exists():
        return ""
    golden = subprocess.run([digests, f"check={ROOT}/tests/golden/core_digests.txt"], capture_output=True,
                            env={**os.environ, "STRATA_MUTANT": str(place["number"])}, preexec_fn=limits, timeout=600)
    return "core_digests" if golden.returncode != 0 else ""


def run(arguments):
    places, cases = load("places.json", []), load("cases.json", [])
    for case in cases:
        case["reached"] = set(case["reached"])
    everywhere = set().union(*(case["reached"] for case in cases))
    chosen = [p for p in places if p["number"] in everywhere and p["file"].startswith(arguments.folder)]
    random.Random(arguments.seed).shuffle(chosen)
    results = FOLDER / "results.jsonl"
    done = {json.loads(line)["number"] for line in results.read_text().splitlines()} if results.exists() else set()
    for place in chosen[:arguments.sample]:
        if place["number"] in done:
            continue
        killer = killer_of(place, cases, arguments.most_seconds)
        with open(results, "a") as file:
            file.write(json.dumps({**place, "killer": killer}) + "\n")
        print(f"{'killed  ' if killer else 'SURVIVES'} {place['file']}:{place['line']}: {place['kind']} {place['change']}  {killer[:60]}", flush=True)


def reasons():
    """{(file, line of source without its spaces, change): reason} of tests/mutants/equivalent.txt."""
    path, found = ROOT / "tests" / "mutants" / "equivalent.txt", {}
    for line in path.read_text().splitlines() if path.exists() else []:
        if line and not line.startswith("#"):
            file, source, change, reason = line.split(" | ")
            found[file, source, change] = reason
    return found


def report(arguments):
    del arguments
    known, score, survivors = reasons(), {}, []
    for line in (FOLDER / "results.jsonl").read_text().splitlines():
        row = json.loads(line)
        folder = "/".join(row["file"].split("/")[:2])
        source = (ROOT / row["file"]).read_text().splitlines()[row["line"] - 1].strip()
        reason = known.get((row["file"], source, row["change"]))
        kind = "killed" if row["killer"] else "equivalent" if reason else "survived"
        score.setdefault(folder, {"killed": 0, "equivalent": 0, "survived": 0})[kind] += 1
        if not row["killer"]:
            survivors.append(f"{row['file']} | {source} | {row['change']} | {reason or '?'}")
    print("| folder | changes | killed | equivalent | score without equivalents |\n|---|---|---|---|---|")
    rows = sorted(score.items()) + [("all", {k: sum(s[k] for s in score.values()) for k in ("killed", "equivalent", "survived")})]
    for folder, s in rows:
        counted = s["killed"] + s["survived"]
        print(f"| {folder} | {sum(s.values())} | {s['killed']} | {s['equivalent']} | {100 * s['killed'] / counted if counted else 100:.0f} % |")
    print("\n" + "\n".join(sorted(survivors)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(required=True)
    verb = verbs.add_parser("build")
    verb.add_argument("--jobs", type=int, default=os.cpu_count())
    verb.add_argument("targets", nargs="*", help="default: the tests of the three floors and core_digests")
    verb.set_defaults(do=build)
    verbs.add_parser("reach").set_defaults(do=reach)
    verb = verbs.add_parser("run")
    verb.add_argument("--sample", type=int, default=400)
    verb.add_argument("--seed", type=int, default=1)
    verb.add_argument("--folder", default="", help="changes of this folder alone")
    verb.add_argument("--most-seconds", type=float, default=120, help="of tests without a change, a change at most (default 120)")
    verb.set_defaults(do=run)
    verbs.add_parser("report").set_defaults(do=report)
    arguments = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    arguments.do(arguments)


if __name__ == "__main__":
    main()
