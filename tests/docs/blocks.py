#!/usr/bin/env python3
"""Runs the console blocks of a page and compares what they print: blocks.py PAGE PROGRAM_FOLDER

A block is a fence of the language `console`. bash executes each line `$ COMMAND`; the lines up to the next command are its output, standard output
and standard error together. `...` stands for any text within a line, a line with only `...` for any lines. A command whose line ends in a backslash
continues on the next line. All blocks of a page run one after another in the same, initially empty folder, with
PROGRAM_FOLDER first on the path and this checkout in STRATA_SOURCE. A command whose status is not 0 must print it (`|| echo "status $?"`).
A fence with a language and a name (`python port.py`) is a file of that name, available to all later blocks; a second fence of the same name is
appended. A fence with a language and `from PATH` must be a literal part of that file of this checkout. Exit status 1, with the actual output, if a
page is wrong; 77 if the program is missing.
"""
import os
import re
import subprocess
import sys
import tempfile

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def blocks_of(text):
    """The fenced blocks: the text after the opening fence, its line number from 1, and the lines inside."""
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
    """The commands of a block: line number, command, expected lines."""
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
    """A regular expression for the whole expected output."""
    parts = []
    for line in lines:
        if line.strip() == "...":
            parts.append(r"(?:[^\n]*\n)*?")
        else:
            parts.append(r"[^\n]*?".join(re.escape(part) for part in line.rstrip().split("...")) + r"[ ]*\n")
    return re.compile("".join(parts))


def complaint_of_step(command, expected, folder, environment):
    """A description of the difference; None if the command prints the expected lines."""
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
    """A description of the difference if the block is not part of the named file; None if it is."""
    try:
        with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
            whole = file.read()
    except OSError as error:
        return str(error)
    return None if "\n" + "\n".join(block) + "\n" in "\n" + whole else f"these lines do not stand so in {path}"


def run_page(page, programs):
    """The faults of a page, and its numbers of commands and quoted parts."""
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
