#!/usr/bin/env python3
"""Writes a page for each command, with all its options and examples: command_reference.py PROGRAM_FOLDER FOLDER; they begin at FOLDER/README.md

The text is the output of `strata help COMMAND all`, which, like the manual pages, is generated from the definitions by which the program parses
options.
"""
import os
import re
import subprocess
import sys


def printed(program, *arguments):
    return subprocess.run([program, *arguments], check=True, stdout=subprocess.PIPE).stdout.decode()


def main():
    program, folder = os.path.join(os.path.abspath(sys.argv[1]), "strata"), sys.argv[2]
    if not os.access(program, os.X_OK):
        print(f"SKIPPED: no program {program}")
        return 77
    os.makedirs(folder, exist_ok=True)
    commands = re.findall(r"^  ([a-z][a-z-]*)  +(\S.*)$", printed(program, "--help"), re.MULTILINE)
    wrong = []
    with open(os.path.join(folder, "README.md"), "w", encoding="utf-8") as index:
        index.write(f"# {printed(program, '--version').strip()}\n\n| command | what it does |\n|---|---|\n")
        for name, what in commands:
            text = printed(program, "help", name, "all")
            if "Exit status" not in text or what not in text:
                wrong.append(f"{name}: expected its sentence and its exit status in its help")
            with open(os.path.join(folder, f"{name}.md"), "w", encoding="utf-8") as page:
                page.write(f"# strata {name}\n```text\n{text.strip()}\n```\n")
            index.write(f"| [{name}]({name}.md) | {what} |\n".replace("|N", "\\|N"))
    print("\n".join(wrong) if wrong else f"{len(commands)} commands have their page")
    return 1 if wrong or len(commands) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
