#!/usr/bin/env python3
"""Checks that every algorithm's source includes what it uses: preset dev compiles it alone, the other presets in groups.

single_files.py ROOT COMPILER FLAG...
"""
import concurrent.futures
import os
import pathlib
import subprocess
import sys


def faults(root, command, source):
    """The first error of the compiler in this file, or an empty string."""
    ended = subprocess.run([*command, "-I", root, "-fsyntax-only", source], capture_output=True, text=True)
    errors = [line for line in ended.stderr.splitlines() if "error" in line]
    return f"{source}: does not compile alone: {(errors or ['no message'])[0]}" if ended.returncode else ""


def main():
    root, command = pathlib.Path(sys.argv[1]), sys.argv[2:]
    sources = sorted(root.glob("peeling/algorithms/**/*.cpp"))
    if not sources:
        sys.exit("single_files.py: expected sources in peeling/algorithms, found none")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [fault for fault in pool.map(lambda source: faults(root, command, source), sources) if fault]
    for fault in found:
        print(fault)
    print(f"{len(sources)} sources, {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
