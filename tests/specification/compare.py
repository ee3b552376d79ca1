#!/usr/bin/env python3
"""Compares a rule written again from the specification with the machine.

usage: compare.py BOOK_CASES RULE [CASES] [SEED]

BOOK_CASES is the program of tests/specification, RULE one of window_z, dual and blend; 5,000 cases unless said otherwise. window_z.py, dual.py
and blend.py were written from the pages of the reference folders alone, by an author who had not seen the code. Exit status 1 and the
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
