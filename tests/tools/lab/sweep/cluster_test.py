#!/usr/bin/env python3
"""Tests tools/cluster: every sweep in shards gives the bytes of one process, also after a shard was lost. usage: cluster_test.py REPOSITORY STRATA
PROBE_ROUND_TRIPS SUITE_MISTAKES

Skips the runs of GNU parallel with a message if it is not installed, and then starts the shards itself.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT, STRATA, RANDOM_DEVICES, SUITE_MISTAKES = (pathlib.Path(path).resolve() for path in sys.argv[1:5])
TOOLS = ROOT / "tools" / "cluster"
SHARDS = 3
SWEEPS = {
    "invariance": [STRATA, "invariance", "planes:gap=64,count=4", "--size", "24x16", "--profile", "ideal", "--algorithm", "front_to_back", "--pair", "float32:exact", "--depth-format", "d24", "--remedy", "none,bias:2,bias:9"],
    "cost": [STRATA, "cost", "planes:count=2", "--size", "16x12", "--knob", "average_count,chain", "--repeat", "1"],
    "hard-cases": [STRATA, "hard-cases", "frame-1x1", "reversed-range", "--profile", "geforce3,geforce8", "--depth-format", "d16,d24", "--algorithm", "dual,depth_units"],
    "multisampling": [STRATA, "multisampling", "planes:count=2", "--size", "8x6", "--algorithm", "dual,depth_units"],
    "random devices": [RANDOM_DEVICES, "--first", "155", "--count", "2", "--unseen", "1100"],
    "suite": [SUITE_MISTAKES, "half.front_to_back"],
}
faults = []


def check(holds, sentence):
    if not holds:
        faults.append(sentence)


def run(*words, **more):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **more)


def start(folder, words):
    """All shards, and their join, by GNU parallel if it is there."""
    if shutil.which("parallel"):
        return run(TOOLS / "parallel.sh", folder, SHARDS, "--", *words, env={"PATH": "/usr/bin:/bin", "HOME": str(folder)})
    for k in range(1, SHARDS + 1):
        if not (folder / f"results.{k}of{SHARDS}.jsonl").exists():
            run(*words, "-o", folder, "--shard", f"{k}/{SHARDS}")
    return run(TOOLS / "join.py", folder, SHARDS)


def same(name, whole, parts):
    for file in ("results.jsonl", "results.csv"):
        check((whole / file).read_bytes() == (parts / file).read_bytes(), f"{name}: {file} of the shards is not that of one process")
    cells = [json.loads(line) for line in (parts / "timings.jsonl").read_text().splitlines()]
    check([row.get("cell", row.get("row")) for row in cells] == list(range(len(cells))), f"{name}: timings are not in the order of the rows")


def check_sweep(name, words, folder):
    whole, parts = folder / name / "whole", folder / name / "parts"
    for path in (whole, parts):
        path.mkdir(parents=True)
    alone = run(*words, "-o", whole)
    check(alone.returncode == 0, f"{name}: {alone.stderr}")
    ended = start(parts, words)
    check(ended.returncode == 0, f"{name}: {ended.stderr}")
    same(name, whole, parts)
    # A shard is lost, as if its process had been killed: join.py refuses, and a second start measures it alone again.
    lost = parts / f"results.2of{SHARDS}.jsonl"
    lost.unlink()
    (parts / "results.jsonl").unlink()
    refused = run(TOOLS / "join.py", parts, SHARDS)
    check(refused.returncode == 2 and "results.2of3.jsonl: expected the rows of a shard, found no such file" in refused.stderr, f"{name}: {refused}")
    check(not (parts / "results.jsonl").exists(), f"{name}: a join that refuses writes a file")
    log = parts / "joblog"
    if log.exists():
        log.write_text("".join(line for line in log.read_text().splitlines(keepends=True) if "2/3" not in line))
    before = (parts / f"timings.1of{SHARDS}.jsonl").stat().st_mtime_ns
    check(start(parts, words).returncode == 0, f"{name}: the second start fails")
    same(name, whole, parts)
    check((parts / f"timings.1of{SHARDS}.jsonl").stat().st_mtime_ns == before, f"{name}: a finished shard is measured again")


# Runs what sbatch is asked to run at once: each task of the array, last first, or the job that joins.
SBATCH = r"""#!/usr/bin/env bash
set -e
tasks=()
while [ $# -gt 0 ]; do
    case "$1" in
        --array) IFS=- read -r first last <<<"$2"; tasks=($(seq "$last" -1 "$first")); shift 2 ;;
        --wrap) wrapped=$2; shift 2 ;;
        --dependency) [ "$2" = afterany:7 ]; shift 2 ;;
        --job-name | --output) shift 2 ;;
        *) shift ;;
    esac
done
for task in "${tasks[@]:-0}"; do SLURM_ARRAY_TASK_ID=$task bash -c "$wrapped" >&2; done
echo 7
"""


def check_slurm(folder):
    """slurm.sh with a program sbatch that runs the jobs at once."""
    (folder / "bin").mkdir()
    (folder / "bin" / "sbatch").write_text(SBATCH)
    (folder / "bin" / "sbatch").chmod(0o755)
    words = ["planes:count=2", "--size", "8x6", "--algorithm", "dual,depth_units"]
    ended = run(TOOLS / "slurm.sh", folder / "a folder", SHARDS, "--cpus-per-task", "1", "--", "multisampling", *words,
                env={"STRATA": str(STRATA), "PATH": f"{folder}/bin:/usr/bin:/bin"})
    check(ended.returncode == 0 and ended.stdout == "7\n", f"slurm.sh: {ended}")
    run(STRATA, "multisampling", *words, "-o", folder / "whole")
    same("slurm.sh", folder / "whole", folder / "a folder")


def check_join(folder):
    """A shard that is too short is refused with what is expected; quoted line ends stay in their row."""
    def write(name, text):
        (folder / name).write_bytes(text)
    write("results.1of2.csv", b'a\n"x\ny"\nz\n')
    write("results.2of2.csv", b"a\nw\n")
    ended = run(TOOLS / "join.py", folder, 2)
    check(ended.returncode == 0 and (folder / "results.csv").read_bytes() == b'a\n"x\ny"\nw\nz\n', f"a quoted line end: {ended.stderr}")
    write("results.2of2.csv", b"a\n")
    ended = run(TOOLS / "join.py", folder, 2)
    check(ended.returncode == 2 and "results.1of2.csv: expected 1 of 2 rows, found 2" in ended.stderr, f"a short shard: {ended.stderr}")
    check(run(TOOLS / "join.py", folder / "none", 2).returncode == 2, "a folder that is missing")


def check_usage():
    for words in (["out"], ["out", "0", "--", "cost"], ["out", "2", "cost", "teapot"], ["out", "two", "--", "cost", "teapot"]):
        ended = run(TOOLS / "parallel.sh", *words)
        check(ended.returncode == 2 and len(ended.stderr.splitlines()) == 1, f"parallel.sh {words}: {ended}")


with tempfile.TemporaryDirectory() as path:
    if not shutil.which("parallel"):
        print("SKIPPED: GNU parallel is not installed; the shards are started one by one")
    for sweep, arguments in SWEEPS.items():
        check_sweep(sweep, arguments, pathlib.Path(path))
    (pathlib.Path(path) / "slurm").mkdir()
    check_slurm(pathlib.Path(path) / "slurm")
    (pathlib.Path(path) / "join").mkdir()
    check_join(pathlib.Path(path) / "join")
check_usage()
print("\n".join(faults) or f"{len(SWEEPS)} sweeps")
sys.exit(1 if faults else 0)
