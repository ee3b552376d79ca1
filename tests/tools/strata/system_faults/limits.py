#!/usr/bin/env python3
"""Tests that with few threads or little address space a picture is either complete, or one message says what is missing.

    tests/tools/strata/system_faults/limits.py build/release/strata

The limits are the kernel's: the number of processes of a user (root has no limit, so as root the commands run as a user without processes), and bytes
of address space. The expected picture is that of a command without limits.
"""
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

USER = 61000 + os.getpid() % 4000  # a user without processes
MB = 1 << 20
MAIN_BEGINS = 21 * MB  # address space of the program and its libraries before main() starts
FRAME = ["render", "random:triangles=300", "--size", "96x64", "--no-audit"]
JOINT = FRAME + ["--samples", "4", "--load-sample", "0", "--max-passes", "8", "-o", "out.png"]  # a thread per sample at once
OUTPUTS = [["--stats", "out.json"], ["-o", "out.png"], ["-o", "out.exr"]]


def run(program, folder, words, limit=None):
    """Status and standard error; a command that takes a minute counts as hanging."""
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
    """The content of a file; for statistics, which contain times, only the digests."""
    def of(path):
        return re.findall(rb'"digest": *[^,}]*', path.read_bytes()) if path.suffix == ".json" else path.read_bytes()
    return {path.name: of(path) for path in pathlib.Path(folder).iterdir()}


def fault(program, root, words, limit, whole):
    """A description of the fault of a command under a limit, and how it ended."""
    with tempfile.TemporaryDirectory(dir=root) as folder:
        os.chmod(folder, 0o777)
        status, told = run(program, folder, words, limit)
        left = content(folder)
    lines = told.splitlines()
    if status == 0:
        wrong = left != whole or len(lines) > 1
    else:
        # The dynamic loader may have no address space for the libraries, or a library's initializer none even for an exception; then these print the
        # message.
        is_loader = status == 127 and "error while loading shared libraries" in told or (
            status == -6 and told.startswith("terminate called without an active exception")
            and limit[0] == resource.RLIMIT_AS and limit[1] < MAIN_BEGINS)
        wrong = left or not (is_loader or (status == 3 and len(lines) == 1))
    return f"{status}: {told}, leaves {sorted(left)}" if wrong else "", status


def cases(quick):
    for most in (1, 3, 6, 40) if quick else range(1, 33):
        yield JOINT, (resource.RLIMIT_NPROC, most)
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
        # A folder that every user may enter, with the program and the image module.
        home = pathlib.Path(root) / "bin"
        home.mkdir(mode=0o755)
        for file in [program, *program.parent.glob("*image*.so*"), *program.parent.glob("lib/**/*.so*")]:
            place = home / file.relative_to(program.parent)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, place)
        expected = {}
        for words, limit in cases("--all" not in sys.argv):
            key = " ".join(words)
            if key not in expected:
                clean = tempfile.mkdtemp(dir=root)
                status, told = run(home / "strata", clean, words)
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
