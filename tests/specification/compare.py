#!/usr/bin/env python3
"""Compares an independent implementation of a rule, written from the specification, with the renderer.

usage: compare.py CASES_PROGRAM RULE [CASES] [SEED]

CASES_PROGRAM is the program specification_cases of this folder, RULE is window_z, dual or blend; 5,000 cases by default. window_z.py, dual.py
and blend.py were written only from the pages of the reference folders, by an author who had not seen the code. Exit status 1 and the
first case if an answer differs.
"""
import importlib
import subprocess
import sys


def main():
    if not 3 <= len(sys.argv) <= 5:
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    program, rule, cases, seed = [*sys.argv[1:], *["5000", "1"][len(sys.argv) - 3:]]
    cases, seed = int(cases), int(seed)
    answer = importlib.import_module(rule).answer
    wrong, checked, first = 0, 0, ""
    with subprocess.Popen([program, rule, str(cases), str(seed)], stdout=subprocess.PIPE, text=True) as machine:
        for line in machine.stdout:
            given, wanted = line.rstrip("\n").split(" -> ")
            found = answer(given)
            checked += 1
            if found != wanted:
                wrong += 1
                first = first or f"case {checked} of seed {seed}: {given}\n    the machine {wanted}, the specification {found}"
    print(f"{rule}: {wrong} of {checked} cases differ")
    if first:
        print(first)
    return 1 if wrong or machine.returncode or checked != cases else 0


if __name__ == "__main__":
    sys.exit(main())
