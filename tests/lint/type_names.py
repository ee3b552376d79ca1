#!/usr/bin/env python3
"""Checks that a name means one type: type_names.py REPOSITORY [--list].

Every class, struct, union and enum of the product at namespace scope counts, in headers and sources, also in unnamed namespaces: a reader who searches
for a name finds one type. Types inside a class are named with it and do not count, nor do specializations, tests, and the public library
(tools/library/strata), whose types are named like what they stand for. Exit status 1 and a line for each name of several types.
"""
import argparse
import os
import re
import sys

import specification

APART = ("tests/", "tools/library/strata/")

TYPE = re.compile(r"\b(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+(?:alignas\([^)]*\)\s+)?(?:\[\[\w+\]\]\s+)?(\w+)\s*(?:final\s*)?(?::(?!:)[^{]*)?$")
NAMESPACE = re.compile(r"\bnamespace\b[\w:\s]*$")


def code_of(text):
    """The text without comments, literals and directives; places are not kept."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.DOTALL)
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.DOTALL)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"'(?:\\.|[^'\\\n])'", "' '", text)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.MULTILINE)


def types_of(text):
    """The names of the types at namespace scope."""
    code = code_of(text)
    scopes, start = [], 0
    for found in re.finditer(r"[;{}]", code):
        head = code[start:found.start()].strip()
        start = found.end()
        if found[0] == "}" and scopes:
            scopes.pop()
        if found[0] != "{":
            continue
        head = re.sub(r"^(?:template\s*<.*>\s*)?(?=\b(?:class|struct|union|enum)\b)", "", head, flags=re.DOTALL)
        kind = TYPE.search(head)
        if kind and all(scope == "namespace" for scope in scopes) and "(" not in head.split(kind[1])[-1]:
            yield kind[1]
        scopes.append("namespace" if NAMESPACE.search(head) or 'extern ""' in head else "type" if kind else "block")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repository")
    parser.add_argument("--list", action="store_true", help="print every name with its files")
    options = parser.parse_args()
    try:
        names = specification.Checkout(options.repository).names
    except specification.NoCheckout:
        print("SKIPPED: the list of files comes from git, and this is no checkout")
        return 77
    files = {}
    for name in names:
        if name.endswith((".h", ".cpp")) and not name.startswith(APART):
            with open(os.path.join(options.repository, name), encoding="utf-8") as text:
                for kind in types_of(text.read()):
                    files.setdefault(kind, set()).add(name)
    several = {kind: sorted(found) for kind, found in sorted(files.items()) if len(found) > 1}
    if options.list:
        for kind, found in sorted(files.items()):
            print(f"{kind}: {', '.join(sorted(found))}")
    faults = [f"{kind}: {len(found)} types: {', '.join(found)}" for kind, found in several.items()]
    print("\n".join(faults))
    print(f"{len(files)} names of types, {len(faults)} with several types")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
