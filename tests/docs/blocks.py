#!/usr/bin/env python3
"""Runs the console blocks of a page and compares what they print: blocks.py PAGE PROGRAM_FOLDER

A block is a fence of the language `console`. A line `$ COMMAND` is run by bash, the lines up to the next one are what it prints,
standard output and standard error together. `...` stands for any text within a line, a line of it alone for any lines. A command that
a line ends with a backslash goes on in the next one. All blocks of a page run one after the other in one empty folder, with
PROGRAM_FOLDER first on the path and this checkout in STRATA_SOURCE. A command that ends with another status than 0 must say so itself
(`|| echo "status $?"`).
A fence of a language and a name (`python port.py`) is a file of that name, there from that place of the page on; a second one of the
same name goes on with it. A fence of a language and `from PATH` shows a part of a file of this checkout, word by word.
Exit status 1, and what was printed, where a page is wrong; 77 where the program is not there.
"""
import os
import re
import subprocess
import sys
import tempfile

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def blocks_of(text):
    """The fenced blocks: what stands behind the fence, its line, from 1, and the lines within it."""
    found, block, start, kind = [], None, 0, ""
    for number, line in enumerate(text.splitlines(), 1):
        if block is None and line.startswith("```"):
            block, start, kind = [], number, line[3:].strip()
        elif block is not None and line.strip() == "```":
            found.append((kind, start, block))
            block = None
        elif block is not None:
            block.append(line)
    if block is not None:
        raise SystemExit(f"line {start}: a block without an end")
    return found


def steps_of(first, block):
    """The commands of a block: line, command, expected lines."""
    steps, goes_on = [], False
    for number, line in enumerate(block, first + 1):
        if goes_on:
            steps[-1][1] += "\n" + line
        elif line.startswith("$ "):
            steps.append([number, line[2:], []])
        elif steps:
            steps[-1][2].append(line)
        else:
            raise SystemExit(f"line {number}: a console block begins with '$ COMMAND', found {line!r}")
        goes_on = (goes_on or line.startswith("$ ")) and line.endswith("\\")
    return steps


def pattern_of(lines):
    """A regular expression of all that is printed."""
    parts = []
    for line in lines:
        if line.strip() == "...":
            parts.append(r"(?:[^\n]*\n)*?")
        else:
            parts.append(r"[^\n]*?".join(re.escape(part) for part in line.rstrip().split("...")) + r"[ ]*\n")
    return re.compile("".join(parts))


def complaint_of_step(command, expected, folder, environment):
    """What is wrong with one command; None if it prints what the page says."""
    ended = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=environment,
                           stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    printed = ended.stdout.decode("utf-8", "replace")
    if printed and not printed.endswith("\n"):
        printed += "\n"
    if ended.returncode != 0:
        return f"ended with status {ended.returncode}:\n{printed}"
    if not pattern_of(expected).fullmatch(printed):
        return "expected\n" + "\n".join(expected) + f"\nfound\n{printed}"
    return None


def complaint_of_part(path, block):
    """Whether a block that is said to be a part of a file is one."""
    try:
        with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
            whole = file.read()
    except OSError as error:
        return str(error)
    return None if "\n" + "\n".join(block) + "\n" in "\n" + whole else f"these lines do not stand so in {path}"


def run_page(page, programs):
    """The complaints about a page, and how many commands and quoted parts it has."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    environment = dict(os.environ, PATH=programs + os.pathsep + os.environ["PATH"], LC_ALL="C.UTF-8", STRATA_SOURCE=SOURCE)
    complaints, count = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for kind, first, block in blocks_of(text):
            language, _, name = kind.partition(" ")
            if language == "console":
                for number, command, expected in steps_of(first, block):
                    count += 1
                    found = complaint_of_step(command, expected, folder, environment)
                    if found:
                        complaints.append(f"{page}:{number}: {command}\n{found}")
            elif name.startswith("from "):
                count += 1
                found = complaint_of_part(name[5:], block)
                if found:
                    complaints.append(f"{page}:{first}: {found}")
            elif name:
                with open(os.path.join(folder, os.path.basename(name)), "a", encoding="utf-8") as file:
                    file.write("\n".join(block) + "\n")
    return complaints, count


def main():
    page, programs = sys.argv[1], os.path.abspath(sys.argv[2])
    if not os.access(os.path.join(programs, "strata"), os.X_OK):
        print(f"SKIPPED: no program strata in {programs}")
        return 77
    complaints, count = run_page(page, programs)
    print("\n".join(complaints) if complaints else f"{page}: {count} commands and quotations are as printed")
    return 1 if complaints or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
