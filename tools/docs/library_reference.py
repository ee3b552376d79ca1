#!/usr/bin/env python3
"""Makes pages of the public headers (tools/library/strata) by Doxygen: library_reference.py FOLDER; they begin at FOLDER/html/index.html

Doxygen reads only comments with three slashes; as its filter (`--filter FILE`) this script prints a header with a third slash in each comment. Every
warning is an error. Exit status 77 if Doxygen is not installed (Debian package doxygen).
"""
import os
import re
import shutil
import subprocess
import sys

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SETTINGS = """PROJECT_NAME = Strata
INPUT = tools/library/strata
FILE_PATTERNS = *.h
STRIP_FROM_PATH = tools/library
OUTPUT_DIRECTORY = "{folder}"
INPUT_FILTER = "{python} -B {script} --filter"
GENERATE_LATEX = NO
GENERATE_XML = YES
HAVE_DOT = NO
EXTRACT_ALL = YES
QUIET = YES
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""


def filtered(text):
    # Doxygen finds no scope for a specialisation of a template of another library.
    text = re.sub(r"^template <>\nstruct Catch::.*?^};", "", text, flags=re.MULTILINE | re.DOTALL)
    lines = text.splitlines()
    name, _, what = lines[0][3:].partition(" - ")
    lines[0] = f"/// \\file {name}\n/// {what}\n///"
    for i, line in enumerate(lines[1:], 1):
        line = re.sub(r"^(\s*)//(?= |$)", r"\1///", line)
        line = re.sub(r"(\S.*?)  // (?!NOLINT)", r"\1  ///< ", line)
        lines[i] = line
    return "\n".join(lines) + "\n"


def functions_of(header):
    """Names that a header declares as functions, outside of any class."""
    return set(re.findall(r"^(?:\[\[nodiscard\]\] )?[\w:<>]+ (\w+)\(", header, re.MULTILINE))


def main():
    if sys.argv[1] == "--filter":
        with open(sys.argv[2], encoding="utf-8") as file:
            print(filtered(file.read()), end="")
        return 0
    if not shutil.which("doxygen"):
        print("SKIPPED: doxygen was not found (Debian package doxygen)")
        return 77
    folder = os.path.abspath(sys.argv[1])
    os.makedirs(folder, exist_ok=True)
    settings = SETTINGS.format(folder=folder, python=sys.executable, script=os.path.abspath(__file__))
    ended = subprocess.run(["doxygen", "-"], input=settings.encode(), cwd=SOURCE)
    if ended.returncode != 0:
        return 1
    headers, missing, count = os.path.join(SOURCE, "tools/library/strata"), [], 0
    with open(os.path.join(folder, "xml", "index.xml"), encoding="utf-8") as file:
        index = file.read()
    for header in sorted(os.listdir(headers)):
        with open(os.path.join(headers, header), encoding="utf-8") as file:
            for name in sorted(functions_of(file.read())):
                count += 1
                if f"<name>{name}</name>" not in index:
                    missing.append(f"{header}: no page has the function {name}")
    print("\n".join(missing) if missing else f"{count} functions of {len(os.listdir(headers))} headers have their page")
    return 1 if missing or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
