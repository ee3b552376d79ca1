#!/usr/bin/python3
"""Runs the blocks of tools/docs/engines.md: page_test.py PROGRAM_FOLDER. Skips with a message and exit status 77 if an engine is missing."""
import os
import sys

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "tools", "port", "engines"), os.path.join(ROOT, "tests", "docs")]
import blocks  # noqa: E402
import draw  # noqa: E402


def main():
    lacking = [draw.missing(engine) for engine in draw.WAYS if draw.missing(engine)]
    if lacking:
        print("\n".join(lacking))
        return draw.SKIPPED
    sys.argv[1:] = [os.path.join(ROOT, "tools", "docs", "engines.md"), sys.argv[1]]
    return blocks.main()


if __name__ == "__main__":
    sys.exit(main())
