#!/usr/bin/env python3
"""Whatever threads and address space the system grants, a picture is whole, or one sentence says what is missing.

    tests/tools/system_faults/limits.py build/release/strata

The limits are the kernel's own: processes of a user that is not root (root has none, so as root the runs change to a user without any
process), and bytes of address space. Model: the picture of a run without limits, and the folder's listing.
"""
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

USER = 61000 + os.getpid() % 4000  # of whom no process runs
MB = 1 << 20
MAIN_BEGINS = 21 * MB  # address space that the program and its libraries take before it begins
FRAME = ["render", "random:triangles=300", "--size", "96x64", "--no-audit"]
OUTPUTS = [["--stats", "out.json"], ["-o", "out.png"], ["-o", "out.exr"]]


def run(program, folder, words, limit=None):
    """Status and standard error; a run that takes a minute hangs."""
    def prepare():
        if limit:
            resource.setrlimit(limit[0], (limit[1], limit[1]))
        if limit and limit[0] == resource.RLIMIT_NPROC and os.getuid() == 0:
            os.setgid(USER)
            os.setuid(USER)
    try:
        ended = subprocess.run([program] + words, cwd=folder, capture_output=True, timeout=60, preexec_fn=prepare)
    except subprocess.TimeoutExpired:
        return "hangs", ""
    return ended.returncode, ended.stderr.decode(errors="replace")


def content(folder):
    """Of statistics, which have times in them, the digests."""
    def of(path):
        return re.findall(rb'"digest": *[^,}]*', path.read_bytes()) if path.suffix == ".json" else path.read_bytes()
    return {path.name: of(path) for path in pathlib.Path(folder).iterdir()}


def fault(program, root, words, limit, whole):
    """What is wrong with a run under a limit, and how it ended."""
    with tempfile.TemporaryDirectory(dir=root) as folder:
        os.chmod(folder, 0o777)
        status, told = run(program, folder, words, limit)
        left = content(folder)
    lines = told.splitlines()
    if status == 0:
        wrong = left != whole or len(lines) > 1
    else:
        # The loader of programs has no address space for our libraries, or one of them none for its initializer, and none for an exception
        # either: then they speak.
        is_loader = status == 127 and "error while loading shared libraries" in told or (
            status == -6 and told.startswith("terminate called without an active exception") and limit[1] < MAIN_BEGINS)
        wrong = left or not (is_loader or (status == 3 and len(lines) == 1))
    return f"{status}: {told}, leaves {sorted(left)}" if wrong else "", status


def cases(quick):
    for output in OUTPUTS:
        for threads in ("1", "4", "1000"):
            words = FRAME + ["--threads", threads] + output
            for most in ((1, 3, 6, 40) if threads != "1" else (1,)) if quick else (*range(1, 33), 40, 100):
                yield words, (resource.RLIMIT_NPROC, most)
        words = FRAME + ["--threads", "4"] + output
        for mb in (20, 60, 200, 424, 432, 441, 447, 470) if quick else (*range(10, 1000, 10), *range(440, 456)):
            yield words, (resource.RLIMIT_AS, mb * MB)


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: limits.py STRATA [--all]")
    program = pathlib.Path(sys.argv[1]).resolve()
    wrong, count, ends = [], 0, {}
    with tempfile.TemporaryDirectory() as root:
        os.chmod(root, 0o755)
        # A folder that every user may enter, with the program and the module of images beside it.
        home = pathlib.Path(root) / "bin"
        home.mkdir(mode=0o755)
        for file in [program, *program.parent.glob("*image*.so*"), *program.parent.glob("lib/**/*.so*")]:
            place = home / file.relative_to(program.parent)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, place)
        expected = {}
        for words, limit in cases("--all" not in sys.argv):
            key = " ".join(words[-2:])
            if key not in expected:
                clean = tempfile.mkdtemp(dir=root)
                status, told = run(home / "strata", clean, FRAME + words[-2:])
                if status != 0:
                    sys.exit(f"limits.py: without a limit: {status}: {told}")
                expected[key] = content(clean)
            found, status = fault(home / "strata", root, words, limit, expected[key])
            count += 1
            ends[status] = ends.get(status, 0) + 1
            if found:
                wrong.append(f"{' '.join(words)}, limit {limit[1]} of {'processes' if limit[0] == resource.RLIMIT_NPROC else 'bytes'}: {found}")
    print("\n".join(wrong[:40]))
    print(f"{count} limits of threads and address space: {ends.get(0, 0)} whole pictures, {count - ends.get(0, 0) - len(wrong)} sentences, {len(wrong)} bad")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
