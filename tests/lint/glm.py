#!/usr/bin/env python3
"""Checks that GLM is used only for storage: only the headers of vectors may name it, and each of its functions is deleted there.

usage: glm.py REPOSITORY GLM_FOLDER

rasterizer/base/no_arithmetic.h deletes GLM's operators and functions for our types, so that the compiler finds a call; vector_test
asserts that it does. This script finds what the compiler cannot: other uses of GLM (an include, its namespace), and functions of a newer GLM that the
file does not delete. GLM_FOLDER holds GLM's headers (glm/geometric.hpp and so on).

Neither detects conversions between GLM's types: a Vec3 constructed from a Vec3d, or from doubles, is rounded silently. Exit status 1 and one line per
violation.
"""
import os
import re
import sys

import specification

FOLDERS = ["rasterizer", "pipeline", "peeling", "scenes", "tools", "tests"]
DELETED_IN = "rasterizer/base/no_arithmetic.h"
OWNERS = ["rasterizer/base/vector.h", DELETED_IN]  # may name GLM
# The headers that <glm/mat4x4.hpp> may include. Integers and packing have separate headers, which are not included.
FUNCTION_HEADERS = ["common", "exponential", "geometric", "matrix", "trigonometric", "vector_relational"]
# Functions of only integers and booleans, which none of our types is.
OTHER_TYPES = {"intBitsToFloat", "uintBitsToFloat", "frexp", "ldexp", "any", "all", "not_"}
# If one of these is missing, the headers were not parsed correctly.
EXPECTED = {"dot", "cross", "normalize", "transpose", "inverse", "mix", "sqrt", "lessThan"}
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def functions_of(glm):
    names = set()
    for header in FUNCTION_HEADERS:
        with open(os.path.join(glm, "glm", header + ".hpp"), encoding="utf-8") as text:
            names.update(re.findall(r"GLM_FUNC_DECL[^;()]*?(\w+)\s*\(", text.read()))
    return names - OTHER_TYPES


def sources(root):
    names = specification.Checkout(root).names
    return [f for f in names if f.endswith((".h", ".cpp")) and f.startswith(tuple(folder + "/" for folder in FOLDERS))]


def read(root, file):
    with open(os.path.join(root, file), encoding="utf-8") as text:
        return text.read()


def without_comments(text):
    return COMMENT_OR_STRING.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def names_of_glm(root, files):
    for file in files:
        if file in OWNERS:
            continue
        text = read(root, file)
        for number, (line, code) in enumerate(zip(text.split("\n"), without_comments(text).split("\n")), 1):
            if re.search(r"#\s*include\s*[<\"]glm/", line):
                yield f"{file}:{number}: includes GLM; rasterizer/base/vector.h does that for all"
            elif re.search(r"\bglm\b", code):
                yield f"{file}:{number}: names GLM's namespace; rasterizer/base/vector.h has the types"


def not_deleted(root, functions):
    known = set(re.findall(r"\w+", without_comments(read(root, DELETED_IN))))
    for name in sorted(functions - known):
        yield f"{DELETED_IN}: GLM's function {name} is not deleted"


def main():
    if len(sys.argv) != 3:
        print(__doc__)
        return 2
    root, glm = sys.argv[1:]
    try:
        files, functions = sources(root), functions_of(glm)
    except specification.NoCheckout:
        print("SKIPPED: the list of files comes from git, and this is no checkout")
        return 77
    faults = [*names_of_glm(root, files), *not_deleted(root, functions)]
    if not EXPECTED <= functions:
        faults.append(f"{glm}: expected GLM's headers with {', '.join(sorted(EXPECTED))}, found {len(functions)} functions")
    for fault in faults:
        print(fault)
    print(f"{len(files)} sources, {len(functions)} functions of GLM, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
