#!/usr/bin/env python3
"""Inserts mistakes into a page and checks that blocks.py finds each of them: broken_pages.py PROGRAM_FOLDER"""
import os
import sys
import tempfile

import blocks

RIGHT = "# Page\n```console\n$ echo one && \\\n  echo two\none\ntwo\n$ strata --version\n...\n$ false || echo \"status $?\"\nstatus 1\n```\n" \
    "```text note\nleft\n```\n```text note\nright\n```\n```console\n$ cat note\nleft\nright\n```\n" \
    "```text from LICENSE\n                                 Apache License\n```\n"
MISTAKES = [
    ("two\n$", "three\n$", "another line than is printed"),
    ("one\ntwo\n", "one\n", "a line that the page leaves out"),
    ("one\ntwo\n", "one\ntwo\nthree\n", "a line that is not printed"),
    ("strata --version", "strata --versions", "an option that there is not"),
    ("strata --version", "strato --version", "a program that there is not"),
    (' || echo "status $?"\nstatus 1', "", "a status that is not said"),
    ("```text note\nright", "```text another\nright", "a file that is not there"),
    ("Apache License", "Apache Licence", "a line of a file that stands otherwise there"),
    ("from LICENSE", "from LICENCE", "a file of the checkout that there is not"),
    ("status 1", "status ...2", "dots that stand for too little"),
]


def complaints_of(text, programs):
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "page")
        with open(page, "w", encoding="utf-8") as file:
            file.write(text)
        return blocks.run_page(page, programs)[0]


def main():
    programs = os.path.abspath(sys.argv[1])
    if not os.access(os.path.join(programs, "strata"), os.X_OK):
        print(f"SKIPPED: no program strata in {programs}")
        return 77
    wrong = [f"the right page: {complaint}" for complaint in complaints_of(RIGHT, programs)]
    for old, new, what in MISTAKES:
        assert RIGHT.count(old) == 1, old
        if not complaints_of(RIGHT.replace(old, new), programs):
            wrong.append(f"not found: {what}")
    print("\n".join(wrong) if wrong else f"{len(MISTAKES)} mistakes found")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
