#!/usr/bin/env python3
"""Counts the member functions of a region's types: faces.py REPOSITORY [--list].

The public interface of Region has at most 30, and every type at most 40 including private ones. Constructors, destructors and deleted functions are
not counted; overloads are. Exit status 1 and a line for each type that has more.
"""
import argparse
import pathlib
import re
import sys

FACE, MOST = 30, 40
HEADERS = "pipeline/region/region*.h"


def declarations(text):
    """(class, is public, declaration) of each declaration in the body of a class or struct; bodies of functions are left out."""
    text = re.sub(r"//[^\n]*", "", text)
    for found in re.finditer(r"^(class|struct) (?:alignas\(\d+\) )?(\w+) \{", text, re.MULTILINE):
        public, depth, start = found[1] == "struct", 1, found.end()
        place = start
        while depth > 0:
            letter = text[place]
            depth += {"{": 1, "}": -1}.get(letter, 0)
            if depth == 1 and letter in ";}":
                declaration = text[start:place + 1]
                start = place + 1
                for access in re.findall(r"\b(public|private):", declaration):
                    public = access == "public"
                yield found[2], public, re.sub(r"\b(?:public|private):|\s+", " ", declaration).strip()
            place += 1


def functions(text):
    """(class, is public, name) of each member function."""
    for kind, public, declaration in declarations(text):
        head = re.split(r"[{=]", re.sub(r"^template <.*?> ", "", declaration))[0]
        name = re.search(r"(~?\w+)\(", head)
        if not name or declaration.startswith(("friend", "using", "enum")) or "= delete" in declaration:
            continue
        if name[1].lstrip("~") != kind:
            yield kind, public, name[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repository", type=pathlib.Path)
    parser.add_argument("--list", action="store_true", help="print the functions of each type")
    options = parser.parse_args()
    types = {}
    for header in sorted(options.repository.glob(HEADERS)):
        for kind, public, name in functions(header.read_text(encoding="utf-8")):
            types.setdefault(kind, []).append((public, name))
    faults = []
    for kind, found in types.items():
        seen = [name for public, name in found if public]
        print(f"{kind}: {len(found)} member functions, {len(seen)} of them public")
        if options.list:
            print("    " + ", ".join(name for _, name in found))
        if len(found) > MOST:
            faults.append(f"{kind}: {len(found)} member functions, at most {MOST}")
        if kind == "Region" and len(seen) > FACE:
            faults.append(f"Region: {len(seen)} public member functions, at most {FACE}")
    if "Region" not in types:
        faults.append(f"no class Region in {HEADERS}")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
